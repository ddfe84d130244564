#pragma once
// Manual pages in the form that `man` reads (groff_man(7)).
#include <string>
#include <vector>

#include "app/help_texts.hpp"
#include "options/case_schema.hpp"

namespace railstrata {

/// A page: its name without section ("railstrata-run") and its text.
struct ManualPage {
  std::string name;
  int section = 1;
  std::string text;
};

/// railstrata(1), a page for each command, and railstrata-case(5) on the keys of a case.
std::vector<ManualPage> manual_pages(const std::vector<CommandHelp>& commands, const std::vector<CaseKey>& keys,
                                     const std::string& version);

}  // namespace railstrata
