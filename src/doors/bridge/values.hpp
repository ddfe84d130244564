#pragma once
// Values of a case as Python has them: numbers are SI.
#include <string>
#include <vector>

#include "bridge/call.hpp"

namespace railstrata::bridge {

/// A value as an override of the key takes it: a number of a key with a unit is SI and gets its unit ("80 kN"), texts
/// stay as they are; the same inside lists and tables.
std::string value_text(const std::string& key, const Json& value);

/// Overrides from a list of those ("key=value") and of pairs [key, value].
std::vector<std::string> overrides_of(const Json& changes);

/// A value of an override back: a number in SI, null where the text is none of this key's dimension; true or false;
/// else the text.
Json si_value(const std::string& key, const std::string& text);

}  // namespace railstrata::bridge
