#include "rules/irregularity_rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "core/faults.hpp"
#include "geometry/height_field.hpp"
#include "model/rolling_start.hpp"
#include "options/irregularity_options.hpp"
#include "options/option_table.hpp"
#include "tables/column_words.hpp"
#include "tables/unit_table.hpp"

namespace railstrata {
namespace {

class IrregularityRules {
 public:
  IrregularityRules(const CaseSpec& spec, std::size_t index, CaseSource& source)
      : spec_(spec),
        is_(spec.irregularities[index]),
        points_(std::get_if<HeightPoints>(&is_.shape)),
        levels_(std::get_if<RoughnessLevels>(&is_.shape)),
        kind_(irregularity_kinds().at(is_.shape.index())),
        index_(index),
        source_(source) {}

  void check() {
    if (!source_.sound({name_ + ".kind"})) return;
    check_keys();
    if (!source_.sound({name_, "geometry.wheel_radius"})) return;
    check_numbers();
    if (points_) check_points(*points_);
    if (levels_ && levels_->wavelengths.size() != levels_->levels.size())
      refuse("levels", fmt::format("{} levels of {} wavelengths", levels_->levels.size(), levels_->wavelengths.size()),
             "give every wavelength one level");
    if (!source_.sound({name_})) return;
    if (const double slope = steepest_slope(is_, spec_.geometry.wheel_radius); slope > kSteepestHeight)
      refuse(points_ || levels_ ? "file" : "kind",
             fmt::format("its steepest slope is {:.2g}, contact takes up to {:g}", slope, kSteepestHeight),
             points_ ? "give more smoothing, or check the units of x and z" : "make it longer, less deep or less high");
    check_reached();
  }

 private:
  void refuse(std::string_view key, const std::string& what, const std::string& remedy) {
    const std::string full = fmt::format("{}.{}", name_, key);
    source_.complain(full, fmt::format("{}: {}", full, what), remedy);
  }

  std::string word() const { return fmt::format("kind = \"{}\"", kind_.word); }

  bool given(const Option& option) const {
    if (source_.has(fmt::format("{}.{}", name_, option.key))) return true;
    CaseSpec copy = spec_;
    const Slot slot = option.slot(copy, index_);
    const auto* list = std::get_if<std::vector<double>*>(&slot);
    return list && !(*list)->empty();  // from a file
  }
  bool needed(const Option& option) const {
    return std::find(kind_.needed.begin(), kind_.needed.end(), option.key) != kind_.needed.end();
  }
  /// Whether the kind has the key; one that every kind has applies always.
  bool has(const Option& option) const {
    return option.key == "file" ? points_ || levels_ : !option.applies || option.applies(spec_, index_);
  }
  std::string its_keys() const {
    std::vector<std::string_view> further;
    for (const Option& o : find_table("irregularity")->options)
      if (has(o) && (o.applies || o.key == "file") && !needed(o)) further.push_back(o.key);
    return fmt::format("its keys: {}{}{}", fmt::join(kind_.needed, ", "), further.empty() ? "" : ", ",
                       fmt::join(further, ", "));
  }

  void check_keys() {
    const auto [on_rail, on_wheel] = std::visit(
        []<class Kind>(const Kind&) {
          return std::pair{Kind::kOnRail, Kind::kOnWheel};
        },
        is_.shape);
    if (!(is_.on == BodyId::rail ? on_rail : on_wheel))
      refuse("on", fmt::format("{} is of the {}", word(), on_rail ? "rail" : "wheel"),
             fmt::format("give on = \"{}\"", on_rail ? "rail" : "wheel"));
    for (const Option& option : find_table("irregularity")->options) {
      const bool have = given(option);
      if (needed(option) && !have && source_.sound({fmt::format("{}.{}", name_, option.key), name_ + ".file"}))
        source_.complain(name_, fmt::format("{}: {} needs {}", name_, word(), option.key),
                         points_   ? "give file = \"heights.csv\" with the columns x and z"
                         : levels_ ? "give file = \"levels.csv\" with the columns wavelength and level"
                                   : fmt::format("add {} = …", option.key));
      if (have && !has(option)) refuse(option.key, fmt::format("{} has no {}", word(), option.key), its_keys());
    }
  }

  void check_numbers() {
    const auto* rough = std::get_if<Roughness>(&is_.shape);
    const WaveStretch* const stretch = std::visit(
        []<class Kind>(const Kind& kind) -> const WaveStretch* {
          if constexpr (std::is_base_of_v<WaveStretch, Kind>) return &kind;
          return nullptr;
        },
        is_.shape);
    if (stretch && stretch->from && stretch->to && !(*stretch->from < *stretch->to))
      refuse("to", "must lie beyond from", "exchange them");
    if (rough && !(*rough->shortest < *rough->longest))
      refuse("longest", "must be longer than shortest", "exchange them");
  }

  /// Something of it lies where the wheel rolls, from x = 0 on.
  void check_reached() {
    constexpr double kFelt = 0.1;  // m, from the middle of the contact
    const double end = end_of_way(spec_);
    const Extent extent = extent_of(is_);
    if (is_.on == BodyId::wheel || (extent.to > -kFelt && extent.from < end + kFelt)) return;
    const bool behind = extent.to <= -kFelt;
    source_.complain(name_,
                     fmt::format("{} lies {} the way of the wheel: it {} at x = {}, the wheel {} at {}", name_,
                                 behind ? "behind" : "beyond", behind ? "ends" : "begins",
                                 format_quantity(behind ? extent.to : extent.from, dimension::kLength),
                                 behind ? "starts" : "stops", format_quantity(behind ? 0 : end, dimension::kLength)),
                     behind ? "put it farther on (at, from)"
                            : "put it nearer (at, from), or let the wheel roll farther (transient.distance, "
                              "run.positions)");
  }

  void check_points(const HeightPoints& p) {
    if (p.x.size() != p.z.size() || (!p.y.empty() && p.y.size() != p.z.size()))
      return refuse("z", fmt::format("{} heights at {} places", p.z.size(), p.x.size()),
                    "give every point one x and one z, on a grid one y too");
    std::set<std::pair<double, double>> places;
    std::map<double, int> lines;
    for (std::size_t i = 0; i < p.x.size(); ++i) {
      const double y = p.y.empty() ? 0 : p.y[i];
      if (!places.insert({y, p.x[i]}).second)
        return refuse(source_.has(name_ + ".file") ? "file" : "x",
                      fmt::format("two heights at x = {}", format_quantity(p.x[i], dimension::kLength)),
                      p.y.empty() ? "keep one of them; a grid has a column y" : "keep one of them");
      ++lines[y];
    }
    for (const auto& [y, points] : lines)
      if (points < 3)
        return refuse(source_.has(name_ + ".file") ? "file" : "x",
                      fmt::format("{} points along x are no surface", points), "give at least three for each y");
  }

  const CaseSpec& spec_;
  const Irregularity& is_;
  const HeightPoints* points_;     // of a file
  const RoughnessLevels* levels_;  // likewise
  const IrregularityKind& kind_;
  std::size_t index_;
  CaseSource& source_;
  std::string name_ = fmt::format("irregularity.{}", index_);
};

}  // namespace

void check_irregularities(const CaseSpec& spec, CaseSource& source) {
  for (std::size_t i = 0; i < spec.irregularities.size(); ++i) IrregularityRules(spec, i, source).check();
}

std::optional<Diagnostic> too_coarse(const CaseSpec& spec, std::size_t index, double size, const char* what,
                                     const char* key) {
  constexpr double kLeastOfWave = 6;
  const double wave = shortest_wave(spec.irregularities.at(index), spec.geometry.wheel_radius);
  if (!(wave < kLeastOfWave * size)) return std::nullopt;
  const std::string name = fmt::format("irregularity.{}", index);
  return Diagnostic{name,
                    fmt::format("{}: a wave of {} on {} of {} has fewer than {:g} of them", name,
                                format_quantity(wave, dimension::kLength), what,
                                format_quantity(size, dimension::kLength), kLeastOfWave),
                    fmt::format("give a smaller {}, or a longer wave", key)};
}

void require_fine_enough(const CaseSpec& spec, double size, const char* what, const char* key) {
  for (std::size_t i = 0; i < spec.irregularities.size(); ++i)
    if (const auto fault = too_coarse(spec, i, size, what, key)) throw CaseError(std::vector<Diagnostic>{*fault});
}

std::string* file_of_heights(Irregularity& irregularity) {
  if (auto* points = std::get_if<HeightPoints>(&irregularity.shape)) return &points->file;
  if (auto* levels = std::get_if<RoughnessLevels>(&irregularity.shape)) return &levels->file;
  return nullptr;
}

std::string read_heights(const std::string& text, const std::filesystem::path& file, CaseSpec& spec,
                         std::size_t index) {
  constexpr double kTurns = 100;
  // round a wheel: the way on its tread
  const Option angle{
      "angle", nullptr, "", dimension::kAngle, {-2 * kTurns * std::numbers::pi, 2 * kTurns * std::numbers::pi}};
  const OptionTable& options = *find_table("irregularity");
  const bool levels = std::holds_alternative<RoughnessLevels>(spec.irregularities.at(index).shape);
  UnitTableForm form{{}, {{"x", "angle"}}, "heights", levels ? "wavelength [mm], level [dB]" : "x [mm], z [um]"};
  const Option *x = nullptr, *z = nullptr;
  for (const Option& option : options.options) {
    if (!std::holds_alternative<std::vector<double>*>(option.slot(spec, index))) continue;
    if (option.applies && !option.applies(spec, index)) continue;
    form.columns.push_back({&option, option.key});
    for (const std::string_view word : words_of(option.key)) form.columns.push_back({&option, word});
    if (option.key == std::string_view("x")) x = &option;
    if (option.key == std::string_view("z")) z = &option;
  }
  if (z && spec.irregularities.at(index).on == BodyId::wheel) {
    form.columns.push_back({&angle, "angle"});
    form.columns.push_back({z, "runout"});
  }
  if (x) form.chainage = "x";
  const UnitTable table = read_unit_table(text, file, form);
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const bool turned = table.columns[k] == &angle;
    std::vector<double>& column = *std::get<std::vector<double>*>((turned ? x : table.columns[k])->slot(spec, index));
    for (const UnitTable::Row& row : table.rows)
      column.push_back((turned ? spec.geometry.wheel_radius : 1) * row.cells[k].number.value());
  }
  return table.chainage == 0 ? ""
                             : fmt::format("{}: x counts from its first row, {}", file.filename().string(),
                                           format_quantity(table.chainage, dimension::kLength));
}

}  // namespace railstrata
