#include "study/variation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/faults.hpp"
#include "core/text.hpp"

namespace railstrata {
namespace {

constexpr const char* kHowTo = "write --vary key=value,value, for example --vary layer.0.young_ratio=0.5,1,2";

/// "3 mm" and 3 mm are the same value here.
std::string value_of(std::string_view text) { return std::string(trimmed(text, " \t\"'")); }

VariedKey parse_one(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || value_of(text.substr(0, equals)).empty())
    throw CaseError(fmt::format("--vary \"{}\" names no key", text), kHowTo);
  VariedKey out{value_of(text.substr(0, equals)), {}};
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const auto comma = std::min(text.find(',', begin), text.size());
    out.values.push_back(value_of(text.substr(begin, comma - begin)));
    if (out.values.back().empty()) throw CaseError(fmt::format("--vary \"{}\" has an empty value", text), kHowTo);
    begin = comma + 1;
  }
  return out;
}

/// Throws CaseError: a key without values makes no case, an empty value sets nothing.
void require_values(const VariedKey& varied) {
  const bool none = varied.values.empty();
  if (!none && std::find(varied.values.begin(), varied.values.end(), "") == varied.values.end()) return;
  throw CaseError(fmt::format("{} has {}", varied.key, none ? "no values to vary over" : "an empty value to vary over"),
                  "give one value or more, or leave the key out");
}

}  // namespace

std::vector<VariedKey> parse_vary(const std::vector<std::string>& options) {
  std::vector<VariedKey> out;
  for (const std::string& text : options) {
    out.push_back(parse_one(text));
    for (std::size_t k = 0; k + 1 < out.size(); ++k)
      if (out[k].key == out.back().key)
        throw CaseError(fmt::format("--vary names {} twice", out[k].key), "give all values of a key in one --vary");
  }
  return out;
}

std::vector<std::vector<std::string>> combinations(const std::vector<VariedKey>& keys) {
  for (const VariedKey& k : keys) require_values(k);
  double cases = 1;
  for (const VariedKey& k : keys) cases *= static_cast<double>(k.values.size());
  if (cases > kMostCases)
    throw CaseError(fmt::format("the values to vary make {:.6g} cases, more than {}", cases, kMostCases),
                    "vary fewer keys at once, or give fewer values");
  std::vector<std::vector<std::string>> out(1);
  for (const VariedKey& k : keys) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& head : out)
      for (const std::string& value : k.values) {
        longer.push_back(head);
        longer.back().push_back(value);
      }
    out = std::move(longer);
  }
  return out;
}

}  // namespace railstrata
