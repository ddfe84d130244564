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

/// True once it has ended; `status` is then what waitpid tells.
bool has_ended(pid_t child, int& status);

/// "killed by signal 9 (Killed)", "exit code 3".
std::string describe_end(int status);

}  // namespace railstrata
