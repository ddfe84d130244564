#include "record/this_process.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>

namespace railstrata {
namespace {

/// The 22nd field of /proc/<id>/stat, counted from the end of the name in brackets, which may hold anything; -1 if
/// there is no such process.
long long started(long id) {
  std::ifstream in("/proc/" + std::to_string(id) + "/stat");
  std::string text;
  std::getline(in, text);
  const auto name = text.rfind(')');
  if (name == std::string::npos) return -1;
  std::istringstream rest(text.substr(name + 1));
  std::string word;
  for (int field = 3; field <= 22; ++field) rest >> word;
  long long ticks = -1;
  std::istringstream(word) >> ticks;
  return ticks;
}

std::string this_system() {
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  std::array<char, 64> space{};
  const ssize_t n = ::readlink("/proc/self/ns/pid", space.data(), space.size() - 1);
  return fmt::format("{} {}", boot, std::string_view(space.data(), n > 0 ? static_cast<std::size_t>(n) : 0));
}

/// A file of one number of bytes; no limit if it contains none or does not exist.
double number_in(const char* file) {
  double value = 0;
  std::ifstream in(file);
  return in >> value ? value : HUGE_VAL;
}

double available_in_system() {
  std::ifstream in("/proc/meminfo");
  for (std::string word; in >> word;)
    if (double kilobytes = 0; word == "MemAvailable:" && in >> kilobytes) return 1024 * kilobytes;
  return HUGE_VAL;
}

}  // namespace

std::string host_name() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return host.data();
}

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return {};
}

std::filesystem::path program_file() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

long process_id() { return ::getpid(); }

bool is_running(long process) { return ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH; }

ProcessName this_process() { return {host_name(), this_system(), ::getpid(), started(::getpid())}; }

bool is_known_dead(const ProcessName& process) {
  if (process.system.empty() || process.host != host_name() || process.system != this_system() || process.id < 1)
    return false;
  if (!is_running(process.id)) return true;
  const long long now = started(process.id);
  return now >= 0 && process.started >= 0 && now != process.started;
}

double memory_at_hand() {
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  const double address_space = limit.rlim_cur == RLIM_INFINITY ? HUGE_VAL : static_cast<double>(limit.rlim_cur);
  const double group =
      number_in("/sys/fs/cgroup/memory.max") -
      (std::ifstream("/sys/fs/cgroup/memory.current") ? number_in("/sys/fs/cgroup/memory.current") : 0);
  return std::min({available_in_system(), group, address_space});
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace railstrata
