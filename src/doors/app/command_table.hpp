#pragma once
// The commands of the program, and the names that commands had before.
#include <span>
#include <string>
#include <string_view>

#include "app/commands.hpp"

namespace railstrata {

/// In the order of the help.
std::span<const Command* const> commands();

struct OldName {
  std::string_view name;
  std::string_view now;  ///< the words in its place; empty: none
};
/// Null for a word that was never the name of a command, or still is.
const OldName* old_name(std::string_view word);

}  // namespace railstrata
