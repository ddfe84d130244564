#pragma once
// Wraps functions that throw for the interface, whose functions must not throw.
#include <limits>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "cntc/registry.hpp"

namespace railstrata::cntc {

inline constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Calls `work`; what it throws is kept and written. The code of what was thrown, or 0. No exception leaves.
template <class Work>
int guarded(int ire, int icp, Problem* problem, const char* call, Work&& work) noexcept {
  const auto report = [&](int code, const char* text) noexcept {
    try {
      registry().report(ire, icp, problem, call, code, text);
    } catch (...) {  // not even the memory for a message: the code has to do
    }
    return code;
  };
  try {
    work();
    return 0;
  } catch (const Refused& e) {
    return report(e.code, e.what());
  } catch (const std::bad_alloc&) {
    return report(kOther, "there is not enough memory");
  } catch (const std::exception& e) {
    return report(kOther, e.what());
  } catch (...) {
    return report(kOther, "an unknown fault");
  }
}

/// The problem, created if needed; null, with a report, for wrong numbers.
inline Problem* problem_of(int ire, int icp, const char* call) noexcept {
  Problem* out = nullptr;
  guarded(ire, icp, nullptr, call, [&] { out = &registry().problem(ire, icp); });
  return out;
}

/// Calls `work` with the problem.
template <class Work>
int with_problem(int ire, int icp, const char* call, Work&& work) noexcept {
  Problem* problem = problem_of(ire, icp, call);
  return problem ? guarded(ire, icp, problem, call, [&] { work(*problem); }) : int{kWrongProblem};
}

/// The same for a call that sets something. What is refused stays so until `key` is set otherwise.
template <class Work>
void setting(int ire, int icp, int key, const char* call, Work&& work) noexcept {
  with_problem(ire, icp, call, [&](Problem& problem) {
    try {
      work(problem);
      problem.refused.erase(key);
    } catch (const Refused& e) {
      problem.refused[key] = {e.code, std::string(call) + ": " + e.what()};
      throw;
    }
  });
}

/// An array of a caller; null or a negative length: empty.
template <class T>
std::span<T> given(T* values, int length) {
  return values && length > 0 ? std::span<T>(values, static_cast<std::size_t>(length)) : std::span<T>();
}

/// A text of a caller, without the blanks that Fortran fills it with.
inline std::string_view text(const char* characters, const int* length) {
  if (!characters || !length || *length <= 0) return {};
  std::string_view out(characters, static_cast<std::size_t>(*length));
  out = out.substr(0, out.find('\0'));
  const std::size_t first = out.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return out.substr(first, out.find_last_not_of(' ') - first + 1);
}

/// Fills what a caller has room for; what there is no value for becomes NaN.
template <class Values>
void copy_to(std::span<double> out, const Values& values) {
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = k < values.size() ? values[k] : kNoNumber;
}

}  // namespace railstrata::cntc
