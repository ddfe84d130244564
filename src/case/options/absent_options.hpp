#pragma once
// Words that people look for in a case and that do not exist: plasticity, another word or another table for a key there
// is; and keys that are gone.
#include <string_view>

namespace railstrata {

/// How to do without the key or table of this name ("hardening", "track"), a sentence without its full stop; empty for
/// any other name.
std::string_view answer_for_absent(std::string_view name);

/// A key of earlier versions. Resolved cases of old results have it: with the value that holds now it is read over.
struct RetiredKey {
  std::string_view table, key;
  std::string_view value;   ///< as a resolved case has it; empty: refused with any
  std::string_view remedy;  ///< of another value
};
/// Null if there was none of this name in the table.
const RetiredKey* retired_key(std::string_view table, std::string_view key);

}  // namespace railstrata
