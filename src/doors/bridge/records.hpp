#pragma once
// Records in calls and answers, by their lists (ask/named.hpp).
#include <array>
#include <optional>

#include "ask/named.hpp"
#include "bridge/call.hpp"
#include "core/vec.hpp"

namespace railstrata::bridge {

inline Json json_of(double value) { return number(value); }
inline Json json_of(int value) { return value; }
inline Json json_of(bool value) { return value; }
inline Json json_of(Vec2 v) { return {number(v.y), number(v.z)}; }
inline Json json_of(Vec3 v) { return {number(v.x), number(v.y), number(v.z)}; }

template <class Rows, class Record>
Json json_of(const Rows& rows, const Record& record) {
  Json out = Json::object();
  for (const auto& row : rows) with_member(row, record, [&](const auto& value) { out[row.name] = json_of(value); });
  return out;
}

inline void take(const Json& given, double& value) { value = double_of(given); }
inline void take(const Json& given, std::optional<double>& value) { value = double_of(given); }
inline void take(const Json& given, std::array<double, 2>& values) {
  values = {double_of(given.at(0)), double_of(given.at(1))};
}

/// A record with the members that are given.
template <class Record, class Rows>
Record record_of(const Rows& rows, const Json& given) {
  Record out;
  for (const auto& row : rows)
    if (given.contains(row.name)) with_member(row, out, [&](auto& value) { take(given.at(row.name), value); });
  return out;
}

}  // namespace railstrata::bridge
