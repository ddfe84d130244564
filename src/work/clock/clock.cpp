#include "clock/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "clock/clock_lives.hpp"
#include "clock/clock_state.hpp"
#include "clock/metal_wheels.hpp"
#include "clock/wheel_kinds.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "lives/life_section.hpp"
#include "model/zone.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

constexpr double kDeepest = 12e-3;     // m, of the metal that is followed
constexpr double kThinnest = 0.05e-3;  // m, of a layer that still is one
constexpr double kBeside = 15e-3;      // m, of metal beside the outermost contacts
constexpr int kSteps = 3;              // of the metal through a stretch

/// What a load's contact was, to see whether it has changed.
struct ContactMark {
  double p_max = 0;
  std::vector<double> at;  ///< m, of its patches on the unworn profile
};

/// A step of wear, or a grinding: m, of the metal's columns. Traffic in wheels since the stretch's beginning.
struct Sinking {
  double from = 0, to = 0;
  std::vector<double> before, after;
};

class Clock {
 public:
  Clock(const CaseSpec& spec, const std::filesystem::path& folder, const ClockOptions& options)
      : spec_(kinds_of_wheels(spec)),
        folder_(folder),
        options_(options),
        unworn_(place(spec_, folder)),
        surface_(unworn_, options.bem.cell) {
    for (const std::size_t layer : layers_on(spec_, BodyId::rail))
      feet_.push_back((feet_.empty() ? 0 : feet_.back()) + spec_.layers[layer].thickness);
    options_.settle.control = options.control;
  }

  ClockResult run() {
    if (options_.begun)
      stand(*options_.begun);
    else
      begin();
    while (!at_horizon() && now_.out.ended.empty()) {
      stretch();
      if (!at_horizon()) keep();
    }
    if (spec_.loads.size() == 1) now_.out.groove = now_.out.history.back().removed;
    now_.out.lives = clock_lives(spec_, state(), unworn_.rail);
    for (const std::string& note :
         {now_.out.worn_through ? std::string() : now_.out.ended, fitted_ductility(spec_, now_.out.history),
          one_track(now_.out.groove), ratchets_on(now_.out.history), wearing_in(now_.out.history, now_.out.lives),
          unresolved_days(now_.out.history, now_.out.lives, options_.max_wear),
          crack_note(spec_.life.crack, now_.crack, now_.out.history)})
      if (!note.empty()) now_.out.notes.push_back(note);
    now_.out.profile = surface_.points();
    return std::move(now_.out);
  }

 private:
  void begin();
  void stand(const ClockState& begun);
  void set_up();
  ClockState state() const;
  void keep() const {
    if (options_.keep) options_.keep(state());
  }
  bool at_horizon() const { return now_.out.reached >= options_.horizon * kReached; }
  void progress(double wheels) const;
  void stretch();
  void solve(bool with_stresses);
  CaseSpec case_of_day() const;
  void put_wheels();
  std::vector<ContactMark> marks() const;
  double change_since(const std::vector<ContactMark>& from) const;
  void wear_until_changed();
  double wear_step(double most);
  void roll_metal();
  void gather(double from, double wheels);
  std::vector<GatheredDamage::ZoneRates> rates_of(int column) const;
  DamageRates rates_at(int column, std::size_t row) const;
  int zone_at(int column, double depth) const;
  std::vector<double> removed_of_columns() const;
  std::vector<double> day_feet() const;
  double largest_pressure() const;
  void grow_crack(ClockMoment& moment);
  void note(const ClockMoment& stretch);
  double wheels_until(double kg) const { return (kg - now_.out.reached) / now_.kilograms; }

  CaseSpec spec_;
  std::filesystem::path folder_;
  ClockOptions options_;
  Placement unworn_;
  std::vector<double> feet_;  ///< m, of the layers on the unworn rail
  ClockState now_;            ///< without what the next three hold; all of it: state()
  WornProfile surface_;
  std::optional<Metal> metal_;
  InteriorKernels kernels_;  // under the wheels
  std::optional<GatheredDamage> damages_;
  std::vector<CollectiveRow> rows_;   ///< solved for the next stretch; empty: they are not
  std::vector<std::size_t> load_of_;  ///< of the metal's wheels, the row
  std::vector<Sinking> sinkings_;
  double contact_change_ = 0;                ///< ClockMoment::contact_change of the stretch
  std::optional<CrackGrowth> crack_growth_;  ///< of the stretch; none: no crack has begun
};

CaseSpec Clock::case_of_day() const {
  CaseSpec out = spec_;
  out.geometry.gauge += surface_.gauge_widening();
  out.run.judged = JudgedBodies::rail;
  return out;
}

void Clock::solve(bool with_stresses) {
  rows_ = plan_collective(case_of_day());
  const std::vector<std::size_t> layers = layers_on(spec_, BodyId::rail);
  if (!layers.empty())
    for (CollectiveRow& row : rows_) {
      const Placement there = place(row.spec, folder_, &surface_.profile());
      row.spec.layers[layers.front()].thickness -= surface_.removed_at(surface_.unworn_s_of(there.contact.rail_s));
    }
  CollectiveOptions how;
  how.bem = options_.bem;
  how.rail = &surface_.profile();
  how.keep_results = with_stresses;
  how.wanted = {
      .rail = false, .wheel = false, .shakedown = with_stresses, .planes = false, .crack = false, .life = false};
  how.control = nullptr;
  solve_collective(rows_, folder_, how);
  if (asked_to_stop(options_.control)) throw Interrupted("stopped between two profiles");
  double wheels = 0, left_out = 0;
  for (const CollectiveRow& row : rows_) {
    wheels += row.passages;
    if (row.sound()) continue;
    left_out += row.passages;
    if (now_.noted.insert(row.name).second)
      now_.out.notes.push_back(fmt::format("{}: left out from {:.3g} MGT on for as long as it cannot be solved: {}",
                                           row.name, 1e-9 * now_.out.reached, row.fault));
  }
  if (left_out != wheels) return;
  if (now_.out.history.empty()) throw CaseError("no load of the collective can be solved", rows_.front().fault);
  now_.out.ended =
      fmt::format("after {:.3g} MGT no load can be solved any more: {}", 1e-9 * now_.out.reached, rows_.front().fault);
}

void Clock::begin() {
  solve(true);
  double kilograms = 0;
  for (const CollectiveRow& row : rows_) {
    now_.out.wheels += row.passages;
    if (row.solved()) kilograms += 1e3 * row.tonnes();
  }
  now_.kilograms = kilograms / now_.out.wheels;
  now_.out.tonnes = 1e-3 * kilograms;
  if (spec_.life.grinding.every) now_.next_grinding = *spec_.life.grinding.every;
  double from = kNever, to = -kNever;
  for (const CollectiveRow& row : rows_)
    for (const PatchDamage& patch : row.patches) {
      from = std::min(from, patch.contact.rail_s - kBeside);
      to = std::max(to, patch.contact.rail_s + kBeside);
    }
  from = std::max(from, unworn_.rail.s_min());
  to = std::min(to, unworn_.rail.s_max());
  now_.grid = metal_grid(from, to, options_.apart, options_.first_row, kDeepest);
  now_.metal_removed.assign(static_cast<std::size_t>(now_.grid.columns), 0.0);
  set_up();
  if (const CrackSpec& crack = spec_.life.crack; crack.depth > 0 && crack.place)
    now_.crack = {.s = unworn_.rail.s_at_y(*crack.place), .tip = crack.depth, .begun = 0};
  ClockMoment& start = now_.out.history.emplace_back();
  start.p_max = largest_pressure();
  if (!feet_.empty()) start.layer_left = feet_.front();
  keep();
}

/// Metal and damage, still without any, on the grid.
void Clock::set_up() {
  metal_.emplace(now_.grid, spec_.passes.ductility.value_or(0));
  std::vector<double> s;
  for (int c = 0; c < now_.grid.columns; ++c) s.push_back(now_.grid.s(c));
  damages_.emplace(std::move(s), feet_, kDeepest);
}

void Clock::stand(const ClockState& begun) {
  now_ = begun;
  set_up();
  metal_->stand(std::move(now_.metal));
  surface_.stand(std::move(now_.surface));
  damages_->stand(std::move(now_.damage));
}

ClockState Clock::state() const {
  ClockState out = now_;
  out.metal = metal_->state();
  out.surface = surface_.worn();
  out.damage = damages_->gathered();
  return out;
}

/// All wheels until then have worn the rail and rolled through its metal.
void Clock::progress(double wheels) const {
  if (options_.control) options_.control->progress("traffic", wheels * now_.kilograms / options_.horizon);
}

std::vector<double> Clock::removed_of_columns() const {
  std::vector<double> out;
  for (int c = 0; c < metal_->grid().columns; ++c) out.push_back(surface_.removed_at(metal_->grid().s(c)));
  return out;
}

std::vector<double> Clock::day_feet() const {
  const double most = *std::max_element(surface_.removed().begin(), surface_.removed().end());
  std::vector<double> out;
  for (const double foot : feet_) out.push_back(foot - most);
  return out;
}

std::vector<ContactMark> Clock::marks() const {
  std::vector<ContactMark> out;
  for (const CollectiveRow& row : rows_) {
    ContactMark& mark = out.emplace_back();
    if (!row.sound()) continue;
    mark.p_max = row.summary.contact.patch.p_max;
    for (const PatchDamage& patch : row.patches) mark.at.push_back(surface_.unworn_s_of(patch.contact.rail_s));
  }
  return out;
}

/// Of what may change in a stretch, in the mean square of all wheels; a patch that has come or gone is the change that
/// is allowed, and none counts for more than four of it, so that a few loads that go from tread to flange do not end
/// every stretch.
double Clock::change_since(const std::vector<ContactMark>& from) const {
  constexpr double kMost = 4;
  const std::vector<ContactMark> now = marks();
  double sum = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    double by = std::abs(now[i].p_max - from[i].p_max) / (options_.change * std::max(from[i].p_max, now[i].p_max));
    if (now[i].at.size() != from[i].at.size()) by = std::max(by, 1.0);
    for (std::size_t k = 0; k < std::min(now[i].at.size(), from[i].at.size()); ++k)
      by = std::max(by, std::abs(now[i].at[k] - from[i].at[k]) / options_.moved);
    by = std::min(by, kMost);
    if (now[i].p_max > 0 || from[i].p_max > 0) sum += rows_[i].passages / now_.out.wheels * by * by;
  }
  return std::sqrt(sum);
}

void Clock::put_wheels() {
  const std::vector<double> removed = removed_of_columns();
  std::vector<double> since = removed;
  for (std::size_t c = 0; c < since.size(); ++c) since[c] -= now_.metal_removed[c];
  metal_->sink(since);
  now_.metal_removed = removed;
  MetalWheels put = metal_wheels(rows_, surface_, metal_->grid(), now_.out.wheels, kernels_);
  for (const MetalWheels::Fault& fault : put.faults)
    if (now_.noted.insert(rows_[fault.load].name + "/flow").second)
      now_.out.notes.push_back(fmt::format("{}: at {:.3g} MGT its metal is not followed: {}", rows_[fault.load].name,
                                           1e-9 * now_.out.reached, fault.why));
  load_of_ = std::move(put.load_of);
  now_.followed = now_.followed || !put.wheels.empty();
  metal_->put(std::move(put.wheels));
  crack_growth_.reset();
  if (now_.crack.there())
    crack_growth_.emplace(spec_.life.crack,
                          crack_loads(spec_.life.crack, rows_, now_.out.wheels, {now_.crack, surface_, *metal_}));
  for (CollectiveRow& row : rows_) row.result.reset();
}

void Clock::grow_crack(ClockMoment& moment) {
  const CrackSpec& crack = spec_.life.crack;
  if (!now_.crack.there()) begin_crack(crack, damages_->gathered(), surface_, now_.kilograms, now_.crack);
  if (!now_.crack.there()) return;
  const std::size_t column = metal_->grid().nearest(now_.crack.s);
  if (crack_growth_) {
    take_direction(crack, *crack_growth_, now_.crack);
    for (const Sinking& s : sinkings_)
      grow(crack, *crack_growth_,
           {s.to - s.from, s.before[column], s.after[column], s.from * now_.kilograms, now_.kilograms}, now_.crack);
  }
  moment.crack = now_.crack.tip - sinkings_.back().after[column];
  if (crack_growth_) moment.crack_growth = crack_growth_->rate(moment.crack) / now_.kilograms;
}

/// Wears the profile by at most so many wheels; how many they were.
double Clock::wear_step(double most) {
  const Placement placement = place(case_of_day(), folder_, &surface_.profile());
  const RailDamage cells = rail_damage(rows_, placement, options_.bem.cell);
  const std::vector<double> depth = smoothed_wear(cells, spec_.collective.wear_law);
  double deepest = 0;
  for (const double d : depth) deepest = std::max(deepest, std::isfinite(d) ? d : 0);
  double wheels = most;
  if (deepest > 0) wheels = std::min(wheels, now_.out.wheels * options_.max_wear / deepest);
  Sinking sinking{.from = now_.wheels, .to = now_.wheels + wheels, .before = removed_of_columns(), .after = {}};
  if (deepest > 0) {
    std::vector<double> step;
    for (const double d : depth) step.push_back(std::isfinite(d) ? d * wheels / now_.out.wheels : 0);
    surface_.wear(cells, step);
  }
  sinking.after = removed_of_columns();
  sinkings_.push_back(std::move(sinking));
  now_.wheels += wheels;
  now_.out.reached += wheels * now_.kilograms;
  return wheels;
}

/// Steps of wear and grindings until a contact has changed, the horizon is reached or a layer is through.
void Clock::wear_until_changed() {
  const std::vector<ContactMark> from = marks();
  sinkings_.clear();
  contact_change_ = 0;
  for (;;) {
    const double end = std::min(options_.horizon, now_.next_grinding);
    wear_step(wheels_until(end));
    progress(sinkings_.front().from);
    if (now_.out.reached >= now_.next_grinding * kReached) {
      Sinking grinding{.from = now_.wheels, .to = now_.wheels, .before = removed_of_columns(), .after = {}};
      surface_.grind(spec_.life.grinding.depth);
      grinding.after = removed_of_columns();
      sinkings_.push_back(std::move(grinding));
      now_.next_grinding += *spec_.life.grinding.every;
    }
    if (at_horizon()) return;
    if (!feet_.empty() && day_feet().front() < kThinnest) {
      now_.out.ended = fmt::format("layer worn through after {:.3g} MGT", 1e-9 * now_.out.reached);
      now_.out.worn_through = true;
      return;
    }
    solve(false);
    if (!now_.out.ended.empty()) return;
    contact_change_ = change_since(from);
    if (contact_change_ > 1) return;
  }
}

DamageRates Clock::rates_at(int column, std::size_t row) const {
  const MetalGrid& g = metal_->grid();
  const std::size_t n = row * static_cast<std::size_t>(g.columns) + static_cast<std::size_t>(column);
  DamageRates out;
  const MetalFlow& flow = metal_->flow();
  if (!flow.net.empty() && spec_.passes.ductility) out.ductility = flow.net[n] / *spec_.passes.ductility;
  if (!flow.cycles.empty()) out.cycles = flow.cycles[n];
  const int zone = zone_at(column, g.depths()[row]);
  const FatigueSpec& f = zone_material(spec_, BodyId::rail, zone).strength.fatigue;
  if (!f.limit || !f.dang_van || !f.exponent) return out;
  const SigmaN line{*f.exponent, f.cycles};
  const double at = surface_.day_s(g.s(column)), depth = g.depths()[row];
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!rows_[i].sound()) continue;
    bool flows = false;
    for (std::size_t k = 0; k < load_of_.size(); ++k)
      flows = flows || (load_of_[k] == i && flow.flowed[k][n] >= kNoFlow);
    if (flows) continue;
    for (const SectionShakedown& found : rows_[i].sections) {
      if (found.body != BodyId::rail || found.fatigue.dang_van_used.empty()) continue;
      const PatchDamage& patch = rows_[i].patches[std::min(found.patch, rows_[i].patches.size() - 1)];
      const LifeSection section{&found.y, &found.depth, &found.zone, patch.contact.rail_s};
      const std::optional<RowsBeside> rows = rows_beside(section, zone, depth);
      if (!rows || depth > found.depth.back()) continue;
      const double used = value_at(section, found.fatigue.dang_van_used, *rows, at);
      for (std::size_t v = 0; v < out.fatigue.size(); ++v)
        out.fatigue[v] += rows_[i].passages / now_.out.wheels * fatigue_rate(used, line, v);
    }
  }
  return out;
}

/// Of the metal so deep below the surface of the day.
int Clock::zone_at(int column, double depth) const {
  for (std::size_t k = 0; k < feet_.size(); ++k)
    if (depth < feet_[k] - now_.metal_removed[static_cast<std::size_t>(column)]) return static_cast<int>(k) + 1;
  return 0;
}

std::vector<GatheredDamage::ZoneRates> Clock::rates_of(int column) const {
  const MetalGrid& g = metal_->grid();
  const std::vector<double> depths = g.depths();
  std::vector<GatheredDamage::ZoneRates> out;
  for (std::size_t r = 0; r < depths.size(); ++r) {
    const int zone = zone_at(column, depths[r]);
    if (out.empty() || out.back().zone != zone) out.push_back({.zone = zone, .depth = {}, .rates = {}});
    out.back().depth.push_back(depths[r]);
    out.back().rates.push_back(rates_at(column, r));
    out.back().ends = r + 1 == depths.size();
  }
  return out;
}

/// The damage of so many wheels from `from` on, at the rates that the metal has now.
void Clock::gather(double from, double wheels) {
  const double to = from + wheels;
  for (int c = 0; c < metal_->grid().columns; ++c) {
    const std::vector<GatheredDamage::ZoneRates> rates = rates_of(c);
    const auto column = static_cast<std::size_t>(c);
    for (const Sinking& s : sinkings_) {
      const double begin = std::max(from, s.from), end = std::min(to, s.to);
      if (!(end > begin)) continue;
      const double sunk = (s.after[column] - s.before[column]) / (s.to - s.from);
      damages_->gather(
          column, rates,
          {end - begin, s.before[column] + sunk * (begin - s.from), s.before[column] + sunk * (end - s.from)}, begin);
    }
  }
}

/// Takes the metal through the stretch's traffic, in steps that grow.
void Clock::roll_metal() {
  const double begin = sinkings_.front().from, all = now_.wheels - begin;
  ClockMoment moment;
  double step = all * (options_.growth - 1) / (std::pow(options_.growth, kSteps) - 1), from = begin;
  for (int done = 1; from < now_.wheels; ++done) {
    const double left = now_.wheels - from;
    const double wheels = left < 1.5 * step ? left : step;
    const SettledState settled = metal_->roll(wheels, options_.settle);
    moment.changes += settled.changes;
    moment.unsettled = std::max(moment.unsettled, settled.unsettled);
    gather(from, wheels);
    from += wheels;
    step *= options_.growth;
    progress(begin + all * std::min(done, kSteps) / kSteps);  // steps take alike long
  }
  grow_crack(moment);
  note(moment);
}

void Clock::stretch() {
  if (rows_.empty()) solve(true);
  if (!now_.out.ended.empty()) return;
  const std::vector<CollectiveRow> before = [&] {
    put_wheels();
    return rows_;
  }();
  wear_until_changed();
  rows_ = before;  // whose stresses the metal has
  roll_metal();
  rows_.clear();
}

double Clock::largest_pressure() const {
  double out = 0;
  for (const CollectiveRow& row : rows_)
    if (row.sound()) out = std::max(out, row.summary.contact.patch.p_max);
  return out;
}

void Clock::note(const ClockMoment& of_stretch) {
  ClockMoment m = of_stretch;
  m.kilograms = now_.out.reached;
  m.contact_change = contact_change_;
  const std::vector<double>& removed = surface_.removed();
  const auto most = std::max_element(removed.begin(), removed.end());
  m.removed = *most;
  m.removed_y = unworn_.rail.at(surface_.unworn_s()[static_cast<std::size_t>(most - removed.begin())]).position.y;
  m.gauge_widening = surface_.gauge_widening();
  m.p_max = largest_pressure();
  if (!feet_.empty()) m.layer_left = std::max(0.0, day_feet().front());
  const std::vector<double> gone = removed_of_columns();
  const WorstPoint ductility = damages_->worst(0, gone), cycles = damages_->worst(2, gone),
                   fatigue = damages_->worst(5, gone);
  m.ductility = ductility.damage;
  m.ductility_y = unworn_.rail.at(ductility.s).position.y;
  m.ductility_depth = ductility.depth - surface_.removed_at(ductility.s);
  m.exhausted = damages_->depth_reached(0, gone);
  m.cycles = cycles.damage;
  m.fatigue = fatigue.damage;
  if (!metal_->flow().net.empty()) m.net = *std::max_element(metal_->flow().net.begin(), metal_->flow().net.end());
  now_.out.history.push_back(m);
  if (options_.control)
    options_.control->detail(
        "{:.3g} MGT: removed {:.0f} µm, p_max {:.0f} MPa, strain {:.2e} a wheel, ductility used {:.3g} (y {:.1f} mm, "
        "{:.2f} mm deep), used up to {:.2f} mm, {} changes, {:.2f} unsettled",
        1e-9 * m.kilograms, 1e6 * m.removed, 1e-6 * m.p_max, m.net, m.ductility, 1e3 * m.ductility_y,
        1e3 * m.ductility_depth, 1e3 * m.exhausted, m.changes, m.unsettled);
}

}  // namespace

ClockResult run_clock(const CaseSpec& spec, const std::filesystem::path& folder, const ClockOptions& options) {
  return Clock(spec, folder, options).run();
}

}  // namespace railstrata
