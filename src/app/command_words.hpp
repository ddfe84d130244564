#pragma once
// The words that the command line takes, read from the parser itself: for completion and manual.
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace railstrata {

struct OptionWords {
  std::vector<std::string> names;    ///< "-o", "--out"; of a positional its one name without dashes
  std::string value;                 ///< what stands for its value: "TEXT", "KEY=VALUE"; empty: it takes none
  std::vector<std::string> choices;  ///< the values that it takes, if they are words
  std::string what;
  bool required = false;
  bool repeated = false;  ///< may be given again, or takes several
};
struct CommandWords {
  std::string name;  ///< empty: of the program itself
  std::string what, footer;
  std::vector<OptionWords> options, positionals;
};

/// The program first, its commands after it in the table's order.
std::vector<CommandWords> command_words(const CLI::App& app);

}  // namespace railstrata
