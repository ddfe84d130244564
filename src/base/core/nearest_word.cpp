#include "core/nearest_word.hpp"

#include <algorithm>
#include <cctype>

namespace railstrata {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

bool starts_with(std::string_view word, std::string_view beginning) {
  return beginning.size() >= 3 && word.size() >= beginning.size() &&
         std::equal(beginning.begin(), beginning.end(), word.begin(),
                    [](char a, char b) { return lower(a) == lower(b); });
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<int> d((a.size() + 1) * columns);
  auto at = [&](std::size_t i, std::size_t j) -> int& { return d[i * columns + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = at(i - 1, j - 1) + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replaced});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return at(a.size(), b.size());
}

std::string nearest_word(std::string_view typed, const std::vector<std::string>& words) {
  std::string best;
  int least = static_cast<int>(std::max<std::size_t>(typed.size(), 3) / 3) + 1;
  for (const std::string& word : words) {
    const std::size_t longer =
        std::max(typed.size(), word.size()) - std::min(typed.size(), word.size());  // so many letters differ at least
    if (longer >= static_cast<std::size_t>(least)) continue;
    if (const int d = edit_distance(typed, word); d < least) {
      least = d;
      best = word;
    }
  }
  if (!best.empty()) return best;
  for (const std::string& word : words)
    if (starts_with(word, typed) || starts_with(typed, word)) return word;
  return {};
}

}  // namespace railstrata
