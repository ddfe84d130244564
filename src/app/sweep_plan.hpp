#pragma once
// The cases of a sweep.
#include <string>
#include <vector>

namespace railstrata {

/// One --vary: a key and its values as they were written.
struct VariedKey {
  std::string key;
  std::vector<std::string> values;
};

/// Reads "key=v1,v2,…"; blanks around values do not count. Throws CaseError: no "=", no or an empty value, a key given twice.
std::vector<VariedKey> parse_vary(const std::vector<std::string>& options);

/// Every combination, the last key changing fastest: per case the value of each key.
std::vector<std::vector<std::string>> combinations(const std::vector<VariedKey>& keys);

}  // namespace railstrata
