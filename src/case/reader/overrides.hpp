#pragma once
// Values that are set over those of a case file (--set table.key=value).
#include <string>

#include "text/case_source.hpp"
#include "text/toml_document.hpp"

namespace railstrata {

/// Changes the document; `source` then knows the key's origin. Throws CaseError where the text names no place for a
/// value.
void apply_override(toml::table& document, const std::string& text, CaseSource& source);

}  // namespace railstrata
