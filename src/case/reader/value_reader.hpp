#pragma once
// One value of a case file: from a TOML node to the option's place in the case. What is wrong with it is recorded in
// the source.
#include <string>

#include "options/option_table.hpp"
#include "text/case_source.hpp"
#include "text/toml_document.hpp"

namespace railstrata {

struct WrittenValue {
  const Option& option;
  const std::string& key;  ///< in full: "layer.0.young"
  const toml::node& node;
  std::size_t index = 0;  ///< of a table that is repeated
};

void read_value(CaseSource& source, CaseSpec& spec, const WrittenValue& written);

/// A number of the option's dimension and range, in SI; false: it is none, `out` is left.
bool read_number(CaseSource& source, const WrittenValue& written, double& out);

/// written: as it is shown; quantity: the text of a number with a unit, else empty.
void refuse_range(CaseSource& source, const Option& option, const std::string& key, const std::string& written,
                  const std::string& quantity, double value);

/// A value in a message, cut to 60 characters.
std::string shown(const toml::node& node);

/// Example of a list or of a table by depth.
std::string_view example_of(const Option& option);

void remember_place(CaseSource& source, const std::string& key, const toml::node& node);

}  // namespace railstrata
