#pragma once
// Commands and options with their help, read from the parser itself: for completion and manual.
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace railstrata {

struct OptionHelp {
  std::vector<std::string> names;    ///< "-o", "--out"; of a positional its one name without dashes
  std::string value;                 ///< placeholder of its value: "TEXT", "KEY=VALUE"; empty: it takes none
  std::vector<std::string> choices;  ///< its allowed values, if they are words
  std::string what;
  bool required = false;
  bool repeated = false;  ///< may be given again, or takes several
};
struct CommandHelp {
  std::string name;  ///< empty: of the program itself
  std::string what, footer;
  std::vector<OptionHelp> options, positionals;
};

/// The program first, its commands after it in the table's order.
std::vector<CommandHelp> command_help(const CLI::App& app);

}  // namespace railstrata
