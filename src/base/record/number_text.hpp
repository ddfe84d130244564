#pragma once
// Numbers as people read them.
#include <string>

#include "record/unit.hpp"

namespace railstrata {

/// A number of so many significant digits without an exponent where it can be avoided: "1067", "0.04381", "1.2e-09".
std::string significant(double value, int digits);

/// A number with so many decimals, never "-0.00".
std::string fixed(double value, int decimals);

/// "1067 MPa", "24.6 %", "inside".
std::string with_unit(const Unit& unit, double value_si, int digits);

/// "p_max [MPa]", as in the head of a column or an axis; without a unit only the name.
std::string titled(const std::string& name, std::string_view unit);

/// A limit, without zeros at its end: "4 %", "500 MPa".
std::string limit_text(const Unit& unit, double value_si);

}  // namespace railstrata
