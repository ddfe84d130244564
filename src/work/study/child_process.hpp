#pragma once
// A program that runs beside this one.
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace railstrata {

/// Starts this same program with other arguments; its output and errors go to `log`. The kernel kills it when this
/// process ends, in whatever way. To be called from the main thread. Throws EnvironmentError.
pid_t start_self(const std::vector<std::string>& words, const std::filesystem::path& log);

/// The variable of the environment by which a program that study starts knows that a second signal is not to end it.
inline constexpr const char* kIgnoreSecondSignal = "RAILSTRATA_ONE_SIGNAL";

/// Sets kIgnoreSecondSignal for all programs started from now on. A terminal's Ctrl-C and a batch system's SIGTERM
/// reach them beside the signal that this program sends: two signals within one step would end them without a
/// checkpoint. This program kills those that take too long.
void ignore_second_signal_in_children();

/// True once it has ended; `status` is then that of waitpid.
bool has_ended(pid_t child, int& status);

/// "killed by signal 9 (Killed)", "exit code 3".
std::string describe_end(int status);

}  // namespace railstrata
