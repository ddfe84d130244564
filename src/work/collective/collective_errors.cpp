#include "collective/collective_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "passes/pass_errors.hpp"
#include "record/json.hpp"
#include "record/number_text.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

double rubbed(const CollectiveRow& row) { return row.sound() ? row.passages * row.summary.damage.friction_energy : 0; }

double rubbed(const std::vector<CollectiveRow>& rows) {
  return std::accumulate(rows.begin(), rows.end(), 0.0,
                         [](double sum, const CollectiveRow& row) { return sum + rubbed(row); });
}

/// Takes the bar of each number of `f` into `bars`; another form is none.
void widen(const Json& f, const Json& other, double factor, Json& bars) {
  if (f.is_number()) {
    const double far = other.is_number() ? factor * std::abs(f.get<double>() - other.get<double>()) : kNotApplicable;
    const bool first = bars.is_null();
    if (first || bars.is_number())
      bars = std::isnan(far) ? Json("unknown") : Json(first ? far : std::max(far, bars.get<double>()));
    return;
  }
  if (f.is_object())
    for (const auto& [key, value] : f.items())
      if (value.is_structured() || value.is_number())
        widen(value, other.is_object() && other.contains(key) ? other[key] : Json(), factor, bars[key]);
  if (f.is_array())
    for (std::size_t i = 0; i < f.size(); ++i)
      widen(f[i], other.is_array() && i < other.size() ? other[i] : Json(), factor, bars[i]);
}

/// What a coarser solution of the deciding loads says of each of them, whatever cancels in their sums.
struct LoadBars {
  double energy = 0;    ///< relative, mean by friction energy
  double pressure = 0;  ///< relative, the largest
};
void widen(const std::vector<CollectiveRow>& rows, const std::vector<CollectiveRow>& other,
           const std::vector<std::size_t>& deciding, double factor, LoadBars& bars) {
  double off = 0, sum = 0;
  for (const std::size_t i : deciding) {
    const ContactSummary &c = rows[i].summary.contact, &there = other[i].summary.contact;
    off += std::abs(rubbed(rows[i]) - rubbed(other[i]));
    sum += rubbed(rows[i]);
    bars.pressure = std::max(bars.pressure, factor * std::abs(there.patch.p_max / c.patch.p_max - 1));
    if (std::isfinite(c.error.p_max)) bars.pressure = std::max(bars.pressure, c.error.p_max / c.patch.p_max);
  }
  if (sum > 0) bars.energy = std::max(bars.energy, factor * off / sum);
}

/// Sums have at least the share of the loads' own bars; places are those of a cell. f: as the bars.
void keep_least(const Json& f, const LoadBars& least, double cell, Json& bars) {
  for (const auto& [key, value] : bars.items()) {
    const bool place = key.ends_with("y_m"), pressure = key == "p_max_Pa";
    if (value.is_object()) keep_least(f[key], least, cell, value);
    if (!value.is_number()) continue;
    if (place)
      value = value.get<double>() + cell;
    else
      value =
          std::max(value.get<double>(), (pressure ? least.pressure : least.energy) * std::abs(f[key].get<double>()));
  }
}

/// What has no bar is null.
void forget_unknown(Json& bars) {
  if (bars == "unknown") bars = nullptr;
  if (bars.is_structured())
    for (Json& value : bars) forget_unknown(value);
}

/// The rows with the deciding ones on larger cells; empty: one of them is not sound there.
std::vector<CollectiveRow> on_larger_cells(const CaseSpec& spec, std::vector<CollectiveRow> rows,
                                           const std::vector<std::size_t>& deciding,
                                           const std::filesystem::path& folder, const CollectiveOptions& options) {
  const std::vector<CollectiveRow> planned = plan_collective(spec);
  std::vector<CollectiveRow> again;
  for (const std::size_t i : deciding) {
    again.push_back(planned[i]);
    again.back().spec.geometry.lateral_shift = rows[i].spec.geometry.lateral_shift;  // that has the guiding force
    again.back().spec.collective.match_guiding_force = false;
  }
  solve_collective(again, folder, options);
  for (std::size_t n = 0; n < deciding.size(); ++n) {
    if (!again[n].sound()) return {};
    rows[deciding[n]] = std::move(again[n]);
  }
  return rows;
}

}  // namespace

std::vector<std::size_t> deciding_loads(const std::vector<CollectiveRow>& rows) {
  constexpr double kShare = 0.8;
  std::vector<std::size_t> order(rows.size()), out;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return !rows[i].sound(); });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rubbed(rows[a]) > rubbed(rows[b]); });
  const double all = rubbed(rows);
  double sum = 0;
  for (const std::size_t i : order) {
    if (sum >= kShare * all) break;
    sum += rubbed(rows[i]);
    out.push_back(i);
  }
  const auto add = [&](const CollectiveRow* row) {
    if (!row) return;
    const auto i = static_cast<std::size_t>(row - rows.data());
    if (std::find(out.begin(), out.end(), i) == out.end()) out.push_back(i);
  };
  add(worst_row(rows));
  add(most_pressed_row(rows));
  std::sort(out.begin(), out.end());
  return out;
}

Json collective_errors(const CaseSpec& spec, const std::vector<CollectiveRow>& rows, const CollectiveDamage& damage,
                       const Placement& placement, const std::filesystem::path& folder,
                       const CollectiveOptions& options) {
  constexpr std::array kCoarser{2.0, 4.0};
  const std::vector<std::size_t> deciding = deciding_loads(rows);
  if (deciding.empty()) return nullptr;
  double decided = 0;
  for (const std::size_t i : deciding) decided += rubbed(rows[i]);
  const double all = rubbed(rows), share = all > 0 ? decided / all : 1;
  const Json numbers = collective_numbers(rows, damage);
  Json out;
  LoadBars least;
  for (const double r : kCoarser) {
    CollectiveOptions larger = options;
    InfluenceCache cache;
    larger.bem.cell *= r;
    larger.wanted.planes = false;
    larger.bem.cache = &cache;
    const std::vector<CollectiveRow> there = on_larger_cells(spec, rows, deciding, folder, larger);
    if (there.empty()) continue;
    CollectiveDamage other{rail_damage(there, placement, larger.bem.cell),
                           wheel_damage(there, placement, larger.bem.cell)};
    other.lives = collective_lives(spec, there, other.rail, other.wheel);
    const double factor = grid_bar(1, r);
    widen(numbers, collective_numbers(there, other), factor / share, out);
    widen(rows, there, deciding, factor, least);
  }
  if (out.is_null()) return nullptr;
  forget_unknown(out);
  keep_least(numbers["totals"], least, damage.rail.cell, out["totals"]);
  Json names = Json::array();
  for (const std::size_t i : deciding) names.push_back(rows[i].name);
  out["loads"] = names;
  out["share_of_friction_energy"] = share;
  return out;
}

std::string bar_at(const Json& errors, const std::string& place, double factor) {
  const Json::json_pointer at(place);
  if (!errors.is_object() || !errors.contains(at) || !errors.at(at).is_number()) return "";
  return " ± " + significant(factor * errors.at(at).get<double>(), 2);
}

}  // namespace railstrata
