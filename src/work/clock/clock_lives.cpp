#include "clock/clock_lives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "judge/check_limits.hpp"
#include "lives/life_section.hpp"
#include "model/zone.hpp"
#include "record/number_text.hpp"
#include "steady/pass_class.hpp"

namespace railstrata {
namespace {

/// The key that a mechanism (0: ductility, 1: closed cycles, 2: fatigue) lacks in a zone; empty: none.
std::string lacks(const CaseSpec& spec, const ClockState& at, int zone, std::size_t mechanism) {
  if (mechanism < 2)
    return !spec.passes.ductility ? "passes.ductility" : !at.followed ? "the strength of the rail" : "";
  const FatigueSpec& f = zone_material(spec, BodyId::rail, zone).strength.fatigue;
  const char* key = !f.limit ? "fatigue_limit" : !f.dang_van ? "dang_van_coefficient" : "fatigue_exponent";
  return f.limit && f.dang_van && f.exponent ? "" : fmt::format("{}.{}", zone_key(spec, BodyId::rail, zone), key);
}

LifeRow life_row(const CaseSpec& spec, const ClockState& at, const Profile& unworn, const DamageKey& key) {
  static constexpr std::array kMechanisms{"ductility exhausted", "low-cycle fatigue", "fatigue"};
  const std::size_t mechanism = key.damage == 0 ? 0 : key.damage < 4 ? 1 : 2;
  LifeRow row{.body = std::string(body_word(BodyId::rail)),
              .zone = zone_name(spec, BodyId::rail, key.zone),
              .place = key.surface ? "at the surface" : "below",
              .mechanism = kMechanisms[mechanism]};
  if (std::string lacking = lacks(spec, at, key.zone, mechanism); !lacking.empty()) {
    row.place = "";
    row.rests_on = std::move(lacking);
    return row;
  }
  const std::size_t first = mechanism == 0 ? 0 : mechanism == 1 ? 1 : 4, count = mechanism == 0 ? 1 : 3;
  constexpr std::array<double LifeRange::*, 3> kVariants{&LifeRange::low, &LifeRange::best, &LifeRange::high};
  for (std::size_t v = 0; v < kVariants.size(); ++v) {
    const auto found = at.damage.failures.find({key.zone, key.surface, first + (count == 1 ? 0 : v)});
    const bool fails = found != at.damage.failures.end();
    row.wheels.*kVariants[v] = fails ? found->second.traffic : kNever;
    row.mgt.*kVariants[v] = fails ? 1e-9 * at.kilograms * found->second.traffic : kNever;
    if (fails && (v == 1 || count == 1)) {
      row.depth = found->second.depth;
      row.y = unworn.at(found->second.s).position.y;
    }
  }
  row.followed = 1e-9 * at.out.reached;
  row.rests_on = fmt::format("followed to {:.3g} MGT", row.followed);
  if (mechanism < 2) row.rests_on += fmt::format("; passes.ductility = {}", *spec.passes.ductility);
  return row;
}

LifeRow crack_row(const CaseSpec& spec, const ClockState& at, const Profile& unworn) {
  const CrackSpec& crack = spec.life.crack;
  const RailCrack& now = at.crack;
  const double wheels = now.allowable / at.kilograms, mgt = 1e-9 * now.allowable, followed = 1e-9 * at.out.reached;
  LifeRow row{.body = std::string(body_word(BodyId::rail)),
              .zone = zone_name(spec, BodyId::rail, 0),
              .place = "from the surface",
              .mechanism = "crack too deep",
              .wheels = {wheels, wheels, wheels},
              .mgt = {mgt, mgt, mgt},
              .rests_on = fmt::format("crack.face_friction = {}, crack.allowable = {} mm, followed to {:.3g} MGT",
                                      crack.face_friction, 1e3 * crack.allowable, followed),
              .followed = followed};
  if (!now.there()) return row;
  row.y = unworn.at(now.s).position.y;
  row.depth = now.allowable < RailCrack::kNot ? crack.allowable : at.out.history.back().crack;
  return row;
}

}  // namespace

std::vector<LifeRow> clock_lives(const CaseSpec& spec, const ClockState& at, const Profile& unworn) {
  std::vector<LifeRow> out;
  const std::size_t zones = layers_on(spec, BodyId::rail).size();
  for (std::size_t zone = 0; zone <= zones; ++zone)
    for (const std::size_t damage : {std::size_t{0}, std::size_t{1}, std::size_t{4}})
      for (const bool surface : {true, false}) {
        if (surface && zone != (zones > 0 ? 1u : 0u)) continue;
        out.push_back(life_row(spec, at, unworn, {static_cast<int>(zone), surface, damage}));
        if (out.back().place.empty()) break;  // not known, wherever
      }
  if (zones > 0) {
    const double when = at.out.worn_through ? 1e-9 * at.out.reached : kNever;
    const double wheels = at.out.worn_through ? at.wheels : kNever;
    out.push_back({.body = std::string(body_word(BodyId::rail)),
                   .zone = zone_name(spec, BodyId::rail, 1),
                   .place = "layer",
                   .mechanism = kWornThrough,
                   .wheels = {wheels, wheels, wheels},
                   .mgt = {when, when, when},
                   .rests_on = fmt::format("followed to {:.3g} MGT", 1e-9 * at.out.reached),
                   .followed = 1e-9 * at.out.reached});
  }
  if (spec.life.crack.depth > 0) out.push_back(crack_row(spec, at, unworn));
  return out;
}

std::string fitted_ductility(const CaseSpec& spec, const std::vector<ClockMoment>& history) {
  const std::optional<double> cracked = spec.life.first_cracks;
  if (!cracked || history.empty()) return {};
  const auto after = std::find_if(history.begin(), history.end(),
                                  [&](const ClockMoment& m) { return m.kilograms >= *cracked * kReached; });
  const double date = 1e-9 * *cracked;
  if (!spec.passes.ductility)
    return fmt::format(
        "first cracks after {:.3g} MGT: give passes.ductility, 5 for a rail; without it no strain counts", date);
  if (after == history.begin() || after == history.end())
    return fmt::format("first cracks after {:.3g} MGT: the rail was not followed so far", date);
  const ClockMoment& before = *(after - 1);
  const double share = (*cracked - before.kilograms) / (after->kilograms - before.kilograms);
  const double used = before.ductility + share * (after->ductility - before.ductility);
  if (!(used > 0)) return fmt::format("first cracks after {:.3g} MGT: no metal has yielded by then", date);
  return fmt::format("first cracks after {:.3g} MGT: passes.ductility = {:.3g} gives this, with {:.3g} now", date,
                     used * *spec.passes.ductility, *spec.passes.ductility);
}

std::string one_track(double groove) {
  static constexpr const CheckRow& kRow = check_row("wheels_in_one_track");
  if (!(groove > kRow.bem_limit)) return {};
  return fmt::format("{} ({}): {}", kRow.what, with_unit(kRow.unit, groove, 3), kRow.advice);
}

std::string ratchets_on(const std::vector<ClockMoment>& history) {
  if (history.empty() || history.back().net < kNoFlow) return {};
  const ClockMoment& end = history.back();
  const auto half = std::find_if(history.begin(), history.end() - 1,
                                 [&](const ClockMoment& m) { return m.net > 0 && m.kilograms >= 0.5 * end.kilograms; });
  if (half == history.end() - 1 || end.net < half->net * std::sqrt(half->kilograms / end.kilograms)) return {};
  return fmt::format(
      "strain still grows by {:.2g} a wheel and hardly fades: the law of hardening ratchets for ever, while the rate "
      "of rail steel falls, so lives by ductility are lower limits; the traffic after which a rail of this line had "
      "its first cracks gives their scale (life.first_cracks)",
      end.net);
}

std::string unresolved_days(const std::vector<ClockMoment>& history, const std::vector<LifeRow>& lives,
                            double max_wear) {
  constexpr double kSingle = 1.01;     // steps of wear, but for rounding
  constexpr double kMuchDamage = 0.1;  // of the ductility
  if (history.empty()) return {};
  std::size_t end = 0;
  while (end + 1 < history.size() && history[end + 1].contact_change > 1 &&
         history[end + 1].removed - history[end].removed <= kSingle * max_wear)
    ++end;
  const double until = 1e-9 * history[end].kilograms;
  const LifeRow* first = first_damage(lives);
  const bool fails = first && first->mgt.best <= until;
  if (end == 0 || !(fails || history[end].ductility > kMuchDamage)) return {};
  double most = 0;
  for (std::size_t i = 1; i <= end; ++i) most = std::max(most, history[i].contact_change);
  return fmt::format(
      "days before {:.2g} MGT are not resolved: one step of wear ({:.2g} mm) changes the contacts there by up to "
      "{:.2g} "
      "times what ends a stretch, and damage by then depends on the method by a factor of two{}",
      until, 1e3 * max_wear, most, fails ? ", so does the first crack" : "");
}

std::string wearing_in(const std::vector<ClockMoment>& history, const std::vector<LifeRow>& lives) {
  constexpr double kWornIn = 1.25;  // largest pressure over that at the end
  const LifeRow* first = first_damage(lives);
  if (!first || !(first->mgt.best < kNever) || first->mechanism == "fatigue" || history.empty()) return {};
  const auto worn = std::find_if(history.begin(), history.end(),
                                 [&](const ClockMoment& m) { return m.p_max <= kWornIn * history.back().p_max; });
  const double until = 1e-9 * worn->kilograms;
  if (worn == history.end() || first->mgt.best >= until) return {};
  return fmt::format(
      "the first crack comes while the profile wears in, which takes {:.3g} MGT: the pressure of elastic bodies, "
      "{:.0f} "
      "MPa at first and {:.0f} MPa in the end, is more than the metal bears, so this life is a lower limit; give "
      "worn_rail.csv as geometry.rail_profile, and geometry.gauge wider by {:.2f} mm, for the life from then on",
      until, 1e-6 * history.front().p_max, 1e-6 * history.back().p_max, 1e3 * history.back().gauge_widening);
}

}  // namespace railstrata
