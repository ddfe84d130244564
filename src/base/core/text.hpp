#pragma once
// Small helpers for text that is read.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

namespace railstrata {

/// Without the characters of `around` at both ends. The view is into `text`.
inline std::string_view trimmed(std::string_view text, std::string_view around = " \t\r\f\v") {
  const std::size_t begin = text.find_first_not_of(around);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(around) - begin + 1);
}

/// With a hyphen for the minus sign (U+2212), and plain spaces for narrow and unbreakable ones.
inline std::string plain_signs(std::string_view text) {
  std::string out(text);
  for (const auto& [sign, plain] : {std::pair<std::string_view, const char*>{"\xE2\x88\x92", "-"},
                                    {"\xC2\xA0", " "},
                                    {"\xE2\x80\x89", " "},
                                    {"\xE2\x80\xAF", " "}})
    for (std::size_t at = out.find(sign); at != std::string::npos; at = out.find(sign, at + 1))
      out.replace(at, sign.size(), plain);
  return out;
}

/// The bytes of a file; none of one that cannot be read.
inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

}  // namespace railstrata
