#include "creep/creep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "ask/answer.hpp"
#include "core/faults.hpp"
#include "many/each_case.hpp"
#include "result/result_table.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

constexpr std::size_t kMostTablePoints = 2'000'000;
constexpr std::string_view kLongitudinal = "drive.creepage", kLateral = "drive.lateral_creepage", kSpin = "drive.spin";

/// Creepages are set in a spec that is loaded already: a row along one of them needs no case to be read.
bool is_creepage(const NumberAxis& axis) {
  return axis.key == kLongitudinal || axis.key == kLateral || axis.key == kSpin;
}

void set_creepage(CaseSpec& spec, std::string_view key, double value) {
  if (key == kLongitudinal) spec.drive.creepage = value;
  if (key == kSpin) spec.drive.spin = value;
  if (key != kLateral) return;
  spec.drive.lateral_creepage = value;
  spec.drive.lateral_traction_coefficient.reset();
}

/// A point.
struct Solved {
  const CaseSpec& spec;
  const BemResult& result;
  Summary summary;
};

/// Those of summary.json, two by other names, then those of the solution.
Columns<Solved> creep_numbers() {
  const Columns<Summary> all(result_numbers().begin(), result_numbers().end());
  Columns<Solved> out = of_part<Solved>(select(all, {"F_x", "lateral_force", "normal_force", "spin_moment", "approach",
                                                     "p_max", "patch_area", "slip_area_fraction"}),
                                        &Solved::summary);
  out.front().symbol = "force_x";
  out.back().symbol = "slip";
  append(out, {{"dissipation", unit::kWatts, [](const Solved& s) { return dissipation(s.result); }},
               {"bound", unit::kNone, [](const Solved& s) {
                  const ContactSummary& c = s.summary.contact;
                  return std::hypot(c.F_x, c.lateral_force) / (s.spec.drive.friction_coefficient * c.normal_force);
                }}});
  return out;
}

/// "N m", "m2": as a table has it.
std::string si_text(const Unit& unit) {
  std::string out(unit.key_ending.substr(unit.key_ending.empty() ? 0 : 1));
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

CreepNumbers solved(const CaseSpec& spec, const Placement& placement, const BemOptions& bem) {
  AskOptions whole{.bem = bem};
  whole.bem.apart = false;
  Answer answer = solve_contact(spec, placement, whole);
  const Solved point{spec, answer.result, std::move(answer.summary)};
  for (const Check& check : point.summary.checks)
    if (!check.ok)
      throw CaseError(fmt::format("check {} fails: {:.3g}, limit {:.3g}", check.name, check.value, check.limit));
  static const Columns<Solved> columns = creep_numbers();
  CreepNumbers out{};
  for (std::size_t k = 0; k < kCreepNumbers; ++k) out[k] = columns[k].value(point);
  return out;
}

/// The three axes that a scaled table stands for, in front.
void put_creepages_first(std::vector<NumberAxis>& axes) {
  std::vector<NumberAxis> out;
  for (const std::string_view key : {kLongitudinal, kLateral, kSpin}) {
    const auto found = std::find_if(axes.begin(), axes.end(), [&](const NumberAxis& a) { return a.key == key; });
    if (found == axes.end())
      throw CaseError(fmt::format("a scaled table needs an axis of {}", key),
                      "give the ends of creepage_x, creepage_y and spin: --axis creepage_x=-0.02,0.02");
    out.push_back(*found);
    axes.erase(found);
  }
  axes.insert(axes.begin(), out.begin(), out.end());
}

/// Widens the ends of size and spin over those that are asked for.
void widen(TableScaling& scaling, const CreepUnits& units) {
  const auto most = [&](std::size_t k) {
    return std::max(std::abs(scaling.asked[k].at.front()), std::abs(scaling.asked[k].at.back()));
  };
  const auto spin = [&](double asked) { return scaled_place({0, 0, asked}, units).spin; };
  scaling.largest_size = std::max(scaling.largest_size, scaled_place({most(0), most(1), 0}, units).size);
  scaling.spin_low = std::min(scaling.spin_low, spin(scaling.asked[2].at.front()));
  scaling.spin_high = std::max(scaling.spin_high, spin(scaling.asked[2].at.back()));
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

CreepTable::CreepTable(const LoadedCase& base, std::vector<NumberAxis> axes, std::optional<ScaledCounts> scaled)
    : base_(base), axes_(std::move(axes)), row_axis_(axes_.size() - 1) {
  if (scaled) put_creepages_first(axes_);
  double points_asked = 1;
  std::vector<Axis> outer_axes;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    if (!(scaled && k < kScaledAxes)) points_asked *= static_cast<double>(axes_[k].at.size());
    table_.axes.push_back({axes_[k].word, axes_[k].unit, axes_[k].at});
    outer_axes.push_back({axes_[k].key, axes_[k].values});
    if (!is_creepage(axes_[k])) continue;
    row_axis_ = k;
    outer_axes.back().values.resize(1);  // in place of the case's own traction
  }
  if (scaled) points_asked *= 1.0 * scaled->angles * scaled->spins * scaled->sizes;
  if (points_asked > kMostTablePoints)
    throw CaseError(fmt::format("{:.7g} points", points_asked), fmt::format("give {} at most", kMostTablePoints));
  if (scaled) start_scaled(*scaled);
  for (const Column<Solved>& n : creep_numbers())
    table_.numbers.push_back({n.symbol, si_text(n.unit), std::vector<double>(points(), NAN)});
  std::optional<CaseError> first_error;
  for (const std::vector<std::string>& values : combinations(outer_axes, kMostTablePoints)) {
    try {
      outer_.push_back(load(values));
    } catch (const CaseError& e) {
      outer_.push_back({{}, {}, first_line(e.what())});
      if (!first_error) first_error = e;
    }
  }
  if (std::none_of(outer_.begin(), outer_.end(), [](const Outer& o) { return o.spec.has_value(); })) throw *first_error;
  if (scaled) check_scaled();
}

/// The ends of the creepages as asked, the table's own three axes in their place.
void CreepTable::start_scaled(const ScaledCounts& counts) {
  const std::vector<TableAxis> own = scaled_axes(counts.angles, counts.spins, counts.sizes);
  TableScaling& scaling = table_.scaling.emplace();
  for (std::size_t k = 0; k < kScaledAxes; ++k) {
    const TableAxis& given = table_.axes[k];
    scaling.asked[k] = {given.name, given.unit, {given.at.front(), given.at.back()}};
    table_.axes[k] = own[k];
  }
}

void CreepTable::check_scaled() const {
  for (const Outer& outer : outer_)
    if (outer.spec) require_support(uses::kScaledTable, *outer.spec);
}

/// Where the case refuses a value, the axis is named instead of the setting.
CreepTable::Outer CreepTable::load(const std::vector<std::string>& values) const {
  std::vector<std::string> of_axes;
  for (std::size_t k = 0; k < axes_.size(); ++k) of_axes.push_back(fmt::format("{}=\"{}\"", axes_[k].key, values[k]));
  try {
    const LoadedCase loaded = with_overrides(base_, of_axes);
    CaseSpec spec = loaded.spec;
    spec.run.rolling = true;  // also where the case has run.rolling = false
    spec.transient = {};
    Placement placement = place(spec, loaded.folder());
    return {std::move(spec), std::move(placement), {}};
  } catch (CaseError& e) {
    for (Diagnostic& d : e.diagnostics)
      for (std::size_t k = 0; k < axes_.size(); ++k)
        if (d.where == fmt::format("--set {}=\"{}\"", axes_[k].key, values[k]))
          d.where = fmt::format("--axis {}, {}", axes_[k].word, values[k]);
    throw CaseError(e.diagnostics);
  }
}

std::size_t CreepTable::missing() const {
  const std::vector<double>& force = table_.numbers.front().values;
  return static_cast<std::size_t>(std::count_if(force.begin(), force.end(), [](double v) { return std::isnan(v); }));
}

std::vector<std::size_t> CreepTable::index_of(std::size_t point) const {
  std::vector<std::size_t> out(axes_.size());
  for (std::size_t k = axes_.size(); k-- > 0; point /= table_.axes[k].at.size())
    out[k] = point % table_.axes[k].at.size();
  return out;
}

const CreepTable::Outer& CreepTable::outer_at(std::size_t point) const {
  const std::vector<std::size_t> index = index_of(point);
  std::size_t out = 0;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    if (!is_creepage(axes_[k])) out = out * axes_[k].at.size() + index[k];
  return outer_[out];
}

CaseSpec CreepTable::spec_at(const Outer& outer, const std::vector<double>& asked) const {
  CaseSpec spec = *outer.spec;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    if (is_creepage(axes_[k])) set_creepage(spec, axes_[k].key, asked[k]);
  return spec;
}

CreepTable::Row CreepTable::row(std::size_t number) const {
  std::size_t stride = 1;
  for (std::size_t k = row_axis_ + 1; k < axes_.size(); ++k) stride *= table_.axes[k].at.size();
  return {number / stride * stride * table_.axes[row_axis_].at.size() + number % stride, stride};
}

std::string CreepTable::place_words(const std::vector<double>& asked, bool without_creepages) const {
  std::string out;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    if (!(table_.scaling && without_creepages && is_creepage(axes_[k])))
      out += fmt::format("{}{} = {:.6g}{}{}", out.empty() ? "" : ", ", axes_[k].word, asked[k],
                         axes_[k].unit.empty() ? "" : " ", axes_[k].unit);
  return out.empty() ? "everywhere" : out;
}

void CreepTable::note_fault(std::size_t point, const std::string& fault) {
  const std::lock_guard lock(noting_);
  const std::string text =
      fmt::format("{}: {}", place_words(asked_place(table_, point), !outer_at(point).spec), first_line(fault));
  if (faults_.size() < 20 && std::find(faults_.begin(), faults_.end(), text) == faults_.end()) faults_.push_back(text);
}

void CreepTable::take(const ForceTable& earlier) {
  const auto same = [](const TableAxis& a, const TableAxis& b) { return a.name == b.name && a.at == b.at; };
  bool all = std::equal(table_.axes.begin(), table_.axes.end(), earlier.axes.begin(), earlier.axes.end(), same) &&
             table_.scaling.has_value() == earlier.scaling.has_value();
  for (std::size_t k = 0; all && k < axes_.size(); ++k) all = same(table_.asked(k), earlier.asked(k));
  if (!all)
    throw CaseError("the table that was begun has other axes",
                    "give those of its beginning, or another --out without --resume");
  for (TableNumber& number : table_.numbers)
    for (const TableNumber& n : earlier.numbers)
      if (n.name == number.name) number.values = n.values;
}

std::vector<std::optional<CreepNumbers>> CreepTable::solve_row(const Row& row, const CreepTableOptions& options,
                                                               InfluenceCache& cache) {
  BemOptions bem = options.bem;
  BemNeighbour neighbour;
  bem.cache = &cache;
  bem.neighbour = &neighbour;
  std::vector<std::optional<CreepNumbers>> out(table_.axes[row_axis_].at.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t point = row.first + i * row.stride;
    const Outer& outer = outer_at(point);
    try {
      if (!outer.spec) throw CaseError(outer.fault);
      out[i] = solved(spec_at(outer, asked_place(table_, point)), outer.placement, bem);
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
    const std::size_t n = table_.axes[k].at.size();
    stride /= n;
    bool changes = is_creepage(axes_[k]);
    for (const TableNumber& number : table_.numbers)
      for (std::size_t i = 0; !changes && i + stride < points(); ++i)
        changes = i / stride % n + 1 < n && number.values[i] != number.values[i + stride];
    if (!changes) out.push_back(axes_[k].word);
  }
  return out;
}

/// Of dF_x/dv_x, dF_y/dv_y and dF_y/dphi between a hundredth of their unit to both sides; a first guess of the unit is
/// from a step that is smaller than any.
CreepStiffness CreepTable::stiffness_of(const Outer& outer, const ScaledLoad& at, const BemOptions& bem) const {
  constexpr Creepages kSmall{1e-5, 1e-5, 1e-3};
  CreepStiffness out{};
  for (std::size_t k = 0; k < kScaledAxes; ++k) {
    const auto force = [&](double creepage) {
      std::vector<double> place(axes_.size(), 0.0);
      place[k] = creepage;
      return solved(spec_at(outer, place), outer.placement, bem)[k == 0 ? 0 : 1];
    };
    const auto slope = [&](double step) { return std::abs(force(step) - force(-step)) / (2 * step); };
    const double unit = (k < 2 ? 3 : 1) * at.friction * at.load, first = slope(kSmall[k]);
    out[k] = (first > 0 ? slope(0.01 * unit / first) : first) / (k < 2 ? std::pow(at.load, 2.0 / 3) : at.load);
    if (!(out[k] > 0))
      throw CaseError(fmt::format("the force does not change with {}, so that its scale is not known", axes_[k].word),
                      "make the table without --scaled");
  }
  return out;
}

void CreepTable::find_scaling(const CreepTableOptions& options) {
  TableScaling& scaling = *table_.scaling;
  for (const Outer& outer : outer_)
    if (outer.spec) {
      scaling.load = outer.spec->vehicle.load();
      scaling.friction = outer.spec->drive.friction_coefficient;
    }
  std::vector<CreepStiffness> found(outer_.size(), {NAN, NAN, NAN});
  InfluenceCache cache;
  BemOptions bem = options.bem;
  bem.cache = &cache;
  for_each(
      static_cast<std::ptrdiff_t>(outer_.size()),
      [&](std::ptrdiff_t i) {
        const auto n = static_cast<std::size_t>(i);
        if (!outer_[n].spec) return;
        try {
          found[n] = stiffness_of(outer_[n], load_at(table_, grid_place(table_, n).data()), bem);
        } catch (const std::exception& e) {
          outer_[n] = {{}, {}, first_line(e.what())};
        }
      },
      true);
  constexpr const char *kNames[] = {"creep_stiffness_x", "creep_stiffness_y", "creep_stiffness_spin"},
                       *kUnits[] = {"N^(1/3)", "N^(1/3)", "m"};
  for (std::size_t k = 0; k < kScaledAxes; ++k) {
    scaling.stiffness[k] = {kNames[k], kUnits[k], {}};
    for (const CreepStiffness& s : found) scaling.stiffness[k].values.push_back(s[k]);
  }
  scaling.spin_low = std::numeric_limits<double>::infinity();
  scaling.spin_high = -scaling.spin_low;
  for (std::size_t n = 0; n < found.size(); ++n)
    if (const ScaledLoad at = load_at(table_, grid_place(table_, n).data()); found[n][0] > 0)
      widen(scaling, creep_units(found[n], at.load, at.friction));
  if (!(scaling.largest_size > 0)) throw CaseError(outer_.front().fault);
}

void CreepTable::solve(const CreepTableOptions& options) {
  if (table_.scaling) find_scaling(options);
  InfluenceCache cache;
  const std::size_t length = table_.axes[row_axis_].at.size();
  std::size_t done = 0;
  for_each_completed(points() / length, options.control, [&](std::size_t r) {
    const Row next = row(r);
    const double* force = table_.numbers.front().values.data() + next.first;
    bool whole = true;
    for (std::size_t i = 0; i < length; ++i) whole = whole && !std::isnan(force[i * next.stride]);
    std::vector<std::optional<CreepNumbers>> found;
    if (!whole) found = solve_row(next, options, cache);
    return [&, next, found = std::move(found)] {
      for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t n = 0; found[i] && n < kCreepNumbers; ++n)
          table_.numbers[n].values[next.first + i * next.stride] = (*found[i])[n];
      done += length;
      if (options.solved) options.solved(done);
    };
  });
  std::sort(faults_.begin(), faults_.end());
}

std::optional<CreepNumbers> CreepTable::direct(const std::vector<double>& point, const BemOptions& bem) const {
  std::vector<std::string> values;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    values.push_back(is_creepage(axes_[k]) ? axes_[k].values.front() : axis_text(axes_[k], point[k]));
  try {
    const Outer outer = load(values);
    return solved(spec_at(outer, point), outer.placement, bem);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace railstrata
