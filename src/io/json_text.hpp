#pragma once
// JSON as text, whatever is in it.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace railstrata {

/// indent < 0: on one line. Names of files and folders, and what a wrong input holds, may be in another encoding: what
/// is not UTF-8 is replaced by U+FFFD.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// null for what is not finite, which JSON cannot say.
inline nlohmann::ordered_json json_number(double v) {
  return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
}
inline nlohmann::ordered_json json_number(long v) { return v; }

}  // namespace railstrata
