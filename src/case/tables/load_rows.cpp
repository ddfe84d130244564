#include "tables/load_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/text.hpp"
#include "options/option_table.hpp"
#include "tables/column_words.hpp"
#include "tables/unit_table.hpp"

namespace railstrata {
namespace {

/// A fault of a row.
struct RowFault {
  const char* key;
  std::string message, remedy;
};

template <class Value>
void take(const std::optional<double>& given, Value& value) {
  if (given) value = *given;
}

DriveSpec drive_with(DriveSpec drive, const LoadSpec& load) {
  take(load.speed, drive.speed);
  take(load.friction_coefficient, drive.friction_coefficient);
  if (load.traction_coefficient) drive.creepage.reset();
  take(load.traction_coefficient, drive.traction_coefficient);
  take(load.creepage, drive.creepage);
  if (load.lateral_traction_coefficient) drive.lateral_creepage.reset();
  if (load.lateral_creepage) drive.lateral_traction_coefficient.reset();
  take(load.lateral_traction_coefficient, drive.lateral_traction_coefficient);
  take(load.lateral_creepage, drive.lateral_creepage);
  return drive;
}

std::optional<RowFault> fault_of(const CaseSpec& spec, const LoadSpec& load) {
  constexpr double kTightest = 5;  // m
  if (load.curve_radius && !(std::abs(*load.curve_radius) >= kTightest))
    return RowFault{"curve_radius",
                    fmt::format("curve_radius = {}: must be at least {} to either side",
                                format_quantity(*load.curve_radius, dimension::kLength),
                                format_quantity(kTightest, dimension::kLength)),
                    "leave it out where the case's track is meant"};
  const DriveSpec d = drive_with(spec.drive, load);
  const double wanted = std::hypot(d.traction().value_or(0), d.lateral_traction_coefficient.value_or(0));
  if (wanted > 0 && wanted >= d.friction_coefficient)
    return RowFault{load.friction_coefficient ? "friction_coefficient" : "traction_coefficient",
                    fmt::format("a traction coefficient of {:.4g} must be below the friction coefficient {}", wanted,
                                d.friction_coefficient),
                    "the wheel would slide: lower the row's traction or raise its friction"};
  if (spec.friction.kinetic_coefficient.value_or(0) > d.friction_coefficient)
    return RowFault{"friction_coefficient",
                    fmt::format("friction_coefficient = {}: must be at least friction.kinetic_coefficient = {}",
                                d.friction_coefficient, *spec.friction.kinetic_coefficient),
                    "friction falls with slip: raise the row's"};
  return std::nullopt;
}

void put(const UnitTable::Cell& cell, const Option& option, CaseSpec& spec, std::size_t index) {
  const Slot slot = option.slot(spec, index);
  if (auto* const* text = std::get_if<std::string*>(&slot)) {
    **text = cell.text;
    return;
  }
  if (!cell.number) return;
  const double value = option.derivation ? option.derivation.value(spec, index, *cell.number) : *cell.number;
  if (auto* const* maybe = std::get_if<std::optional<double>*>(&slot))
    **maybe = value;
  else
    *std::get<double*>(slot) = value;
}

}  // namespace

CaseSpec with_load(const CaseSpec& spec, const LoadSpec& load) {
  CaseSpec out = spec;
  out.loads.clear();
  out.collective.curve = {};
  if (load.wheel_load) out.vehicle.set_load(*load.wheel_load);
  if (!load.wheel_profile.empty()) out.geometry.wheel_profile = load.wheel_profile;
  take(load.wheel_radius, out.geometry.wheel_radius);
  take(load.lateral_shift, out.geometry.lateral_shift);
  take(load.yaw, out.geometry.yaw);
  take(load.roll, out.geometry.roll);
  take(load.curve_radius, out.geometry.curve_radius);
  out.drive = drive_with(out.drive, load);
  return out;
}

std::string load_name(const CaseSpec& spec, std::size_t index) {
  const std::string& name = spec.loads.at(index).name;
  return name.empty() ? fmt::format("load {}", index + 1) : name;
}

namespace {

// A time series of one wheel, as vehicle codes write it.
struct Axis {
  std::optional<double> LoadSpec::*member;
  double width;
  bool inverse = false;  ///< bins of 1/value
};
const std::array kAxes{Axis{&LoadSpec::wheel_load, 10e3},
                       Axis{&LoadSpec::wheel_radius, 5e-3},
                       Axis{&LoadSpec::lateral_shift, 1e-3},
                       Axis{&LoadSpec::yaw, 1e-3},
                       Axis{&LoadSpec::curve_radius, 1e-3, true},
                       Axis{&LoadSpec::speed, 5},
                       Axis{&LoadSpec::friction_coefficient, 0.02},
                       Axis{&LoadSpec::traction_coefficient, 0.02},
                       Axis{&LoadSpec::lateral_traction_coefficient, 0.02},
                       Axis{&LoadSpec::creepage, 5e-4},
                       Axis{&LoadSpec::lateral_creepage, 5e-4}};
/// Means alone, which part no samples.
const std::array kMeans{&LoadSpec::roll, &LoadSpec::axle_weight, &LoadSpec::guiding_force, &LoadSpec::t_gamma,
                        &LoadSpec::friction_energy};
/// Name and profile of the wheel, and where it lies on the axes.
using Bin = std::pair<std::array<std::string, 2>, std::array<std::optional<long>, kAxes.size()>>;

double on_axis(const Axis& axis, double value) { return axis.inverse ? 1 / value : value; }

Bin bin_of(const LoadSpec& load, double scale, bool by_name) {
  Bin out{{by_name ? load.name : "", load.wheel_profile}, {}};
  for (std::size_t k = 0; k < kAxes.size(); ++k)
    if (const auto& value = load.*kAxes[k].member)
      out.second[k] = std::lround(on_axis(kAxes[k], *value) / (scale * kAxes[k].width));
  return out;
}

bool few_names(const std::vector<LoadSpec>& samples) {
  constexpr std::size_t kMost = 40;
  std::set<std::string_view> names;
  for (const LoadSpec& sample : samples) names.insert(sample.name);
  return names.size() <= kMost;
}

/// "wagon, leading: 107 kN, 4.92 mm"
std::string bin_name(const std::string& samples, std::size_t place, const LoadSpec& mean) {
  std::string out = samples.empty() ? fmt::format("bin {}", place) : samples;
  const char* before = ": ";
  const auto add = [&](const std::optional<double>& value, double factor, const char* unit) {
    if (!value) return;
    out += fmt::format("{}{:.3g} {}", before, factor * *value, unit);
    before = ", ";
  };
  add(mean.wheel_load, 1e-3, "kN");
  add(mean.lateral_shift, 1e3, "mm");
  return out;
}

/// Adds a sample to the sums of its bin.
void add(const LoadSpec& sample, LoadSpec& sums) {
  sums.passages += sample.passages;
  for (const Axis& axis : kAxes)
    if (const auto& value = sample.*axis.member)
      sums.*axis.member = (sums.*axis.member).value_or(0) + sample.passages * on_axis(axis, *value);
  for (const auto member : kMeans)
    if (const auto& value = sample.*member) sums.*member = (sums.*member).value_or(0) + sample.passages * *value;
}

/// A curvature of zero is straight track: no radius.
LoadSpec mean_of(LoadSpec sums) {
  for (const Axis& axis : kAxes)
    if (auto& value = sums.*axis.member) {
      *value /= sums.passages;
      if (axis.inverse && !(std::abs(*value) > 1e-6)) value.reset();
      if (value && axis.inverse) *value = 1 / *value;
    }
  for (const auto member : kMeans)
    if (auto& value = sums.*member) *value /= sums.passages;
  return sums;
}

/// Whether a column is the time or the distance of samples.
bool names_way(std::string_view column) {
  const auto names = [&](std::string_view key) {
    const std::vector<std::string_view>& words = words_of(key);
    return names_column(column, key) ||
           std::any_of(words.begin(), words.end(), [&](std::string_view word) { return names_column(column, word); });
  };
  return names("time") || names("distance");
}

/// Whether a line of names has a column of time or distance: its rows are then samples of one wheel.
bool names_series(const std::string& text) {
  const std::vector<std::string> names = column_names(text);
  return std::any_of(names.begin(), names.end(), names_way);
}

/// Samples in the same bin become one load: the means of their numbers, each weighted by its passages, which are added
/// up. Bins are `scale` times 10 kN, 1 mm, 1 mrad, 5 m/s, 0.001 1/m of curvature, 0.02 of friction and traction and
/// 0.0005 of creepage wide, about 0; of what a sample does not give there is none. Samples of different names are apart
/// where there are at most 40 names. Roll, and forces to compare with, part no samples. The bins follow in the order of
/// their passages, most first; their names end with load and shift.
std::vector<LoadSpec> binned(const std::vector<LoadSpec>& samples, double scale) {
  const bool by_name = few_names(samples);
  std::map<Bin, LoadSpec> bins;
  for (const LoadSpec& sample : samples) {
    const Bin bin = bin_of(sample, scale, by_name);
    LoadSpec empty;
    empty.name = bin.first[0];
    empty.wheel_profile = bin.first[1];
    empty.passages = 0;
    add(sample, bins.try_emplace(bin, empty).first->second);
  }
  std::vector<LoadSpec> out;
  for (const auto& [bin, sums] : bins) out.push_back(mean_of(sums));
  std::stable_sort(out.begin(), out.end(),
                   [](const LoadSpec& a, const LoadSpec& b) { return a.passages > b.passages; });
  for (std::size_t i = 0; i < out.size(); ++i) out[i].name = bin_name(out[i].name, i + 1, out[i]);
  return out;
}

/// Samples without any of what differs from sample to sample are those of a table that was not understood.
void require_states(const UnitTable& table, const std::filesystem::path& file) {
  constexpr std::array kStates{"wheel_load", "axle_load", "lateral_shift", "yaw"};
  if (std::any_of(kStates.begin(), kStates.end(), [&](const char* key) { return table.has(key); })) return;
  refuse_in_table(
      file, table.line,
      fmt::format("a series without a load, a lateral shift and a yaw; not read: {}", fmt::join(table.ignored, ", ")),
      "name one column at least wheel_load [kN], lateral_shift [mm] or yaw [mrad], or Q, y, psi");
}

/// What a series does not give and the case has instead.
std::string lacking_of(const UnitTable& table, const std::vector<LoadSpec>& samples) {
  std::vector<std::string> out;
  const auto look = [&](const char* key, auto&& gives) {
    const auto count = static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), std::not_fn(gives)));
    if (count == samples.size())
      out.emplace_back(key);
    else if (count > 0)
      out.push_back(fmt::format("{} ({} of {} samples)", key, count, samples.size()));
  };
  look("wheel_load", [](const LoadSpec& l) { return l.wheel_load.has_value(); });
  look("lateral_shift", [](const LoadSpec& l) { return l.lateral_shift.has_value(); });
  look("yaw", [](const LoadSpec& l) { return l.yaw.has_value(); });
  look("creepage", [](const LoadSpec& l) { return l.creepage || l.traction_coefficient; });
  std::string text =
      out.empty() ? "" : fmt::format("; taken from the case, for the table has none: {}", fmt::join(out, ", "));
  if (!table.has("mgt") && !table.has("passages"))
    text += "; without a column passages or mgt every sample is one wheel";
  return text;
}

/// What no railway has, or only with another sign.
std::string doubts_of(const std::vector<LoadSpec>& loads) {
  constexpr double kHeaviest = 250e3, kAside = 2e-3;  // N, m
  const auto heavy =
      std::count_if(loads.begin(), loads.end(), [](const LoadSpec& l) { return l.wheel_load.value_or(0) > kHeaviest; });
  const auto turned = std::count_if(loads.begin(), loads.end(), [](const LoadSpec& l) {
    return l.curve_radius.value_or(0) > 0 && l.lateral_shift.value_or(0) > kAside;
  });
  std::string out;
  if (heavy > 0)
    out += fmt::format("; {} of {} loads have more than 250 kN on a wheel: is the unit right?", heavy, loads.size());
  if (turned > 0)
    out += fmt::format(
        "; {} of {} loads have a positive curve_radius (this rail is the inner one) and a wheel shifted to the field "
        "side: of an outer rail the radius is negative",
        turned, loads.size());
  return out;
}

}  // namespace

std::string read_load_table(const std::string& text, const std::filesystem::path& path, CaseSpec& spec,
                            std::vector<int>* lines) {
  const std::filesystem::path file = path.filename();
  const OptionTable& options = *find_table("load");
  UnitTableForm form{{}, options.rivals, "a load", "wheel_load [kN], lateral_shift [mm], passages"};
  for (const Option& option : options.options) form.columns.push_back({&option, option.key});
  for (const Option& option : options.options)
    for (const std::string_view word : words_of(option.key)) form.columns.push_back({&option, word});
  const bool series = names_series(text);
  form.others = series;
  form.blanks = true;
  if (series) form.loads = {"wheel_load", "axle_load"};
  const UnitTable table = read_unit_table(text, file, form);
  for (const UnitTable::Row& row : table.rows) {
    spec.loads.emplace_back();
    if (lines && !series) lines->push_back(row.line);
    for (const Option& option : options.options)  // in the table's order: mgt counts over the load
      for (std::size_t k = 0; k < row.cells.size(); ++k)
        if (table.columns[k] == &option) put(row.cells[k], option, spec, spec.loads.size() - 1);
    if (const auto fault = fault_of(spec, spec.loads.back()))
      refuse_in_table(file, row.line, fault->message, fault->remedy);
  }
  const std::string doubts = doubts_of(spec.loads);
  if (!series) return doubts.empty() ? doubts : file.string() + ": " + doubts.substr(2);
  require_states(table, file);
  const std::size_t samples = spec.loads.size();
  const std::string lacking = lacking_of(table, spec.loads);
  spec.loads = binned(spec.loads, spec.collective.bin_scale);
  std::vector<std::string> unread = table.ignored;
  std::erase_if(unread, [](const std::string& name) { return names_way(name); });
  std::string note =
      fmt::format("{}: {} samples of a wheel became {} loads{}{}{}{}", file.string(), samples, spec.loads.size(),
                  table.lifted > 0 ? fmt::format("; {} of a lifted wheel were left out", table.lifted) : "",
                  unread.empty() ? "" : "; not read: ", fmt::join(unread, ", "), lacking);
  const auto lacks = [](const LoadSpec& l) { return !l.lateral_creepage && !l.lateral_traction_coefficient; };
  if (std::any_of(spec.loads.begin(), spec.loads.end(), lacks))
    note +=
        "; without a column lateral_creepage the yaw alone slides the wheel sideways, which doubles T-gamma where the "
        "wheel moves across as it turns";
  if (std::none_of(spec.loads.begin(), spec.loads.end(), [](const LoadSpec& l) { return l.roll.has_value(); }))
    note += "; without a column roll, and y of the tread, forces of wheels that touch tread and flange are others";
  if (spec.drive.creepage_of == CreepageOf::contact &&
      std::any_of(spec.loads.begin(), spec.loads.end(), [](const LoadSpec& l) { return l.creepage.has_value(); }))
    note +=
        "; its creepages are taken for those of the contact that touches first: give drive.creepage_of = \"wheel\" and "
        "(V - omega r0) / V where wheels touch tread and flange";
  return note + doubts;
}

void check_loads(const CaseSpec& spec, CaseSource& source) {
  for (std::size_t i = 0; i < spec.loads.size(); ++i) {
    const std::string name = fmt::format("load.{}", i);
    if (!source.has(name) || !source.sound({name})) continue;
    if (const auto fault = fault_of(spec, spec.loads[i]))
      source.complain(fmt::format("{}.{}", name, fault->key), fmt::format("{}: {}", name, fault->message),
                      fault->remedy);
  }
}

}  // namespace railstrata
