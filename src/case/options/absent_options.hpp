#pragma once
// Words that people look for in a case and that do not exist: plasticity, another word or another table for a key there
// is, a key that is gone.
#include <string_view>

namespace railstrata {

/// How to do without the key or table of this name ("hardening", "track"), a sentence without its full stop; empty for
/// any other name.
std::string_view answer_for_absent(std::string_view name);

}  // namespace railstrata
