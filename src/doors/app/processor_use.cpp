#include "app/processors.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace railstrata {
namespace {

std::vector<int> allowed() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> out;
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    for (int i = 0; i < CPU_SETSIZE; ++i)
      if (CPU_ISSET(i, &set)) out.push_back(i);
  return out;
}

}  // namespace

int allowed_processors() { return std::max(1, static_cast<int>(allowed().size())); }

int all_processors() { return std::max(1, static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN))); }

int physical_cores() {
  std::set<std::string> cores;  // by the list of their hardware threads
  for (int i : allowed()) {
    std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu{}/topology/thread_siblings_list", i));
    std::string siblings;
    cores.insert(std::getline(file, siblings) ? siblings : fmt::format("{}", i));
  }
  return std::max(1, static_cast<int>(cores.size()));
}

double mean_load() {
  double load = 0;
  std::ifstream file("/proc/loadavg");
  return file >> load ? load : 0;
}

}  // namespace railstrata
