#pragma once
// The reference of case files, written from the option tables.
#include <string>
#include <vector>

namespace railstrata {

/// A key of a case file as `--set` takes it, for who writes one.
struct CaseKey {
  std::string key;                  ///< "mesh.element_size"; of a list of tables that of its first, "layer.0.thickness"
  std::string doc;                  ///< one line
  std::string preset;               ///< its default as a case file writes it; empty: none
  std::string allowed;              ///< range or words, empty: everything
  std::vector<std::string> values;  ///< the words it takes or knows; a number has none
  std::vector<std::string> units;   ///< of a quantity, the customary one first; a plain number has none
};
/// All of them, in the order of the reference page.
std::vector<CaseKey> case_keys();

/// JSON Schema (draft 7) of a case file as TOML editors use it for completion and hints.
std::string case_json_schema();

/// The reference page docs/case-reference.md.
std::string case_reference_markdown();

}  // namespace railstrata
