#pragma once
// Values that are set over those of a case file (--set table.key=value).
#include <string>

#include "case/case_source.hpp"
#include "case/toml_document.hpp"

namespace railstrata {

/// Changes the document; `source` then knows the key's origin. Throws CaseError where the text names no place for a
/// value.
void apply_override(toml::table& document, const std::string& text, CaseSource& source);

}  // namespace railstrata
