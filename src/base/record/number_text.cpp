#include "record/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace railstrata {
namespace {

std::string in_unit(const Unit& unit, double value_si, const std::string& number) {
  const auto bar = unit.shown.find('|');
  if (bar != std::string_view::npos)
    return std::string(value_si == 0 ? unit.shown.substr(0, bar) : unit.shown.substr(bar + 1));
  return fmt::format("{}{}{}", number, unit.shown.empty() ? "" : " ", unit.shown);
}

}  // namespace

std::string fixed(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return zero && text.starts_with('-') ? text.substr(1) : text;
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size < 1e-4 || size >= 1e7) return fmt::format("{:.{}g}", value, digits);
  const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size))));
  return fmt::format("{:.{}f}", value, decimals);
}

std::string with_unit(const Unit& unit, double value_si, int digits) {
  return in_unit(unit, value_si, significant(unit.factor * value_si, digits));
}

std::string titled(const std::string& name, std::string_view unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

std::string limit_text(const Unit& unit, double value_si) {
  return in_unit(unit, value_si, fmt::format("{:.6g}", unit.factor * value_si));
}

}  // namespace railstrata
