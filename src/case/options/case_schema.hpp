#pragma once
// The reference of case files, written from the option tables.
#include <string>

namespace railstrata {

/// JSON Schema (draft 7) of a case file as TOML editors use it for completion and hints.
std::string case_json_schema();

/// The reference page docs/case-reference.md.
std::string case_reference_markdown();

}  // namespace railstrata
