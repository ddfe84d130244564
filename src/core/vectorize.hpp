#pragma once

/// In front of a loop whose arrays may overlap as far as the compiler can see, and do not.
#if defined(__clang__)
#define RAILSTRATA_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define RAILSTRATA_INDEPENDENT _Pragma("GCC ivdep")
#endif
