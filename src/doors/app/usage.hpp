#pragma once
// Mistakes on the command line in the program's own words: what, and a remedy.
#include <string>
#include <vector>

#include "core/faults.hpp"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace railstrata {

/// The error for a command line that CLI11 refuses. words: the command line; commands: the names of all commands.
CaseError usage_error(const CLI::App& app, const CLI::ParseError& e, const std::vector<std::string>& words,
                      const std::vector<std::string>& commands);

/// "help" becomes "--help", "help run" "run --help".
std::vector<std::string> with_help_spelled_out(std::vector<std::string> words);

}  // namespace railstrata
