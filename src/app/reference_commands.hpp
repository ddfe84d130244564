#pragma once
// The commands that print what the parser knows of itself: completion and manual. They run as the last step of parsing.
namespace CLI {
class App;
}

namespace railstrata {

/// `completion bash`. The program's other commands may be added later.
void add_completion(CLI::App& sub);
/// `manual [PAGE] [--out FOLDER]`; added after all other commands, whose names are its pages.
void add_manual(CLI::App& sub);

}  // namespace railstrata
