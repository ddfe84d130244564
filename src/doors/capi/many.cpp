#include "ask/many_handles.hpp"

#include <algorithm>
#include <vector>

#include "capi/guarded.hpp"
#include "capi/handles.hpp"

using namespace railstrata;
using capi::element;
using capi::require;

namespace {

/// solve: rs_solve or rs_wheelset_solve.
template <class Handle, class State, class Forces>
int solve_many(int n, Handle* const* handles, const State* states, Forces* forces, rs_error* errors, int threads,
               const char* state_name, const char* forces_name,
               int (*solve)(Handle*, const State*, Forces*, rs_error*)) {
  const std::size_t count = n > 0 ? static_cast<std::size_t>(n) : 0;
  std::vector<int> codes;
  rs_error call;
  const int refused = capi::guarded(&call, [&] {
    if (n < 0) throw CaseError(fmt::format("n = {}", n), "give the number of handles, 0 or more");
    if (n == 0) return;
    require(handles && states && forces, "handles, states or forces", "give arrays of n");
    capi::require_sizes(states, count, state_name);
    capi::require_sizes<Forces>(forces, count, forces_name);
    codes.assign(count, RS_OK);
    solve_apart(std::vector<const void*>(handles, handles + n), threads, [&](std::size_t k) {
      codes[k] = solve(handles[k], &element(states, k), &element(forces, k), errors ? errors + k : nullptr);
    });
  });
  if (refused != RS_OK) {
    if (errors) std::fill_n(errors, count, call);
    return refused;
  }
  const auto failed = std::find_if(codes.begin(), codes.end(), [](int code) { return code != RS_OK; });
  return failed == codes.end() ? RS_OK : *failed;
}

}  // namespace

extern "C" {

int rs_solve_many(int n, rs_contact* const* contacts, const rs_state* states, rs_forces* forces, rs_error* errors,
                  int threads) {
  return solve_many(n, contacts, states, forces, errors, threads, "rs_state", "rs_forces", rs_solve);
}

int rs_wheelset_solve_many(int n, rs_wheelset* const* wheelsets, const rs_wheelset_state* states,
                           rs_wheelset_forces* forces, rs_error* errors, int threads) {
  return solve_many(n, wheelsets, states, forces, errors, threads, "rs_wheelset_state", "rs_wheelset_forces",
                    rs_wheelset_solve);
}

}  // extern "C"
