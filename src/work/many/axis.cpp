#include "many/axis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>

#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "core/text.hpp"
#include "options/find_key.hpp"
#include "options/option_table.hpp"
#include "table/force_table.hpp"

namespace railstrata {
namespace {

struct Word {
  std::string_view word, key;
};
constexpr Word kWords[] = {{"creepage_x", "drive.creepage"},
                           {"creepage_y", "drive.lateral_creepage"},
                           {"spin", "drive.spin"},
                           {"load", "vehicle.wheel_load"},
                           {"friction", "drive.friction_coefficient"},
                           {"lateral_shift", "geometry.lateral_shift"},
                           {"yaw", "geometry.yaw"}};

std::string word_of(const std::string& key) {
  for (const Word& w : kWords)
    if (w.key == key) return std::string(w.word);
  return key;
}

bool is_number(const Option* option) {
  if (!option || !option->slot) return false;
  const Slot slot = any_slot(*option);
  return std::holds_alternative<double*>(slot) || std::holds_alternative<std::optional<double>*>(slot);
}

std::vector<std::string> split(std::string_view text, char by) {
  std::vector<std::string> out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(by, begin), text.size());
    out.emplace_back(trimmed(text.substr(begin, end - begin), " \t\"'"));
    begin = end + 1;
  }
  return out;
}

bool both_sides(std::string_view text) { return text.starts_with("+-") || text.starts_with("±"); }
bool is_range(std::string_view text) {
  return both_sides(text) || (std::count(text.begin(), text.end(), ':') == 2 && text.find(',') == text.npos);
}

/// The numbers that a text gives to an option.
class AxisNumbers {
 public:
  /// `said`: the axis as messages name it.
  AxisNumbers(std::string said, const Option& option) : said_(std::move(said)), option_(option) {}

  [[noreturn]] void refuse(const std::string& why, const std::string& remedy = {}) const {
    throw CaseError(
        fmt::format("{}: {}", said_, why),
        remedy.empty() ? "e.g. creepage_x=+-0.02:21, load=\"40 kN,80 kN,120 kN\" or load=\"40:120 kN:3\"" : remedy);
  }

  std::vector<double> operator()(std::string_view given) {
    take_unit(given);
    if (both_sides(given)) return to_both_sides(split(given.substr(2), ':'));
    if (is_range(given)) return range(given);
    std::vector<double> out;
    for (const std::string& value : split(given, ',')) out.push_back(quantity(value));
    return out;
  }

 private:
  static constexpr const char* kNumberLetters = "+-.0123456789eE";

  /// Bare numbers have the unit of the last value that has one: "-0.5:0.5 1/m:5".
  void take_unit(std::string_view given) {
    std::string numbers(given.starts_with("log ") ? given.substr(4) : given);
    std::replace(numbers.begin(), numbers.end(), ':', ',');
    for (const std::string& value : split(numbers, ','))
      if (const std::size_t unit = value.find_first_not_of(kNumberLetters);
          unit != std::string::npos && unit > 0 && value[unit] != '/')  // "1/40" is a slope
        unit_ = value.substr(unit);
  }

  double quantity(const std::string& value) const {
    if (value.empty()) refuse("a value is missing");
    const bool bare = value.find_first_not_of(kNumberLetters) == std::string::npos;
    try {
      const double out = parse_quantity(bare ? value + unit_ : value, option_.dimension);
      if (!option_.range.holds(out))
        refuse(fmt::format("{} is out of range", value),
               fmt::format("give values {}", describe(option_.range, option_.dimension)));
      return out;
    } catch (const UnitError& e) {
      refuse(fmt::format("{}: {}", value, e.what()), weight_of(value).value_or(e.remedy));
    }
  }

  /// A load is a force: the remedy for a mass.
  std::optional<std::string> weight_of(const std::string& value) const {
    if (option_.dimension != dimension::kForce) return std::nullopt;
    try {
      const double mass = parse_quantity(value, dimension::kMass);
      return fmt::format("write the weight as \"{:.6g} kN\" with {:g} m/s^2", 1e-3 * kGravity * mass, kGravity);
    } catch (const UnitError&) {
      return std::nullopt;
    }
  }

  int count(const std::string& value, int least) const {
    int out = 0;
    const auto [end, fault] = std::from_chars(value.data(), value.data() + value.size(), out);
    if (fault != std::errc{} || end != value.data() + value.size() || out < least || out > 1000)
      refuse(fmt::format("the number of values must be an integer, got {}", value),
             fmt::format("give {} to 1000", least));
    return out;
  }

  /// To twelve digits, as people write values: 9 mm, not 9.000000000000001 mm; round-off of `size` is zero.
  static double rounded(double value, double size) {
    return std::abs(value) < 1e-12 * size ? 0 : std::stod(fmt::format("{:.12g}", value));
  }

  std::vector<double> range(std::string_view given) const {
    const bool by_ratio = given.starts_with("log ");
    const std::vector<std::string> parts = split(by_ratio ? given.substr(4) : given, ':');
    const double from = quantity(parts[0]), to = quantity(parts[1]);
    if (by_ratio && !(from * to > 0)) refuse("log needs two values on one side of zero", "or write from:to:count");
    const int n = count(parts[2], 2);
    std::vector<double> out;
    for (int k = 0; k < n; ++k)
      out.push_back(k == n - 1 ? to
                    : by_ratio ? rounded(from * std::pow(to / from, static_cast<double>(k) / (n - 1)), 0)
                               : rounded(from + (to - from) * k / (n - 1), std::abs(to - from)));
    return out;
  }

  std::vector<double> to_both_sides(const std::vector<std::string>& parts) const {
    if (parts.size() != 2) refuse("+- needs a largest value and a number of values");
    const double largest = quantity(parts[0]);
    const int n = count(parts[1], 3), half = n / 2;
    if (n % 2 == 0) refuse(fmt::format("{} values have no middle value", n), "give an odd number");
    std::vector<double> out;
    for (int k = -half; k <= half; ++k) {
      const double size = k == 0 ? 0 : largest * decade_share(std::abs(k), half);
      out.push_back(k < 0 ? -size : size);
    }
    quantity(format_quantity(out.front(), option_.dimension));
    return out;
  }

  std::string said_;
  const Option& option_;
  std::string unit_;
};

struct Said {
  std::string word, values;
};
Said parts_of(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  std::string word(trimmed(std::string_view(text).substr(0, equals), " \t\"'"));
  if (equals == std::string::npos || word.empty())
    throw CaseError(fmt::format("{} \"{}\": expected KEY=VALUES", option, text),
                    fmt::format("write {0} key=value,value, for example {0} layer.0.young_ratio=0.5,1,2", option));
  return {std::move(word), std::string(trimmed(std::string_view(text).substr(equals + 1), " \t\"'"))};
}

template <class AnyAxis>
void refuse_twice(const std::string& option, const std::vector<AnyAxis>& axes) {
  for (std::size_t k = 0; k + 1 < axes.size(); ++k)
    if (axes[k].key == axes.back().key)
      throw CaseError(fmt::format("{} names {} twice", option, axes[k].key),
                      fmt::format("give all values of a key in one {}", option));
}

NumberAxis number_axis(const std::string& option, const std::string& text) {
  const Said said = parts_of(option, text);
  const std::string name = fmt::format("{} {}", option, text);
  NumberAxis out{{axis_key(said.word), {}}, {}, {}, {}};
  out.word = word_of(out.key);
  const Option* found = option_of_key(out.key);
  if (!found) {
    const std::vector<std::string> words = axis_words();
    const std::string near = nearest_word(out.word, words);
    throw CaseError(fmt::format("{}: unknown word or key {}", name, out.word),
                    fmt::format("{}words: {}; keys: railstrata info --schema",
                                near.empty() ? "" : fmt::format("did you mean {}? ", near), fmt::join(words, ", ")));
  }
  AxisNumbers numbers(name, *found);
  if (!is_number(found)) numbers.refuse(fmt::format("{} is no number", out.key));
  out.unit = si_unit(found->dimension);
  out.at = numbers(said.values);
  if (out.at.size() < 2) numbers.refuse("an axis needs at least two values");
  if (std::adjacent_find(out.at.begin(), out.at.end(), std::greater_equal<>()) != out.at.end())
    numbers.refuse("values must be in ascending order", "sort them, each once");
  for (const double v : out.at) out.values.push_back(axis_text(out, v));
  return out;
}

/// Throws CaseError: a key without values makes no case, an empty value sets nothing.
void require_values(const Axis& axis) {
  const bool none = axis.values.empty();
  if (!none && std::find(axis.values.begin(), axis.values.end(), "") == axis.values.end()) return;
  throw CaseError(fmt::format("{} has {}", axis.key, none ? "no values to vary over" : "an empty value to vary over"),
                  "give one value or more, or leave the key out");
}

}  // namespace

const Option* option_of_key(const std::string& key) { return find_key(key).option; }

std::vector<std::string> axis_words() {
  std::vector<std::string> out;
  for (const Word& w : kWords) out.emplace_back(w.word);
  return out;
}

std::string axis_key(const std::string& word) {
  for (const Word& w : kWords)
    if (w.word == word) return std::string(w.key);
  return word;
}

std::string axis_text(const NumberAxis& axis, double value) {
  return format_quantity(value, option_of_key(axis.key)->dimension);
}

bool takes_no_number(const std::string& key) {
  const Option* option = option_of_key(key);
  return option && option->slot && !is_number(option) && !std::holds_alternative<int*>(any_slot(*option));
}

std::string shown_value(const std::string& text) {
  if (!text.starts_with("[")) return text;
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == '"') continue;
    out += c == ',' ? ';' : c;
  }
  return out;
}

std::pair<double, std::string> axis_value(const std::string& text) {
  char* end = nullptr;
  const double v = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return {std::numeric_limits<double>::quiet_NaN(), text};
  std::string unit(end);
  unit.erase(0, std::min(unit.find_first_not_of(' '), unit.size()));
  return {v, unit};
}

double decade_share(int k, int n) {
  constexpr double kDecades = 2.5;
  return std::pow(10.0, -kDecades * (n - k) / n);
}

Axis make_axis(const std::string& word, std::vector<std::string> values) {
  Axis out{axis_key(word), std::move(values)};
  const Option* option = option_of_key(out.key);
  if (out.values.size() != 1 || !is_range(out.values.front()) || !is_number(option)) return out;
  const std::string range(trimmed(out.values.front(), " \t\"'"));
  const std::vector<double> numbers = AxisNumbers(fmt::format("{}={}", word, range), *option)(range);
  out.values.clear();
  for (const double v : numbers) out.values.push_back(format_quantity(v, option->dimension));
  return out;
}

std::vector<Axis> parse_axes(const std::string& option, const std::vector<std::string>& texts) {
  std::vector<Axis> out;
  for (const std::string& text : texts) {
    const Said said = parts_of(option, text);
    out.push_back(make_axis(said.word, split(said.values, ',')));
    for (const std::string& value : out.back().values)
      if (value.empty())
        throw CaseError(fmt::format("{} \"{}\" has an empty value", option, text),
                        fmt::format("write {} key=value,value", option));
    refuse_twice(option, out);
  }
  return out;
}

std::vector<NumberAxis> parse_number_axes(const std::string& option, const std::vector<std::string>& texts) {
  std::vector<NumberAxis> out;
  for (const std::string& text : texts) {
    out.push_back(number_axis(option, text));
    refuse_twice(option, out);
  }
  if (out.empty() || out.size() > kMostAxes)
    throw CaseError(out.empty() ? "no axis is given" : fmt::format("{} axes", out.size()),
                    fmt::format("give 1 to {} of {} creepage_x=+-0.02:21", kMostAxes, option));
  return out;
}

std::vector<std::vector<std::string>> combinations(const std::vector<Axis>& axes, std::size_t most) {
  double cases = 1;
  for (const Axis& axis : axes) {
    require_values(axis);
    cases *= static_cast<double>(axis.values.size());
  }
  if (cases > static_cast<double>(most))
    throw CaseError(fmt::format("the values to vary make {:.6g} cases, more than {}", cases, most),
                    "vary fewer keys at once, or give fewer values");
  std::vector<std::vector<std::string>> out(1);
  for (const Axis& axis : axes) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& head : out)
      for (const std::string& value : axis.values) {
        longer.push_back(head);
        longer.back().push_back(value);
      }
    out = std::move(longer);
  }
  return out;
}

}  // namespace railstrata
