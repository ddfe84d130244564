#pragma once
// Many contacts or wheelsets, each with a state, solved over threads.
#include <functional>
#include <vector>

namespace railstrata {

/// Calls work(k) once for each handle, over `threads` threads (0: as many as OpenMP gives the calling one), each of
/// which solves on its own: results have the bits of one thread. work must not throw. Throws CaseError: a handle
/// appears twice, threads < 0.
void solve_apart(const std::vector<const void*>& handles, int threads, const std::function<void(std::size_t)>& work);

}  // namespace railstrata
