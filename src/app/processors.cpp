#include "app/processors.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <vector>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

std::vector<int> allowed_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> out;
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    for (int i = 0; i < CPU_SETSIZE; ++i)
      if (CPU_ISSET(i, &set)) out.push_back(i);
  return out;
}

// Of a rank among several on this machine that are not bound to cores of their own: its part of them.
int cores_of_rank(int cores) {
  const char* const ranks = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  const bool bound = static_cast<long>(allowed_processors().size()) < sysconf(_SC_NPROCESSORS_ONLN);
  return ranks == nullptr || bound ? cores : std::max(1, cores / std::max(1, std::atoi(ranks)));
}

}  // namespace

int physical_cores() {
  std::set<std::string> cores;  // by the list of their hardware threads
  for (int i : allowed_processors()) {
    std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu{}/topology/thread_siblings_list", i));
    std::string siblings;
    cores.insert(std::getline(file, siblings) ? siblings : fmt::format("{}", i));
  }
  return std::max(1, static_cast<int>(cores.size()));
}

int default_threads() {
  return std::clamp(std::getenv("OMP_NUM_THREADS") != nullptr
                        ? max_threads()
                        : cores_of_rank(std::min(max_threads(), physical_cores())),
                    1, kMostThreads);
}

std::string oversubscription(int threads) {
  const int processors = std::max(1, static_cast<int>(allowed_processors().size()));
  if (threads > processors)
    return fmt::format("{} threads share {} processor{}: fewer would be faster, see --threads", threads, processors,
                       processors == 1 ? "" : "s");
  return {};
}

std::string competition(int threads) {
  const int processors = std::max(1, static_cast<int>(allowed_processors().size()));
  double load = 0;
  if (std::ifstream file("/proc/loadavg"); !(file >> load)) return {};
  if (load + threads > 1.5 * processors)
    return fmt::format(
        "other programs keep {:.1f} of {} processors busy (mean of the last minute): this will take longer than on a "
        "free machine",
        std::min(load, 1.0 * processors), processors);
  return {};
}

}  // namespace railstrata
