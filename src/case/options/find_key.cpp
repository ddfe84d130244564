#include "options/find_key.hpp"

#include <charconv>

namespace railstrata {

KeyPlace find_key(const std::string& key) {
  const std::size_t last = key.rfind('.');
  if (last == std::string::npos) return {};
  std::string table = key.substr(0, last);
  KeyPlace out;
  if (const std::size_t dot = table.rfind('.'); dot != std::string::npos) {
    const std::string number = table.substr(dot + 1);
    if (number.find_first_not_of("0123456789") == std::string::npos) {
      std::size_t index = 0;
      std::from_chars(number.data(), number.data() + number.size(), index);
      out.index = index;
      table.resize(dot);
    }
  }
  out.table = find_table(table);
  if (!out.table) return {};
  for (const Option& option : out.table->options)
    if (option.key == key.substr(last + 1)) out.option = &option;
  return out.option ? out : KeyPlace{};
}

}  // namespace railstrata
