#pragma once
// Numbers and records as JSON, and JSON as text, whatever is in it.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "record/column.hpp"

namespace railstrata {

/// indent < 0: on one line. Names of files and folders, and what a wrong input holds, may be in another encoding: what
/// is not UTF-8 is replaced by U+FFFD.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// null for values that are not finite, which JSON cannot represent.
inline nlohmann::ordered_json json_number(double v) {
  return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
}

/// The same in SI units of a count or a number of a record.
inline nlohmann::ordered_json json_number(const Unit& unit, double v) {
  return unit.whole && std::isfinite(v) ? nlohmann::ordered_json(static_cast<long>(v)) : json_number(v);
}

/// A record in SI units, a key a column.
template <class Record>
nlohmann::ordered_json json_record(const Record& record, const Columns<Record>& columns) {
  nlohmann::ordered_json out;
  for (const Column<Record>& c : columns) out[c.key()] = json_number(c.unit, c.value(record));
  return out;
}

}  // namespace railstrata
