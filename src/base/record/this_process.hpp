#pragma once
// This process: its place among all others, on any machine, and its memory.
#include <filesystem>
#include <string>

namespace railstrata {

/// The name of this machine in its network.
std::string host_name();

/// The processor's name as the system reports it; empty if it does not.
std::string cpu_name();

/// The file of the program that this process runs; empty if the system does not report it.
std::filesystem::path program_file();

/// The number of this process on this machine.
long process_id();

/// Whether a process of this machine has this number now.
bool is_running(long process);

/// A process of the machine `host` as that machine knows it. `system`: one start of one kernel and one space of process
/// numbers (a container has its own); `started`: when, in ticks since the kernel began, for numbers are used again.
struct ProcessName {
  std::string host, system;
  long id = 0;
  long long started = 0;
  bool operator==(const ProcessName&) const = default;
};

ProcessName this_process();

/// True only where that can be known: the process was one of this machine, since its last start, and is no more.
bool is_known_dead(const ProcessName& process);

/// Memory that this process may still take, bytes: the least of the system's available memory, its control group's
/// limit and the limit of its address space.
double memory_at_hand();

/// The largest amount it has had in use, bytes.
double peak_memory();

}  // namespace railstrata
