#include "record/this_process.hpp"

#include <windows.h>
// after windows.h, whose types it takes
#include <psapi.h>

#include <algorithm>
#include <array>
#include <memory>

namespace railstrata {
namespace {

using Handle = std::unique_ptr<void, decltype(&::CloseHandle)>;

Handle opened(long process) {
  return {::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION | SYNCHRONIZE, FALSE, static_cast<DWORD>(process)),
          ::CloseHandle};
}

/// When it began, in units of 100 ns since 1601; -1 if there is no such process.
long long started(long id) {
  const Handle process = opened(id);
  FILETIME begin{}, unused{};
  if (!process || ::GetProcessTimes(process.get(), &begin, &unused, &unused, &unused) == 0) return -1;
  return static_cast<long long>(begin.dwHighDateTime) << 32 | begin.dwLowDateTime;
}

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};
  DWORD size = name.size();
  return ::GetComputerNameExA(ComputerNameDnsHostname, name.data(), &size) == 0 ? std::string() : name.data();
}

std::string cpu_name() {
  std::array<char, 256> name{};
  DWORD size = name.size();
  return ::RegGetValueA(HKEY_LOCAL_MACHINE, R"(HARDWARE\DESCRIPTION\System\CentralProcessor\0)", "ProcessorNameString",
                        RRF_RT_REG_SZ, nullptr, name.data(), &size) == ERROR_SUCCESS
             ? name.data()
             : std::string();
}

std::filesystem::path program_file() {
  std::wstring name(1 << 15, L'\0');  // the longest there is
  name.resize(::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size())));
  return name;
}

long process_id() { return static_cast<long>(::GetCurrentProcessId()); }

bool is_running(long id) {
  const Handle process = opened(id);
  return process ? ::WaitForSingleObject(process.get(), 0) == WAIT_TIMEOUT
                 : ::GetLastError() != ERROR_INVALID_PARAMETER;
}

ProcessName this_process() { return {host_name(), "windows", process_id(), started(process_id())}; }

bool is_known_dead(const ProcessName& process) {
  if (process.system != "windows" || process.host != host_name() || process.id < 1) return false;
  if (!is_running(process.id)) return true;
  const long long now = started(process.id);
  return now >= 0 && process.started >= 0 && now != process.started;
}

double memory_at_hand() {
  MEMORYSTATUSEX memory{};
  memory.dwLength = sizeof memory;
  ::GlobalMemoryStatusEx(&memory);
  return static_cast<double>(std::min(memory.ullAvailPhys, memory.ullAvailVirtual));
}

double peak_memory() {
  PROCESS_MEMORY_COUNTERS used{};
  ::GetProcessMemoryInfo(::GetCurrentProcess(), &used, sizeof used);
  return static_cast<double>(used.PeakWorkingSetSize);
}

}  // namespace railstrata
