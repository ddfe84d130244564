#pragma once
// Text cells of a CSV table that a spreadsheet program would run as a formula.
#include <string>

namespace railstrata {

/// The text with an apostrophe before it if it begins as a formula does: with =, @, a tab or a carriage return, or with
/// + or - unless a number follows that stands alone or before a unit ("-5 mm", "+0.3"). Spreadsheet programs then show
/// it as text [OWASP, CSV injection].
std::string without_formula(const std::string& text);

}  // namespace railstrata
