#include "text/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <vector>

#include "core/nearest_word.hpp"
#include "core/text.hpp"

namespace railstrata {
namespace {

/// A unit is factor * 10^decimals in SI; the power of ten is kept apart so that decimal prefixes cost no rounding.
struct InputUnit {
  double factor = 1;
  int decimals = 0;
  Dimension dimension;
};

struct Symbol {
  std::string_view text;
  InputUnit unit;
  bool takes_prefix;
};

constexpr double kBrinellOverVickers = 0.95;

const std::array kSymbols{
    Symbol{"kg", {1, 0, dimension::kMass}, false},
    Symbol{"g", {1, -3, dimension::kMass}, true},
    Symbol{"t", {1, 3, dimension::kMass}, false},
    Symbol{"Mt", {1, 9, dimension::kMass}, false},
    Symbol{"MGT", {1, 9, dimension::kMass}, false},
    Symbol{"m", {1, 0, dimension::kLength}, true},
    Symbol{"s", {1, 0, dimension::kTime}, true},
    Symbol{"min", {60, 0, dimension::kTime}, false},
    Symbol{"h", {3600, 0, dimension::kTime}, false},
    Symbol{"N", {1, 0, {1, 1, -2, 0}}, true},
    Symbol{"Pa", {1, 0, dimension::kPressure}, true},
    Symbol{"Hz", {1, 0, dimension::kRate}, true},
    Symbol{"J", {1, 0, {1, 2, -2, 0}}, true},
    Symbol{"W", {1, 0, {1, 2, -3, 0}}, true},
    Symbol{"K", {1, 0, dimension::kTemperature}, false},
    Symbol{"√m", {1, 0, {0, 0, 0, 0, 0, 1}}, false},
    Symbol{"HV", {1, 0, dimension::kHardness}, false},
    Symbol{"HBW", {1 / kBrinellOverVickers, 0, dimension::kHardness}, false},
    Symbol{"HB", {1 / kBrinellOverVickers, 0, dimension::kHardness}, false},
    Symbol{"dB", {1, 0, dimension::kLevel}, false},
    Symbol{"rad", {1, 0, dimension::kSlope}, true},
    Symbol{"in", {0.0254, 0, dimension::kLength}, false},
    Symbol{"ft", {0.3048, 0, dimension::kLength}, false},
    Symbol{"mph", {0.44704, 0, dimension::kSpeed}, false},
    Symbol{"lbf", {4.4482216152605, 0, dimension::kForce}, false},
    Symbol{"kip", {4.4482216152605, 3, dimension::kForce}, false},
    Symbol{"psi", {6894.757293168361, 0, dimension::kPressure}, false},
    Symbol{"ksi", {6894.757293168361, 3, dimension::kPressure}, false},
    Symbol{"rpm", {2 * std::numbers::pi / 60, 0, dimension::kRotation}, false},
    Symbol{"deg", {std::numbers::pi / 180, 0, dimension::kSlope}, false},
    Symbol{"°", {std::numbers::pi / 180, 0, dimension::kSlope}, false},
    Symbol{"%", {1, -2, dimension::kNumber}, false},
    Symbol{"1", {1, 0, dimension::kNumber}, false},
};

struct Prefix {
  std::string_view text;
  int decimals;
};
/// The sign micro, U+00B5, and the Greek letter, U+03BC, look the same.
constexpr std::array kPrefixes{Prefix{"G", 9},       Prefix{"M", 6},  Prefix{"k", 3},
                               Prefix{"c", -2},      Prefix{"m", -3}, Prefix{"\u00B5", -6},
                               Prefix{"\u03BC", -6}, Prefix{"u", -6}, Prefix{"n", -9}};

/// How people write each dimension: the first unit is the one values are shown in. si: as names of columns have it.
struct Customary {
  Dimension dimension;
  std::string_view si, noun, example;
  std::vector<std::string_view> units;
};
const std::vector<Customary>& customary() {
  static const std::vector<Customary> all{
      {dimension::kNumber, "", "a number", "0.2", {""}},
      {dimension::kLength, "m", "a length", "0.2 mm", {"mm", "m", "µm", "cm"}},
      {dimension::kMass, "kg", "a mass", "8000 kg", {"kg", "t", "Mt"}},
      {dimension::kTime, "s", "a time", "1.5 ms", {"ms", "s", "µs"}},
      {dimension::kSpeed, "m/s", "a speed", "100 km/h", {"m/s", "km/h"}},
      {dimension::kRate, "1/s", "a rate", "2000 1/s", {"1/s", "Hz", "kHz"}},
      {dimension::kPressure, "Pa", "a pressure or modulus", "210 GPa", {"GPa", "MPa", "Pa"}},
      {dimension::kDensity, "kg/m3", "a density", "7800 kg/m^3", {"kg/m^3", "t/m^3", "g/cm^3"}},
      {dimension::kStiffness, "N/m", "a stiffness", "0.95 MN/m", {"MN/m", "kN/mm", "kN/m", "N/mm", "N/m"}},
      {dimension::kDamping, "N s/m", "a damping", "10.4 kN s/m", {"kN s/m", "N s/m"}},
      {dimension::kPressureGradient, "Pa/m", "a stress by displacement", "400 MPa/mm", {"MPa/mm", "N/mm^3", "GPa/m"}},
      {dimension::kForce, "N", "a force", "85 kN", {"kN", "N", "MN"}},
      {dimension::kSpin, "1/m", "a spin", "0.1 1/m", {"1/m", "rad/m", "1/mm", "rad/mm"}},
      {dimension::kToughness, "Pa m^0.5", "a fracture toughness", "15 MPa √m", {"MPa √m", "MPa m^0.5"}},
      {dimension::kConductivity, "W/(m K)", "a thermal conductivity", "50 W/(m K)", {"W/(m K)"}},
      {dimension::kHeatCapacity, "J/(kg K)", "a specific heat capacity", "460 J/(kg K)", {"J/(kg K)"}},
      {dimension::kTemperature, "K", "a temperature difference", "700 K", {"K"}},
      {dimension::kHardness, "HV", "a hardness", "380 HV", {"HV", "HBW"}},
      {dimension::kLevel, "dB", "a level over 1 µm", "5 dB", {"dB"}},
      {dimension::kReceptance, "m/N", "a receptance", "2 nm/N", {"nm/N", "m/N"}},
      {dimension::kMobility, "m/(s N)", "a mobility", "1e-5 m/(s N)", {"m/(s N)", "mm/(s N)"}},
      {dimension::kAccelerance, "m/(s^2 N)", "an accelerance", "0.1 m/(s^2 N)", {"m/(s^2 N)", "1/kg"}},
      {dimension::kRotation, "rad/s", "a rotation", "400 rpm", {"rpm", "rad/s"}},
      {dimension::kSlope, "", "an inclination", "1:40", {"", "mrad", "rad", "deg"}},
      {dimension::kAngle, "rad", "an angle", "25 deg", {"deg", "rad", "mrad"}},
  };
  return all;
}
const Customary& customary(const Dimension& dimension) {
  for (const Customary& c : customary())
    if (c.dimension == dimension) return c;
  throw std::logic_error("dimension without customary units");
}

std::vector<std::string> units_of(const Dimension& dimension) {
  std::vector<std::string> out;
  for (const std::string_view unit : customary(dimension).units)
    if (!unit.empty()) out.emplace_back(unit);
  return out;
}

std::string_view trim(std::string_view text) { return trimmed(text, " \t"); }

/// Length of the decimal number at the start of the text (0: none). An exponent counts only when digits follow it.
std::size_t number_length(std::string_view text) {
  double ignored = 0;
  const std::size_t sign = !text.empty() && text[0] == '+' ? 1 : 0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), ignored);
  if (error != std::errc() && error != std::errc::result_out_of_range) return 0;
  return static_cast<std::size_t>(end - text.data());
}

constexpr int kHugeExponent = 1'000'000;
constexpr Dimension kAngleOverLength{0, -1, 0, 1};

/// The number times 10^decimals, rounded once.
double scaled_number(std::string_view number, int decimals) {
  int exponent = 0;
  std::string_view mantissa = number[0] == '+' ? number.substr(1) : number;
  if (const auto e = mantissa.find_first_of("eE"); e != std::string_view::npos) {
    std::string_view digits = mantissa.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec == std::errc::result_out_of_range)
      exponent = digits.starts_with('-') ? -kHugeExponent : kHugeExponent;
    exponent = std::clamp(exponent, -kHugeExponent, kHugeExponent);
    mantissa = mantissa.substr(0, e);
  }
  const std::string text = fmt::format("{}e{}", mantissa, exponent + decimals);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)
    value = std::strtod(text.c_str(), nullptr);  // infinite, or as good as zero
  return value;
}

/// "HV10", "HV0.5": the load of the test stands behind the scale.
std::string_view without_test_load(std::string_view text) {
  constexpr std::string_view kVickers = "HV";
  const std::string_view load = text.starts_with(kVickers) ? text.substr(kVickers.size()) : std::string_view();
  return load.find_first_not_of("0123456789.,") == std::string_view::npos && !load.empty() ? kVickers : text;
}

std::optional<InputUnit> find_symbol(std::string_view written) {
  const std::string_view text = without_test_load(written);
  for (const Symbol& s : kSymbols)
    if (s.text == text) return s.unit;
  for (const Prefix& p : kPrefixes) {
    if (!text.starts_with(p.text)) continue;
    for (const Symbol& s : kSymbols)
      if (s.takes_prefix && s.text == text.substr(p.text.size()))
        return InputUnit{s.unit.factor, s.unit.decimals + p.decimals, s.unit.dimension};
  }
  return std::nullopt;
}

/// "write a length, e.g. "0.2 mm" (units: mm, m, µm, cm)".
std::string how_to_write(const Dimension& dimension) {
  const std::vector<std::string> units = units_of(dimension);
  return fmt::format("write {}{}", describe(dimension),
                     units.empty() ? "" : fmt::format(" (units: {})", fmt::join(units, ", ")));
}

UnitError unknown_unit(std::string_view unit, const Dimension& expected) {
  if (expected == dimension::kTemperature && (unit == "°C" || unit == "degC" || unit == "C"))
    return UnitError(fmt::format("unknown unit \"{}\"", unit),
                     "write the same number in K, \"20 K\" for 20 °C: only differences count");
  if (expected == dimension::kHardness && unit == "HRC")
    return UnitError("the unit \"HRC\" has no factor to HV", "write it in HV, by the table of ISO 18265");
  const std::string near = nearest_word(unit, units_of(expected));
  return UnitError(fmt::format("unknown unit \"{}\"", unit),
                   near.empty() ? how_to_write(expected) : fmt::format("did you mean {}?", near));
}

/// "0,5 mm": what to write instead. Three digits behind the comma may also mean thousands.
UnitError comma_in_number(std::string_view whole, std::size_t comma) {
  const std::string before(whole.substr(0, comma)), after(whole.substr(comma + 1));
  const std::size_t digits = std::min(after.find_first_not_of("0123456789"), after.size());
  const std::string with_point = fmt::format("\"{}.{}\"", before, after);
  return UnitError("has a comma in the number",
                   digits == 3 ? fmt::format("write {}, or \"{}{}\" if thousands are meant", with_point, before, after)
                               : fmt::format("numbers have a decimal point: write {}", with_point));
}

bool starts_with_comma(std::string_view text) {
  return text.size() > 1 && text[0] == ',' && text[1] >= '0' && text[1] <= '9';
}

void multiply(InputUnit& total, const InputUnit& u, int power) {
  total.factor *= std::pow(u.factor, power);
  total.decimals += power * u.decimals;
  for (std::size_t k = 0; k < total.dimension.exponents.size(); ++k)
    total.dimension.exponents[k] += power * u.dimension.exponents[k];
}

/// "m^3", "m³", "m3" is not a power: it stays an unknown symbol. Returns the power and cuts it off.
int take_power(std::string_view& symbol) {
  for (const auto& [mark, power] : {std::pair{std::string_view("²"), 2}, {"³", 3}, {"^2", 2}, {"^3", 3}})
    if (symbol.ends_with(mark)) {
      symbol.remove_suffix(mark.size());
      return power;
    }
  return 1;
}

/// "MPa√m" and "MPa m^0.5" as "MPa √m".
std::string with_root_sign(std::string_view unit) {
  std::string out(unit);
  const auto replace_all = [&](std::string_view from, std::string_view to) {
    for (auto at = out.find(from); at != std::string::npos; at = out.find(from, at + to.size()))
      out.replace(at, from.size(), to);
  };
  for (const std::string_view power : {"m^0.5", "m^(1/2)", "m^½"}) replace_all(power, "√m");
  replace_all("√m", " √m");
  return out;
}

InputUnit parse_unit(std::string_view whole, const Dimension& expected);

/// "W/(m K)": what stands in brackets behind the only solidus is divided; without brackets nothing is.
std::optional<InputUnit> parse_divided_group(std::string_view whole, const Dimension& expected) {
  const auto at = whole.find("/(");
  if (at == std::string_view::npos || !whole.ends_with(')')) return std::nullopt;
  const std::string_view above = whole.substr(0, at), group = whole.substr(at + 2, whole.size() - at - 3);
  if (above.find('/') != std::string_view::npos || group.find_first_of("/()") != std::string_view::npos)
    return std::nullopt;
  InputUnit total = parse_unit(above, expected);
  multiply(total, parse_unit(group, expected), -1);
  return total;
}

InputUnit parse_unit(std::string_view whole, const Dimension& expected) {
  if (const auto divided = parse_divided_group(whole, expected)) return *divided;
  static constexpr std::array<std::string_view, 6> kSeparators{" ", "\t", "*", "·", "⋅", "/"};
  InputUnit total;
  bool divide = false, after_solidus = false;
  std::string_view rest = whole;
  while (!rest.empty()) {
    std::size_t cut = rest.size();
    std::string_view separator;
    for (std::string_view s : kSeparators)
      if (const auto at = rest.find(s); at < cut) {
        cut = at;
        separator = s;
      }
    if (std::string_view symbol = rest.substr(0, cut); !symbol.empty()) {
      if (after_solidus && !divide)
        throw UnitError(fmt::format("the unit \"{}\" is ambiguous", whole),
                        "put the divided unit last, e.g. \"kN s/m\"");
      const int power = take_power(symbol);
      const auto unit = find_symbol(symbol);
      if (!unit) throw unknown_unit(whole, expected);
      multiply(total, *unit, divide ? -power : power);
      divide = false;
    }
    if (separator == "/") {
      if (after_solidus)
        throw UnitError(fmt::format("the unit \"{}\" has two solidi", whole), "write one, e.g. \"kg/m^3\"");
      divide = after_solidus = true;
    }
    rest.remove_prefix(std::min(rest.size(), cut + separator.size()));
  }
  if (divide) throw unknown_unit(whole, expected);
  return total;
}

std::optional<double> parse_ratio(std::string_view text) {
  const auto colon = text.find_first_of(":/");
  if (colon == std::string_view::npos) return std::nullopt;
  const std::string_view up = trim(text.substr(0, colon)), along = trim(text.substr(colon + 1));
  if (up.empty() || along.empty() || number_length(up) != up.size() || number_length(along) != along.size())
    return std::nullopt;
  const double run = scaled_number(along, 0);
  if (run == 0) return std::nullopt;
  return scaled_number(up, 0) / run;
}

}  // namespace

double parse_quantity(std::string_view whole, const Dimension& expected) {
  const std::string plain = plain_signs(whole);
  const std::string_view text = trim(plain);
  if (expected == dimension::kSlope)
    if (const auto ratio = parse_ratio(text)) return *ratio;
  const std::size_t length = number_length(text);
  if (length == 0) throw UnitError("does not start with a number", fmt::format("write {}", describe(expected)));
  const std::string_view number = text.substr(0, length), unit_text = trim(text.substr(length));
  const bool needs_unit = !(expected == dimension::kNumber || expected == dimension::kSlope);
  if (unit_text.empty()) {
    if (needs_unit) throw UnitError("has no unit", fmt::format("write {}", describe(expected)));
    return scaled_number(number, 0);
  }
  if (starts_with_comma(text.substr(length))) throw comma_in_number(text, length);
  const InputUnit unit = parse_unit(with_root_sign(unit_text), expected);
  const bool without_radian = expected == dimension::kSlope && unit.dimension == dimension::kNumber,
             with_radian = expected == dimension::kSpin && unit.dimension == kAngleOverLength,
             angle = expected == dimension::kAngle && unit.dimension == dimension::kSlope;
  if (unit.dimension != expected && !without_radian && !with_radian && !angle)
    throw UnitError(fmt::format("\"{}\" is not the unit of {}", unit_text, customary(expected).noun),
                    how_to_write(expected));
  const double scaled = scaled_number(number, unit.decimals);
  const double value = unit.factor == 1 ? scaled : scaled * unit.factor;
  if (unit.dimension != dimension::kSlope || angle) return value;
  if (!(std::abs(value) < std::numbers::pi / 2))
    throw UnitError("is upright or beyond", fmt::format("write {}", describe(expected)));
  return std::tan(value);
}

std::string format_quantity(double value, const Dimension& dimension) {
  // Of a unit that is a power of ten of SI: moving the decimal point of the shortest text keeps it exact.
  const auto& units = customary(dimension).units;
  const std::string_view shown = *std::find_if(units.begin(), units.end(), [&](std::string_view unit) {
    return unit.empty() || parse_unit(unit, dimension).factor == 1;
  });
  if (shown.empty() || !std::isfinite(value)) return fmt::format("{}", value);
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.begin(), buffer.end(), value, std::chars_format::scientific).ptr;
  const std::string_view shortest(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
  const auto e = shortest.find('e');
  const std::string moved = fmt::format("{}e{}", shortest.substr(0, e),
                                        std::atoi(shortest.data() + e + 1) - parse_unit(shown, dimension).decimals);
  const std::string plain = fmt::format("{} {}", std::strtod(moved.c_str(), nullptr), shown);
  return parse_quantity(plain, dimension) == value ? plain : fmt::format("{} {}", moved, shown);
}

std::string describe(const Dimension& dimension) {
  const Customary& c = customary(dimension);
  const std::string_view quote = dimension == dimension::kNumber ? "" : "\"";
  return fmt::format("{}, e.g. {}{}{}", c.noun, quote, c.example, quote);
}

std::string si_unit(const Dimension& dimension) { return std::string(customary(dimension).si); }

std::string suggest_quantity(std::string_view whole, const Dimension& dimension,
                             const std::function<bool(double)>& allowed) {
  const std::string_view text = trim(whole), number = text.substr(0, number_length(text));
  if (number.empty() || scaled_number(number, 0) == 0) return {};
  for (std::string_view unit : customary(dimension).units) {
    if (unit.empty() || unit.starts_with("µ")) continue;  // micro is no likely typing error for mm or s
    std::string candidate = fmt::format("{} {}", number, unit);
    if (allowed(parse_quantity(candidate, dimension))) return candidate;
  }
  return {};
}

}  // namespace railstrata
