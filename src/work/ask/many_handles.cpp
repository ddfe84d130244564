#include "ask/many_handles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ask/solve_settings.hpp"
#include "core/parallel.hpp"

namespace railstrata {

void solve_apart(const std::vector<const void*>& handles, int threads, const std::function<void(std::size_t)>& work) {
  std::vector<const void*> sorted = handles;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) {
    const auto first = std::find(handles.begin(), handles.end(), *twice);
    throw CaseError(fmt::format("handles {} and {} are the same one", first - handles.begin(),
                                std::find(first + 1, handles.end(), *twice) - handles.begin()),
                    "give each once: a copy of it for another state");
  }
  const ThreadsOfCaller wanted(threads);
  for_each(
      static_cast<std::ptrdiff_t>(handles.size()), [&](std::ptrdiff_t k) { work(static_cast<std::size_t>(k)); }, true);
}

}  // namespace railstrata
