#pragma once
// Texts as others read them back: a spreadsheet, XML, a shell.
#include <string>
#include <string_view>

namespace railstrata {

/// For a cell of a CSV table: with an apostrophe before it if it begins as a formula does: with =, @, a tab or a
/// carriage return, or with + or - unless a number follows that stands alone or before a unit ("-5 mm", "+0.3").
/// Spreadsheet programs then show it as text [OWASP, CSV injection].
std::string without_formula(const std::string& text);

/// For XML, SVG and HTML: reads as itself between tags and inside double quotes: &, < and " as entities.
std::string markup_text(std::string_view text);

/// For a command line to copy, as a POSIX shell reads it back: as it is where that is safe, else in single quotes.
std::string shell_word(const std::string& word);

}  // namespace railstrata
