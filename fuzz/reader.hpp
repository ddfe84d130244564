#pragma once
// What the targets share. A target is one LLVMFuzzerTestOneInput: libFuzzer calls it, and so does replay.cpp.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/faults.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace railstrata::fuzz {

/// Ends the program where a reader breaks a promise, so that the input is kept.
inline void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

/// Whether the reader took the input. It may refuse with a CaseError that says something; any other exception is a
/// find.
template <class Read>
bool accepts(Read&& read) {
  try {
    read();
    return true;
  } catch (const CaseError& e) {
    promise(!e.diagnostics.empty(), "a refusal has a reason");
    bool remedy = false;
    for (const Diagnostic& d : e.diagnostics) {
      promise(!d.message.empty(), "every fault has a message");
      remedy |= !d.remedy.empty();
    }
    promise(remedy, "a refusal has a remedy");
    return false;
  }
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace railstrata::fuzz
