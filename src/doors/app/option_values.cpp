#include "app/option_values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bem/bem_options.hpp"
#include "core/faults.hpp"
#include "text/units.hpp"

namespace railstrata {

double length_of(const std::string& option, const std::string& text) {
  try {
    return parse_quantity(text, dimension::kLength);
  } catch (const UnitError& e) {
    throw CaseError(fmt::format("{} \"{}\": {}", option, text, e.what()), e.remedy);
  }
}

double cell_size(const std::string& text) {
  if (text.empty()) return BemOptions{}.cell;
  const double cell = length_of("--cell", text);
  if (!(cell >= kSmallestCell && cell <= kLargestCell))
    throw CaseError(fmt::format("--cell \"{}\" is out of range", text),
                    fmt::format("write a length from {:g} mm to {:g} mm", 1e3 * kSmallestCell, 1e3 * kLargestCell));
  return cell;
}

double wall_time(const std::string& option, const std::string& text) {
  if (text == "0" || text == "never") return 0;
  try {
    const double seconds = parse_quantity(text, dimension::kTime);
    if (seconds >= 0 && std::isfinite(seconds)) return seconds;
    throw CaseError(fmt::format("{} \"{}\" is out of range", option, text),
                    "write a time, e.g. \"10 min\", or 0 for never");
  } catch (const UnitError& e) {
    throw CaseError(fmt::format("{} \"{}\": {}", option, text, e.what()), e.remedy);
  }
}

}  // namespace railstrata
