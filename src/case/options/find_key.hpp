#pragma once
// From the text of a key to its option.
#include <cstddef>
#include <optional>
#include <string>

#include "options/option_table.hpp"

namespace railstrata {

/// What a key "table.option" or, of a list of tables, "layer.0.young" names; null: nothing.
struct KeyPlace {
  const OptionTable* table = nullptr;
  const Option* option = nullptr;
  std::optional<std::size_t> index = {};  ///< in the list of tables
};
KeyPlace find_key(const std::string& key);

}  // namespace railstrata
