#pragma once
// Converts exceptions of the library to the codes of its C interface.
#include "capi/railstrata.h"

#include <algorithm>
#include <exception>
#include <new>
#include <string_view>

#include "ask/contact.hpp"
#include "core/faults.hpp"

namespace railstrata::capi {

inline int fail(rs_error* error, int code, std::string_view text) {
  if (!error) return code;
  error->code = code;
  const std::size_t n = std::min(text.size(), sizeof(error->message) - 1);
  std::copy_n(text.data(), n, error->message);
  error->message[n] = '\0';
  return code;
}

/// Calls `work`; the code of what it throws, with its text in `error`. No exception leaves.
template <class Work>
int guarded(rs_error* error, Work&& work) noexcept {
  try {
    work();
    if (error) *error = rs_error{};
    return RS_OK;
  } catch (const NoAnswer& e) {
    return fail(error, RS_NO_ANSWER, e.what());
  } catch (const CaseError& e) {
    return fail(error, RS_CASE, e.what());
  } catch (const NumericalError& e) {
    return fail(error, RS_NUMERICS, e.what());
  } catch (const EnvironmentError& e) {
    return fail(error, RS_MACHINE, e.what());
  } catch (const std::bad_alloc&) {
    return fail(error, RS_MACHINE, "there is not enough memory");
  } catch (const std::exception& e) {
    return fail(error, RS_INTERNAL, e.what());
  } catch (...) {
    return fail(error, RS_INTERNAL, "an unknown fault");
  }
}

/// The pointer that `make` gives; NULL where it throws.
template <class Make>
auto made(rs_error* error, Make&& make) noexcept {
  decltype(make()) out = nullptr;
  guarded(error, [&] { out = make(); });
  return out;
}

}  // namespace railstrata::capi
