#pragma once

/// In front of a loop whose arrays may overlap as far as the compiler can see, and do not. Under the thread sanitizer,
/// whose calls in the loop keep clang++ from it, nothing is asked: what is asked for and cannot be is a warning.
#if !defined(__clang__)
#define RAILSTRATA_INDEPENDENT _Pragma("GCC ivdep")
#elif __has_feature(thread_sanitizer)
#define RAILSTRATA_INDEPENDENT
#else
#define RAILSTRATA_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#endif
