#pragma once
// A subcommand, the options that several of them have, and the table of all (command_table.cpp).
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/faults.hpp"

namespace CLI {
class App;
}

namespace railstrata {

/// Options of the program and options that several commands declare.
struct CommandOptions {
  std::filesystem::path case_file;     ///< a file, or a folder that holds case.toml
  std::vector<std::string> overrides;  ///< --set
  std::filesystem::path out;           ///< --out; empty: results/<case name>
  bool force = false;                  ///< --force: write into a folder that is not empty
  std::string cell;                    ///< --cell of the half-space commands: a length; empty: the engine's default
  bool page = true;                    ///< --no-report: without report.html
  bool json = false;                   ///< --json: results on standard output as JSON
  int threads = 1;
  std::vector<std::string> command_line;
};

/// Carries a command out with the options that were parsed. Faults are exceptions.
using CommandWork = std::function<ExitCode()>;

/// A subcommand, defined in command_<name>.cpp and listed in command_table.cpp.
struct Command {
  const char *name, *what, *examples;  ///< of its help
  /// Adds its options. Those of this command alone belong to the work that is returned.
  CommandWork (*declare)(CLI::App& sub, CommandOptions& options);
  bool among_ranks = false;  ///< may be started by mpirun: `run` shares its work, processes of `study` their cases
};

/// All of them, in the order of the help.
std::span<const Command* const> commands();

struct OldName {
  std::string_view name;
  std::string_view now;  ///< the words in its place; empty: none
};
/// Null for a word that was never the name of a command, or still is.
const OldName* old_name(std::string_view word);

}  // namespace railstrata
