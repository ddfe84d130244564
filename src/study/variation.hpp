#pragma once
// Keys of a case that take several values: what `sweep` gets on its command line and `study` from its file.
#include <cstddef>
#include <string>
#include <vector>

namespace railstrata {

/// A key and its values, as an override takes them ("0.2 mm", with or without quotes).
struct VariedKey {
  std::string key;
  std::vector<std::string> values;
};

/// Reads "key=v1,v2,…"; blanks around values do not count. Throws CaseError: no "=", no or an empty value, a key given
/// twice.
std::vector<VariedKey> parse_vary(const std::vector<std::string>& options);

/// As many combinations as a sweep or a group of a study may have.
inline constexpr std::size_t kMostCases = 10'000;

/// Every combination, the last key changing fastest: per case the value of each key. One empty combination of no keys.
/// Throws CaseError beyond kMostCases, for a key without values and for an empty value.
std::vector<std::vector<std::string>> combinations(const std::vector<VariedKey>& keys);

}  // namespace railstrata
