// Texts of the program are UTF-8. libstdc++ makes a wide name of a file out of them, and back, by the two functions of
// C below, which on Windows take each byte for a letter: linked with --wrap, these stand in for them
// (cmake/windows.cmake). Letters beyond U+FFFF, which take two wide characters, are refused.
#include <cerrno>
#include <cwchar>

namespace {

constexpr auto kNoLetter = static_cast<std::size_t>(-1);
constexpr auto kTooShort = static_cast<std::size_t>(-2);

std::size_t refused() {
  errno = EILSEQ;
  return kNoLetter;
}

std::size_t bytes_of_letter(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  return (first & 0xF0) == 0xE0 ? 3 : 0;
}

}  // namespace

extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t n, std::mbstate_t*) {
  if (from == nullptr) return 0;
  if (n == 0) return kTooShort;
  const auto first = static_cast<unsigned char>(from[0]);
  const std::size_t size = bytes_of_letter(first);
  if (size == 0) return refused();
  unsigned letter = size == 1 ? first : first & (0x7Fu >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if (i == n) return kTooShort;
    if ((from[i] & 0xC0) != 0x80) return refused();
    letter = letter << 6 | (static_cast<unsigned>(from[i]) & 0x3F);
  }
  if (size == 3 && letter < 0x800) return refused();
  if (to != nullptr) *to = static_cast<wchar_t>(letter);
  return letter == 0 ? 0 : size;
}

extern "C" std::size_t __wrap_wcrtomb(char* to, wchar_t wide, std::mbstate_t*) {
  if (to == nullptr) return 1;
  const unsigned letter = wide;
  if (letter < 0x80) {
    to[0] = static_cast<char>(letter);
    return 1;
  }
  const std::size_t size = letter < 0x800 ? 2 : 3;
  to[0] = static_cast<char>((size == 2 ? 0xC0 : 0xE0) | letter >> (6 * (size - 1)));
  for (std::size_t i = 1; i < size; ++i) to[i] = static_cast<char>(0x80 | (letter >> (6 * (size - 1 - i)) & 0x3F));
  return size;
}
