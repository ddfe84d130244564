#include "core/printable.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>

namespace railstrata {
namespace {

std::string hex(const char* format, unsigned char byte) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), format, byte);
  return text.data();
}

/// Bytes of the UTF-8 character at the start of the text; 0: it is none, or a control character.
std::size_t visible_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0; };
  const int first = byte(0), second = byte(1);
  if (first < 0x80) return first == '\n' || first == '\t' || (first >= 0x20 && first != 0x7F) ? 1 : 0;
  const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                             : (first & 0xF0) == 0xE0        ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const bool control = first == 0xC2 && second < 0xA0,
             overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90),
             surrogate = first == 0xED && second >= 0xA0, beyond = first == 0xF4 && second >= 0x90;
  return control || overlong || surrogate || beyond ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = visible_length(text);
    if (length == 0)
      out += hex("\\x%02x", static_cast<unsigned char>(text[0]));
    else
      out += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string sign_of_binary(std::string_view text) {
  constexpr std::string_view kAllowed = "\t\n\v\f\r\x1A";
  const auto at = std::find_if(text.begin(), text.end(), [&](char c) {
    return (static_cast<unsigned char>(c) < 0x20 && kAllowed.find(c) == std::string_view::npos) || c == 0x7F;
  });
  if (at == text.end()) return {};
  return "line " + std::to_string(1 + std::count(text.begin(), at, '\n')) + " has the byte " +
         hex("0x%02X", static_cast<unsigned char>(*at));
}

}  // namespace railstrata
