#pragma once
// Texts of others (a binary file taken for a case, a title) on a terminal, which obeys control characters.
#include <string>
#include <string_view>

namespace railstrata {

/// The text with control characters other than newline and tab, and bytes that are not UTF-8, as "\\x1b".
std::string printable(std::string_view text);

/// The text as it is where it is UTF-8, else as read in Windows-1252 (its five empty places as U+FFFD), which
/// spreadsheets write.
struct DecodedText {
  std::string text;
  bool from_windows_1252 = false;
};
DecodedText decoded(std::string text);

/// "line 3 has the byte 0x00": the first control character that is not white space, which no text has; empty if there
/// is none. (The end mark of DOS, 0x1A, passes.)
std::string sign_of_binary(std::string_view text);

}  // namespace railstrata
