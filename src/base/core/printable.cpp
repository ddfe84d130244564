#include "core/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace railstrata {
namespace {

/// Bytes of the UTF-8 character at the start of the text, which is not of ASCII; 0: it is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0; };
  const int first = byte(0), second = byte(1);
  const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                             : (first & 0xF0) == 0xE0        ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90),
             surrogate = first == 0xED && second >= 0xA0, beyond = first == 0xF4 && second >= 0x90;
  return overlong || surrogate || beyond ? 0 : length;
}

/// Bytes of the character at the start of the text; 0: it is none, or a control character.
std::size_t visible_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return first == '\n' || first == '\t' || (first >= 0x20 && first != 0x7F) ? 1 : 0;
  const bool control = first == 0xC2 && text.size() > 1 && static_cast<unsigned char>(text[1]) < 0xA0;
  return control ? 0 : utf8_length(text);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = visible_length(text);
    if (length == 0)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    else
      out += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

DecodedText decoded(std::string text) {
  const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t length = is_ascii(rest[0]) ? 1 : utf8_length(rest);
    if (length == 0) break;
    rest.remove_prefix(length);
  }
  if (rest.empty()) return {std::move(text), false};
  // 0x80 to 0x9F; from there on the bytes are the numbers of Unicode.
  constexpr std::array<char16_t, 32> kFirst{0x20AC, 0xFFFD, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                            0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0xFFFD, 0x017D, 0xFFFD,
                                            0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                            0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0xFFFD, 0x017E, 0x0178};
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_ascii(c)) {
      out += c;
      continue;
    }
    const unsigned code = byte < 0xA0 ? kFirst[byte - 0x80] : byte;
    if (code >= 0x800) out += {static_cast<char>(0xE0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3F))};
    if (code < 0x800) out += static_cast<char>(0xC0 | code >> 6);
    out += static_cast<char>(0x80 | (code & 0x3F));
  }
  return {std::move(out), true};
}

std::string sign_of_binary(std::string_view text) {
  constexpr std::string_view kAllowed = "\t\n\v\f\r\x1A";
  const auto at = std::find_if(text.begin(), text.end(), [&](char c) {
    return (static_cast<unsigned char>(c) < 0x20 && kAllowed.find(c) == std::string_view::npos) || c == 0x7F;
  });
  if (at == text.end()) return {};
  return fmt::format("line {} has the byte 0x{:02X}", 1 + std::count(text.begin(), at, '\n'),
                     static_cast<unsigned char>(*at));
}

}  // namespace railstrata
