#include "app/processors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

// Cores for one of several ranks on this machine that are not bound to cores: an equal part.
int cores_of_rank(int cores) {
  const char* const ranks = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  const bool bound = allowed_processors() < all_processors();
  return ranks == nullptr || bound ? cores : std::max(1, cores / std::max(1, std::atoi(ranks)));
}

}  // namespace

int default_threads() {
  return std::clamp(std::getenv("OMP_NUM_THREADS") != nullptr
                        ? max_threads()
                        : cores_of_rank(std::min(max_threads(), physical_cores())),
                    1, kMostThreads);
}

std::string oversubscription(int threads) {
  const int processors = allowed_processors();
  if (threads > processors)
    return fmt::format("{} threads share {} processor{}: fewer would be faster, see --threads", threads, processors,
                       processors == 1 ? "" : "s");
  return {};
}

std::string competition(int threads) {
  const int processors = allowed_processors();
  const double load = mean_load();
  if (load + threads > 1.5 * processors)
    return fmt::format(
        "other programs keep {:.1f} of {} processors busy (mean of the last minute): this will take longer than on a "
        "free machine",
        std::min(load, 1.0 * processors), processors);
  return {};
}

}  // namespace railstrata
