#pragma once
// Records in calls and answers, by their lists (ask/named.hpp); contact fields, points and stresses inside the bodies.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ask/named.hpp"
#include "bridge/call.hpp"
#include "contact/contact_field.hpp"
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

/// Views of its arrays, (stations, columns).
Json patch_of(const ContactField& field);

/// Of an array (n, 3). Throws std::invalid_argument: another shape, a number that is none.
std::vector<Vec3> points_of(const Array& given);

/// xx, yy, zz, xy, yz, xz.
std::array<double, 6> components(const Sym3& stress);
/// (n, 6), as "stresses".
void answer_stresses(Call& call, const std::vector<Sym3>& stresses);

// Values of a case as Python has them: numbers are SI (values.cpp).

/// A value as an override of the key takes it: a number of a key with a unit is SI and gets its unit ("80 kN"), texts
/// stay as they are; the same inside lists and tables.
std::string value_text(const std::string& key, const Json& value);

/// Overrides from a list of those ("key=value") and of pairs [key, value].
std::vector<std::string> overrides_of(const Json& changes);

/// A value of an override back: a number in SI, null where the text is none of this key's dimension; true or false;
/// else the text.
Json si_value(const std::string& key, const std::string& text);

}  // namespace railstrata::bridge
