#include "core/simd.hpp"

#include <fmt/format.h>

namespace railstrata {

std::string instruction_set() {
#if defined(__AVX512F__)
  const char* name = "AVX-512";
#elif defined(__AVX2__)
  const char* name = "AVX2";
#elif defined(__AVX__)
  const char* name = "AVX";
#elif defined(__x86_64__)
  const char* name = "SSE2";
#else
  const char* name = "generic";
#endif
  return fmt::format("{}, {} doubles a vector", name, kLanes);
}

}  // namespace railstrata
