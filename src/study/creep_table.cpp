#include "study/creep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "case/option_table.hpp"
#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "core/parallel.hpp"
#include "judge/bem_summary.hpp"
#include "model/model.hpp"
#include "runs/solve_half_space.hpp"
#include "study/for_each_ended.hpp"

namespace railstrata {
namespace {

constexpr double kDecades = 2.5;
constexpr const char* kExample = "e.g. --axis creepage_x=+-0.02:21 --axis load=\"40 kN,80 kN,120 kN\"";

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
constexpr std::size_t kCreepages = 3;  // the first words

/// Of a creepage's axis and another key of the same direction the case can have one.
constexpr std::pair<std::string_view, std::string_view> kRivals[] = {
    {"drive.creepage", "drive.traction_coefficient"},
    {"drive.creepage", "drive.tractive_force"},
    {"drive.lateral_creepage", "drive.lateral_traction_coefficient"},
    {"drive.lateral_creepage", "drive.lateral_force"}};

bool is_creepage(const CreepAxis& axis) {
  return std::any_of(kWords, kWords + kCreepages, [&](const Word& w) { return w.key == axis.key; });
}

/// The option of "table.option" or "table.index.option".
const Option* option_of(const std::string& key) {
  const std::size_t last = key.rfind('.');
  if (last == std::string::npos) return nullptr;
  std::string table = key.substr(0, last);
  if (const std::size_t dot = table.rfind('.'); dot != std::string::npos)
    if (table.find_first_not_of("0123456789", dot + 1) == std::string::npos) table.resize(dot);
  const OptionTable* found = find_table(table);
  if (!found) return nullptr;
  for (const Option& option : found->options)
    if (option.key == key.substr(last + 1)) return &option;
  return nullptr;
}

bool is_number(const Option& option) {
  const Slot slot = any_slot(option);
  return std::holds_alternative<double*>(slot) || std::holds_alternative<std::optional<double>*>(slot);
}

struct UnitWord {
  Dimension dimension;
  const char* unit;
};
const UnitWord kUnits[] = {{dimension::kNumber, ""},       {dimension::kLength, "m"}, {dimension::kForce, "N"},
                           {dimension::kPressure, "Pa"},   {dimension::kMass, "kg"},  {dimension::kTime, "s"},
                           {dimension::kSpeed, "m/s"},     {dimension::kSpin, "1/m"}, {dimension::kSlope, ""},
                           {dimension::kDensity, "kg/m3"}, {dimension::kRate, "1/s"}, {dimension::kHardness, "HV"}};

std::string unit_of(const Option& option) {
  for (const UnitWord& u : kUnits)
    if (u.dimension == option.dimension) return u.unit;
  return "SI";
}

[[noreturn]] void refuse(const std::string& text, const std::string& why, const std::string& remedy = kExample) {
  throw CaseError(fmt::format("--axis {}: {}", text, why), remedy);
}

std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> out;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(by, begin)) != std::string::npos; begin = end + 1)
    out.push_back(text.substr(begin, end - begin));
  out.push_back(text.substr(begin));
  for (std::string& part : out) {
    part.erase(0, part.find_first_not_of(" \"'"));
    part.erase(part.find_last_not_of(" \"'") + 1);
  }
  return out;
}

/// One axis that is being read.
class AxisText {
 public:
  AxisText(const std::string& text, const Option& option) : text_(text), option_(option) {}

  /// Bare numbers have the unit of the last value that has one: "-0.5:0.5 1/m:5".
  std::vector<double> values(const std::string& given) {
    std::string numbers = given;
    std::replace(numbers.begin(), numbers.end(), ':', ',');
    for (const std::string& value : split(numbers, ','))
      if (const std::size_t unit = value.find_first_not_of(kNumberLetters);
          unit != std::string::npos && unit > 0 && value[unit] != '/')  // "1/40" is a slope
        unit_ = value.substr(unit);
    if (given.starts_with("+-") || given.starts_with("±")) return both_sides(given.substr(2));
    if (given.find(':') != std::string::npos && given.find(',') == std::string::npos &&
        std::count(given.begin(), given.end(), ':') == 2)
      return range(split(given, ':'));
    std::vector<double> out;
    for (const std::string& value : split(given, ',')) out.push_back(quantity(value));
    return out;
  }

 private:
  double quantity(const std::string& value) const {
    if (value.empty()) refuse(text_, "a value is missing");
    const bool bare = value.find_first_not_of(kNumberLetters) == std::string::npos;
    try {
      const double out = parse_quantity(bare ? value + unit_ : value, option_.dimension);
      if (!option_.range.holds(out))
        refuse(text_, fmt::format("{} is out of range", value),
               fmt::format("give values {}", describe(option_.range, option_.dimension)));
      return out;
    } catch (const UnitError& e) {
      refuse(text_, fmt::format("{}: {}", value, e.what()), weight_of(value).value_or(e.remedy));
    }
  }
  /// A load is a force: the remedy for a mass.
  std::optional<std::string> weight_of(const std::string& value) const {
    constexpr double kGravity = 9.81;  // m/s², that of a case that says none
    if (option_.dimension != dimension::kForce) return std::nullopt;
    try {
      const double weight = kGravity * parse_quantity(value, dimension::kMass);
      return fmt::format("write the weight, \"{:.6g} kN\" under 9.81 m/s^2", 1e-3 * weight);
    } catch (const UnitError&) {
      return std::nullopt;
    }
  }
  int count(const std::string& value, int least) const {
    int out = 0;
    const auto [end, fault] = std::from_chars(value.data(), value.data() + value.size(), out);
    if (fault != std::errc{} || end != value.data() + value.size() || out < least || out > 1000)
      refuse(text_, fmt::format("{} is no number of values", value), fmt::format("give {} to 1000", least));
    return out;
  }
  std::vector<double> range(const std::vector<std::string>& parts) const {
    const double from = quantity(parts[0]), to = quantity(parts[1]);
    const int n = count(parts[2], 2);
    std::vector<double> out;
    for (int k = 0; k < n; ++k) out.push_back(k == n - 1 ? to : from + (to - from) * k / (n - 1));
    return out;
  }
  std::vector<double> both_sides(const std::string& given) const {
    const std::vector<std::string> parts = split(given, ':');
    if (parts.size() != 2) refuse(text_, "+- wants a largest value and a number of values");
    const double largest = quantity(parts[0]);
    const int n = count(parts[1], 3), half = n / 2;
    if (n % 2 == 0) refuse(text_, fmt::format("{} values have none in the middle", n), "give an odd number");
    std::vector<double> out;
    for (int k = -half; k <= half; ++k) {
      const double size = k == 0 ? 0 : largest * std::pow(10.0, -kDecades * (half - std::abs(k)) / half);
      out.push_back(k < 0 ? -size : size);
    }
    quantity(format_quantity(out.front(), option_.dimension));
    return out;
  }
  static constexpr const char* kNumberLetters = "+-.0123456789eE";
  const std::string& text_;
  const Option& option_;
  std::string unit_;
};

[[noreturn]] void refuse_word(const std::string& text, const std::string& word) {
  const std::vector<std::string> words = creep_table_words();
  const std::string near = nearest_word(word, words);
  refuse(text, fmt::format("there is no word or key {}", word),
         fmt::format("{}words: {}; keys: railstrata schema", near.empty() ? "" : fmt::format("did you mean {}? ", near),
                     fmt::join(words, ", ")));
}

CreepAxis parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse(text, "there is no =");
  CreepAxis out;
  out.word = text.substr(0, equals);
  const Word* word =
      std::find_if(std::begin(kWords), std::end(kWords), [&](const Word& w) { return w.word == out.word; });
  out.key = word != std::end(kWords) ? std::string(word->key) : out.word;
  for (const Word& w : kWords)
    if (w.key == out.key) out.word = w.word;
  const Option* option = option_of(out.key);
  if (!option) refuse_word(text, out.word);
  if (!is_number(*option)) refuse(text, fmt::format("{} is no number", out.key));
  out.unit = unit_of(*option);
  out.at = AxisText(text, *option).values(text.substr(equals + 1));
  if (out.at.size() < 2) refuse(text, "an axis has two values or more");
  if (std::adjacent_find(out.at.begin(), out.at.end(), std::greater_equal<>()) != out.at.end())
    refuse(text, "values do not ascend", "sort them, each once");
  for (const double v : out.at) out.texts.push_back(format_quantity(v, option->dimension));
  return out;
}

struct Number {
  const char *name, *unit;
  double (*of)(const CaseSpec&, const BemResult&, const ContactSummary&);
};
double dissipated(const BemResult& r) {
  double out = r.dissipation;
  for (const BemPatch& p : r.further) out += p.dissipation;
  return out;
}
constexpr Number kNumbers[] = {
    {"force_x", "N", [](const CaseSpec&, const BemResult&, const ContactSummary& c) { return c.F_x; }},
    {"lateral_force", "N", [](const CaseSpec&, const BemResult&, const ContactSummary& c) { return c.lateral_force; }},
    {"normal_force", "N", [](const CaseSpec&, const BemResult&, const ContactSummary& c) { return c.normal_force; }},
    {"spin_moment", "N m", [](const CaseSpec&, const BemResult&, const ContactSummary& c) { return c.spin_moment; }},
    {"approach", "m", [](const CaseSpec&, const BemResult&, const ContactSummary& c) { return c.approach; }},
    {"p_max", "Pa", [](const CaseSpec&, const BemResult&, const ContactSummary& c) { return c.patch.p_max; }},
    {"patch_area", "m2", [](const CaseSpec&, const BemResult&, const ContactSummary& c) { return c.patch.area; }},
    {"slip", "", [](const CaseSpec&, const BemResult&, const ContactSummary& c) { return c.patch.slip_area_fraction; }},
    {"dissipation", "W", [](const CaseSpec&, const BemResult& r, const ContactSummary&) { return dissipated(r); }},
    {"bound", "", [](const CaseSpec& s, const BemResult&, const ContactSummary& c) {
       return std::hypot(c.F_x, c.lateral_force) / (s.drive.friction_coefficient * c.normal_force);
     }}};
constexpr std::size_t kNumberCount = std::size(kNumbers);

void set_creepage(CaseSpec& spec, std::string_view key, double value) {
  if (key == kWords[0].key) spec.drive.creepage = value;
  if (key == kWords[2].key) spec.drive.spin = value;
  if (key != kWords[1].key) return;
  spec.drive.lateral_creepage = value;
  spec.drive.lateral_traction_coefficient.reset();
}

std::array<double, kNumberCount> numbers_of(const CaseSpec& spec, const Placement& placement, const BemOptions& bem) {
  const BemResult result = solve_bem(spec, placement, bem);
  const Summary summary = bem_contact_summary(spec, result);
  for (const Check& check : summary.checks)
    if (!check.ok)
      throw CaseError(fmt::format("check {} fails: {:.3g}, limit {:.3g}", check.name, check.value, check.limit));
  std::array<double, kNumberCount> out{};
  for (std::size_t k = 0; k < kNumberCount; ++k) out[k] = kNumbers[k].of(spec, result, summary.contact);
  return out;
}

/// What half-space theory takes of a case whose wheel rolls, whatever run.rolling says.
CaseSpec rolling_case(CaseSpec spec) {
  spec.run.rolling = true;
  return half_space_case(std::move(spec));
}

/// The case with an axis' value in it. Where that is refused, the axis is named instead of the setting.
LoadedCase with_values(const LoadedCase& base, const std::vector<std::string>& overrides,
                       const std::vector<CreepAxis>& axes, const std::vector<std::string>& texts) {
  std::vector<std::string> all = overrides;
  for (std::size_t k = 0; k < axes.size(); ++k) all.push_back(fmt::format("{}=\"{}\"", axes[k].key, texts[k]));
  try {
    return parse_case(base.source_text, base.file, all);
  } catch (CaseError& e) {
    for (Diagnostic& d : e.diagnostics)
      for (std::size_t k = 0; k < axes.size(); ++k)
        if (d.where == fmt::format("--set {}=\"{}\"", axes[k].key, texts[k]))
          d.where = fmt::format("--axis {}, {}", axes[k].word, texts[k]);
    throw CaseError(e.diagnostics);
  }
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

/// The case at a combination of what is no creepage, or why there is none.
struct CreepTable::Outer {
  std::optional<CaseSpec> spec;
  Placement placement;
  std::string fault;
};

std::vector<std::string> creep_table_words() {
  std::vector<std::string> out;
  for (const Word& w : kWords) out.emplace_back(w.word);
  return out;
}

std::vector<CreepAxis> parse_axes(const std::vector<std::string>& options) {
  std::vector<CreepAxis> out;
  for (const std::string& text : options) {
    out.push_back(parse_axis(text));
    for (std::size_t k = 0; k + 1 < out.size(); ++k) {
      if (out[k].key == out.back().key) refuse(text, fmt::format("{} has two axes", out[k].word), "give it once");
      for (const auto& [creepage, force] : kRivals)
        if ((out[k].key == creepage && out.back().key == force) || (out[k].key == force && out.back().key == creepage))
          refuse(text, fmt::format("{} and {} are both axes: one gives the other", out[k].word, out.back().word),
                 "keep one of them");
    }
  }
  if (out.empty()) throw CaseError("there is no axis", kExample);
  if (out.size() > kMostAxes)
    throw CaseError(fmt::format("{} axes", out.size()), fmt::format("give {} at most", kMostAxes));
  return out;
}

/// Points along one axis, in its order.
struct CreepTable::Row {
  std::vector<std::size_t> index;  ///< of its first point, per axis
  std::size_t first = 0, stride = 1;
};

CreepTable::~CreepTable() = default;
CreepTable::CreepTable(CreepTable&&) noexcept = default;

CreepTable::CreepTable(const LoadedCase& base, const std::vector<std::string>& overrides, std::vector<CreepAxis> axes)
    : base_(base),
      overrides_(overrides),
      axes_(std::move(axes)),
      row_axis_(axes_.size() - 1),
      noting_(std::make_unique<std::mutex>()) {
  std::size_t combinations = 1;
  double points_asked = 1;
  for (const CreepAxis& axis : axes_) points_asked *= static_cast<double>(axis.at.size());
  if (points_asked > kMostTablePoints)
    throw CaseError(fmt::format("{:.7g} points", points_asked), fmt::format("give {} at most", kMostTablePoints));
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    table_.axes.push_back({axes_[k].word, axes_[k].unit, axes_[k].at});
    if (is_creepage(axes_[k]))
      row_axis_ = k;
    else
      combinations *= axes_[k].at.size();
  }
  for (const Number& n : kNumbers) table_.numbers.push_back({n.name, n.unit, std::vector<double>(points(), NAN)});
  std::optional<CaseError> first_error;
  for (std::size_t c = 0; c < combinations; ++c) {
    std::vector<std::string> texts(axes_.size());
    std::size_t rest = c;
    for (std::size_t k = axes_.size(); k-- > 0;) {
      if (is_creepage(axes_[k])) {
        texts[k] = axes_[k].texts.front();  // in place of the case's own traction
        continue;
      }
      texts[k] = axes_[k].texts[rest % axes_[k].at.size()];
      rest /= axes_[k].at.size();
    }
    outer_.emplace_back();
    try {
      const LoadedCase loaded = with_values(base, overrides_, axes_, texts);
      outer_.back().spec = rolling_case(loaded.spec);
      outer_.back().placement = place(*outer_.back().spec, loaded.folder());
    } catch (const CaseError& e) {
      outer_.back().spec.reset();
      outer_.back().fault = first_line(e.what());
      if (!first_error) first_error = e;
    }
  }
  if (std::none_of(outer_.begin(), outer_.end(), [](const Outer& o) { return o.spec.has_value(); })) throw *first_error;
}

std::size_t CreepTable::missing() const {
  const std::vector<double>& force = table_.numbers.front().values;
  return static_cast<std::size_t>(std::count_if(force.begin(), force.end(), [](double v) { return std::isnan(v); }));
}

std::size_t CreepTable::outer_of(const std::vector<std::size_t>& index) const {
  std::size_t out = 0;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    if (!is_creepage(axes_[k])) out = out * axes_[k].at.size() + index[k];
  return out;
}

CaseSpec CreepTable::spec_at(const Outer& outer, const std::vector<double>& point) const {
  CaseSpec spec = *outer.spec;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    if (is_creepage(axes_[k])) set_creepage(spec, axes_[k].key, point[k]);
  return spec;
}

CreepTable::Row CreepTable::row(std::size_t number) const {
  Row out;
  out.index.resize(axes_.size());
  std::size_t stride = 1;
  for (std::size_t k = axes_.size(); k-- > 0;) {
    const std::size_t n = axes_[k].at.size();
    if (k == row_axis_) {
      out.stride = stride;
    } else {
      out.index[k] = number % n;
      number /= n;
      out.first += out.index[k] * stride;
    }
    stride *= n;
  }
  return out;
}

void CreepTable::note_fault(const std::vector<double>& point, const std::string& fault) {
  const std::lock_guard lock(*noting_);
  std::string place;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    place += fmt::format("{}{} = {:.6g}{}{}", k == 0 ? "" : ", ", axes_[k].word, point[k],
                         axes_[k].unit.empty() ? "" : " ", axes_[k].unit);
  const std::string text = first_line(fault);
  if (faults_.size() < 20) faults_.push_back(fmt::format("{}: {}", place, text));
}

void CreepTable::take(const ForceTable& earlier) {
  const auto same = [](const TableAxis& a, const TableAxis& b) { return a.name == b.name && a.at == b.at; };
  if (!std::equal(table_.axes.begin(), table_.axes.end(), earlier.axes.begin(), earlier.axes.end(), same))
    throw CaseError("the table that was begun has other axes",
                    "give those of its beginning, or another --out without --resume");
  for (TableNumber& number : table_.numbers)
    for (const TableNumber& n : earlier.numbers)
      if (n.name == number.name) number.values = n.values;
}

std::vector<CreepTable::Numbers> CreepTable::solve_row(const Row& row, const CreepTableOptions& options,
                                                       InfluenceCache& cache) {
  BemOptions bem = options.bem;
  BemNeighbour neighbour;
  bem.cache = &cache;
  bem.neighbour = &neighbour;
  std::vector<std::size_t> index = row.index;
  std::vector<double> point(axes_.size());
  std::vector<Numbers> out(axes_[row_axis_].at.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    index[row_axis_] = i;
    for (std::size_t k = 0; k < axes_.size(); ++k) point[k] = axes_[k].at[index[k]];
    const Outer& outer = outer_[outer_of(index)];
    try {
      if (!outer.spec) throw CaseError(outer.fault);
      const auto found = numbers_of(spec_at(outer, point), outer.placement, bem);
      out[i].assign(found.begin(), found.end());
    } catch (const std::exception& e) {
      neighbour = {};
      note_fault(point, e.what());
    }
  }
  return out;
}

std::vector<std::string> CreepTable::idle_axes() const {
  std::vector<std::string> out;
  std::size_t stride = points();
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const std::size_t n = axes_[k].at.size();
    stride /= n;
    bool changes = is_creepage(axes_[k]);
    for (const TableNumber& number : table_.numbers)
      for (std::size_t i = 0; !changes && i + stride < points(); ++i)
        changes = i / stride % n + 1 < n && number.values[i] != number.values[i + stride];
    if (!changes) out.push_back(axes_[k].word);
  }
  return out;
}

void CreepTable::solve(const CreepTableOptions& options) {
  InfluenceCache cache;
  const std::size_t length = axes_[row_axis_].at.size();
  std::size_t done = 0;
  for_each_ended(points() / length, options.stop, [&](std::size_t r) {
    const Row next = row(r);
    const double* force = table_.numbers.front().values.data() + next.first;
    bool whole = true;
    for (std::size_t i = 0; i < length; ++i) whole = whole && !std::isnan(force[i * next.stride]);
    std::vector<Numbers> found = whole ? std::vector<Numbers>{} : solve_row(next, options, cache);
    return [&, next, found = std::move(found)] {
      for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t n = 0; n < found[i].size(); ++n)
          table_.numbers[n].values[next.first + i * next.stride] = found[i][n];
      done += length;
      if (options.solved) options.solved(done);
    };
  });
  std::sort(faults_.begin(), faults_.end());
}

std::vector<double> CreepTable::direct(const std::vector<double>& point, const BemOptions& bem) const {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    texts.push_back(is_creepage(axes_[k]) ? axes_[k].texts.front()
                                          : format_quantity(point[k], option_of(axes_[k].key)->dimension));
  try {
    const LoadedCase loaded = with_values(base_, overrides_, axes_, texts);
    Outer outer;
    outer.spec = rolling_case(loaded.spec);
    const auto found = numbers_of(spec_at(outer, point), place(*outer.spec, loaded.folder()), bem);
    return {found.begin(), found.end()};
  } catch (const std::exception&) {
    return {};
  }
}

namespace {

/// The digits of n + 1 in a prime base, behind the point: fills [0, 1) evenly. [Halton1960]
double spread(std::size_t n, int base) {
  double out = 0, part = 1;
  for (std::size_t rest = n + 1; rest > 0; rest /= static_cast<std::size_t>(base)) {
    part /= base;
    out += part * static_cast<double>(rest % static_cast<std::size_t>(base));
  }
  return out;
}

/// Even among the axis' cells: where points are dense, places are.
double place_among(const std::vector<double>& at, double share) {
  const double cells = share * static_cast<double>(at.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(cells), at.size() - 2);
  return at[below] + (cells - static_cast<double>(below)) * (at[below + 1] - at[below]);
}

}  // namespace

TableError interpolation_error(const CreepTable& creep_table, int places, const CreepTableOptions& options) {
  constexpr int kPrimes[kMostAxes] = {2, 3, 5, 7, 11, 13, 17, 19};
  const ForceTable& table = creep_table.table();
  const TableInterpolation between(table);
  std::vector<std::vector<double>> differences(static_cast<std::size_t>(places));
  InfluenceCache cache;
  for_each(
      places,
      [&](std::ptrdiff_t n) {
        if (options.stop && *options.stop) return;
        std::vector<double> point, out(table.numbers.size());
        for (std::size_t k = 0; k < table.axes.size(); ++k)
          point.push_back(place_among(table.axes[k].at, spread(static_cast<std::size_t>(n), kPrimes[k])));
        BemOptions bem = options.bem;
        bem.cache = &cache;
        const std::vector<double> direct = creep_table.direct(point, bem);
        if (direct.empty()) return;
        between.at(point.data(), out.data());
        for (std::size_t k = 0; k < out.size(); ++k) out[k] = std::abs(out[k] - direct[k]);
        differences[static_cast<std::size_t>(n)] = std::move(out);
      },
      true);
  TableError error;
  for (const TableNumber& number : table.numbers) {
    error.numbers.push_back({number.name, number.unit});
    for (const double v : number.values)
      if (std::isfinite(v)) error.numbers.back().scale = std::max(error.numbers.back().scale, std::abs(v));
  }
  for (const std::vector<double>& d : differences) {
    if (d.empty() || std::isnan(d.front())) continue;
    ++error.places;
    for (std::size_t k = 0; k < d.size(); ++k) {
      error.numbers[k].largest = std::max(error.numbers[k].largest, d[k]);
      error.numbers[k].mean += d[k];
    }
  }
  for (TableError::Number& n : error.numbers) n.mean /= std::max(error.places, 1);
  return error;
}

}  // namespace railstrata
