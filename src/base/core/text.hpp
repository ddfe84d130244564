#pragma once
// Small helpers for text that is read.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace railstrata {

/// Without the characters of `around` at both ends. The view is into `text`.
inline std::string_view trimmed(std::string_view text, std::string_view around = " \t\r\f\v") {
  const std::size_t begin = text.find_first_not_of(around);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(around) - begin + 1);
}

/// The bytes of a file; none of one that cannot be read.
inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

}  // namespace railstrata
