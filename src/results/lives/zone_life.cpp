#include "lives/zone_life.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "lives/life_section.hpp"
#include "model/zone.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::array<double LifeRange::*, 3> kVariants{&LifeRange::low, &LifeRange::best, &LifeRange::high};

/// All of a body's zone that its mechanisms need.
struct LifeZone {
  const CaseSpec& spec;
  const std::vector<LifeLoad>& loads;
  const LifeAcross& across;
  int zone = 0;
  double top = 0, bottom = kNever;
  std::vector<AsideShare> aside{};  // where the wheels of a load run
  std::vector<double> depth{};      // of the tables
  std::string key{};                // of the material in the case

  const StrengthSpec& strength() const { return zone_material(spec, across.body, zone).strength; }
  LifeRow row(const char* place, const char* mechanism) const {
    const std::string body(body_word(across.body));
    return {.body = body, .zone = zone_name(spec, across.body, zone), .place = place, .mechanism = mechanism};
  }
};

/// Adds at every depth of a place what one load does there, in one of the three variants.
using AddKind = std::function<void(const LifeLoad&, double s, std::size_t variant, KindDamage&)>;

/// What the wheels of a kind do, mean over where they run.
KindDamage damage_of_kind(const LifeZone& z, const LifeLoad& load, double s, std::size_t variant, const AddKind& add) {
  KindDamage out{.wheels = load.passages};
  for (const AsideShare& aside : z.aside) {
    KindDamage one;
    add(load, s - aside.offset, variant, one);
    out.rate.resize(one.rate.size());
    for (std::size_t j = 0; j < one.rate.size(); ++j) out.rate[j] += aside.share * one.rate[j];
  }
  return out;
}

DamagedPlace damaged_place(const LifeZone& z, std::size_t cell, std::size_t variant, const AddKind& add) {
  DamagedPlace out{.depth = z.depth, .kinds = {}, .top = z.top, .bottom = z.bottom};
  for (const LifeLoad& load : z.loads) {
    KindDamage kind = damage_of_kind(z, load, z.across.s[cell], variant, add);
    if (!kind.rate.empty()) out.kinds.push_back(std::move(kind));
  }
  return out;
}

/// The place across where the zone fails first, by the best values; wear only lengthens what no wear gives.
struct WorstPlace {
  std::size_t cell = 0;
  Failure failure;
};
std::optional<WorstPlace> worst_place(const LifeZone& z, const AddKind& add, double from, double to) {
  std::vector<std::pair<double, std::size_t>> unworn;
  for (std::size_t cell = 0; cell < z.across.s.size(); ++cell) {
    if (!(z.across.passages[cell] > 0)) continue;
    const DamagedPlace place = damaged_place(z, cell, 1, add);
    if (!place.kinds.empty()) unworn.emplace_back(first_failure(place, {}, 0, kNever).traffic, cell);
  }
  std::sort(unworn.begin(), unworn.end());
  std::optional<WorstPlace> out;
  for (const auto& [least, cell] : unworn) {
    if (out && least >= out->failure.traffic) break;
    const Failure f = first_failure(damaged_place(z, cell, 1, add), z.across.removal(cell, z.across.law), from, to);
    if (!out || f.traffic < out->failure.traffic) out = WorstPlace{cell, f};
  }
  return out;
}

/// Rows of a body, in units of traffic, and of those by damage the shortest.
struct FoundLives {
  std::vector<LifeRow> rows;
  double units = kNever;  ///< by the best values; without removal where it never fails
  std::optional<DamagedPlace> place{};
  std::size_t cell = 0;
};
void keep_shortest(const LifeZone& z, const AddKind& add, const WorstPlace& worst, FoundLives& out) {
  const DamagedPlace place = damaged_place(z, worst.cell, 1, add);
  const double units =
      std::isfinite(worst.failure.traffic) ? worst.failure.traffic : 3 * first_failure(place, {}, 0, kNever).traffic;
  if (!(units < out.units)) return;
  out.units = units;
  out.place = place;
  out.cell = worst.cell;
}

void add_row(const LifeZone& z, const AddKind& add, const char* mechanism, const std::string& rests_on,
             FoundLives& out) {
  const bool surface = z.top == 0;
  for (const bool at_surface : {true, false}) {
    if (at_surface && !surface) continue;
    const double from = at_surface ? 0 : surface ? kSkin : 0, to = at_surface ? kSkin : kNever;
    const std::optional<WorstPlace> worst = worst_place(z, add, from, to);
    if (!worst) continue;
    LifeRow row = z.row(at_surface ? "at the surface" : "below", mechanism);
    for (std::size_t v = 0; v < kVariants.size(); ++v)
      row.wheels.*kVariants[v] =
          first_failure(damaged_place(z, worst->cell, v, add), z.across.removal(worst->cell, z.across.law), from, to)
              .traffic;
    if (std::isfinite(row.wheels.best)) row.depth = worst->failure.depth;
    row.y = z.across.y[worst->cell];
    row.rests_on = rests_on;
    out.rows.push_back(row);
    keep_shortest(z, add, *worst, out);
  }
}

LifeRow missing(const LifeZone& z, const char* mechanism, const std::string& what) {
  LifeRow out = z.row("", mechanism);
  out.rests_on = what;
  return out;
}

/// Whether a load makes the zone yield for ever, by its factor for wandering traffic.
bool yields(const LifeZone& z, const LifeLoad& load) {
  const SectionShakedown* section = section_of(load, z.across.body);
  if (!section) return false;
  for (const ZoneFactors& f : section->found.zones)
    if (f.zone == z.zone) return f.wandering.value < 1;
  return false;
}

AddKind by_fatigue(const LifeZone& z) {
  return [&z](const LifeLoad& load, double s, std::size_t variant, KindDamage& kind) {
    const SectionShakedown* found = section_of(load, z.across.body);
    if (!found || found->fatigue.dang_van_used.empty()) return;
    const LifeSection section{&found->y, &found->depth, &found->zone, middle_of(load, z.across.body, found->patch)};
    const SigmaN line{*z.strength().fatigue.exponent, z.strength().fatigue.cycles};
    const double strength = strength_factor(z.spec, variant);
    for (const double depth : z.depth) {
      const std::optional<RowsBeside> rows = rows_beside(section, z.zone, depth);
      const double used = rows ? value_at(section, found->fatigue.dang_van_used, *rows, s) : 0;
      kind.rate.push_back(fatigue_rate(used / strength, line, variant));
    }
  };
}

/// ", strengths ± 20 %", or nothing.
std::string scatter_text(const CaseSpec& spec) {
  const double scatter = spec.life.strength_scatter.value_or(0);
  return scatter > 0 ? fmt::format(", strengths ± {:.3g} %", 100 * (strength_factor(spec, 2) - 1)) : "";
}

void add_damages(const LifeZone& z, FoundLives& out) {
  const FatigueSpec& f = z.strength().fatigue;
  const bool yielding = std::any_of(z.loads.begin(), z.loads.end(), [&](const LifeLoad& l) { return yields(z, l); });
  if (!f.limit || !f.dang_van || !f.exponent)
    out.rows.push_back(missing(z, "fatigue",
                               fmt::format("{0}.{1}", z.key,
                                           !f.limit      ? "fatigue_limit"
                                           : !f.dang_van ? "dang_van_coefficient"
                                                         : "fatigue_exponent")));
  else
    add_row(z, by_fatigue(z), "fatigue",
            fmt::format("Dang Van, {:.0f} MPa at {:.3g} cycles, exponent {}{}; Miner's sum 1/3 to 3", 1e-6 * *f.limit,
                        f.cycles, *f.exponent, scatter_text(z.spec)),
            out);
  if (yielding)
    out.rows.push_back(missing(z, "ductility exhausted",
                               z.across.body == BodyId::rail ? "life.until" : "passes over a wheel are not computed"));
}

/// Units until wear and grinding have taken so much somewhere, and where.
void add_worn_through(const LifeZone& z, std::vector<LifeRow>& out) {
  LifeRow row = z.row("layer", kWornThrough);
  for (const WearLaw law : kWearLaws) {
    if (z.across.wear[static_cast<std::size_t>(law)].empty()) continue;
    double least = kNever;
    for (std::size_t cell = 0; cell < z.across.s.size(); ++cell)
      if (z.across.passages[cell] > 0) {
        const double until = z.across.removal(cell, law).until(z.bottom);
        if (law == z.across.law && until < least) row.y = z.across.y[cell];
        least = std::min(least, until);
      }
    row.wheels.low = std::fmin(row.wheels.low, least);
    row.wheels.high = std::fmax(row.wheels.high, least);
    if (law == z.across.law) row.wheels.best = least;
  }
  row.rests_on = row.known() ? "wear of the unworn profile, from the wear laws with data"
                             : "data of collective.wear_law: hardness, wear_coefficient";
  out.push_back(row);
}

/// What the stresses of any load do to a layer at once.
void add_strengths(const LifeZone& z, std::vector<LifeRow>& out) {
  LifeRow cracks = z.row("layer", "layer cracks"), shears = z.row("interface", "interface shears");
  double tension = kNotApplicable, bond = kNotApplicable;
  for (const LifeLoad& load : z.loads) {
    const SectionShakedown* section = section_of(load, z.across.body);
    if (!section) continue;
    for (const BrittleSummary& b : section->fatigue.brittle)
      if (b.zone == cracks.zone) tension = std::fmax(tension, b.share_of_tensile);
    for (const InterfaceSummary& i : section->fatigue.interfaces)
      if (i.above == cracks.zone) bond = std::fmax(bond, i.delamination);
  }
  const auto judge = [&](LifeRow row, double share, const std::string& words, const std::string& key) {
    for (std::size_t v = 0; v < kVariants.size() && !std::isnan(share); ++v)
      row.wheels.*kVariants[v] = share / strength_factor(z.spec, v) >= 1 ? 0 : kNever;
    row.rests_on = std::isnan(share) ? key
                                     : fmt::format("{} {:.2f}{}; {}", words, share, scatter_text(z.spec),
                                                   share >= 1 ? "the first wheel reaches it" : "not of many cycles");
    out.push_back(row);
  };
  judge(cracks, tension, "σ₁ with the residual stress over tensile_strength", z.key + ".tensile_strength");
  judge(shears, bond, "delamination index", z.key + ".bond_shear, bond_tension");
}

std::vector<double> table_depths(double top, double bottom, double deepest) {
  constexpr int kRows = 24;
  const double end = std::min(bottom, deepest);
  std::vector<double> out;
  for (int r = 0; r <= kRows; ++r) out.push_back(top + (end - top) * r * r / (kRows * kRows));
  return out;
}

double deepest_of(const std::vector<LifeLoad>& loads, BodyId body) {
  double out = 0;
  for (const LifeLoad& load : loads) {
    if (const SectionShakedown* s = section_of(load, body)) out = std::max(out, s->depth.back());
  }
  return out;
}

LifeCurve curve_of(const LifeAcross& across, const DamagedPlace& place, std::size_t cell, double end, double mgt) {
  constexpr int kPoints = 400;
  LifeCurve out;
  const Removal removal = across.removal(cell, across.law);
  out.y = across.y[cell];
  for (int k = 0; k <= kPoints; ++k) {
    out.mgt.push_back(mgt * end * k / kPoints);
    out.removed.push_back(removal.after(end * k / kPoints));
  }
  const std::vector<double> when = failures_by_depth(place);
  for (std::size_t j = 0; j < when.size(); ++j)
    if (when[j] <= end) {
      out.damaged_mgt.push_back(mgt * when[j]);
      out.damaged.push_back(place.depth[j]);
    }
  if (!(removal.mean() > 0)) return out;
  for (const auto& [depth, failed] : failures_until(place, removal, end)) {
    out.failed_mgt.push_back(mgt * failed);
    out.failed.push_back(depth);
  }
  return out;
}

void add_body(const CaseSpec& spec, const std::vector<LifeLoad>& loads, const LifeAcross& across, double mgt,
              Lives& out) {
  const std::vector<std::size_t> layers = layers_on(spec, across.body);
  const double deepest = deepest_of(loads, across.body);
  FoundLives found;
  double top = 0;
  for (std::size_t k = 0; k <= layers.size(); ++k) {
    const bool layer = k < layers.size();
    LifeZone z{.spec = spec,
               .loads = loads,
               .across = across,
               .zone = layer ? static_cast<int>(k) + 1 : 0,
               .top = top,
               .bottom = layer ? top + spec.layers[layers[k]].thickness : kNever};
    z.aside = aside_shares(spec.collective.lateral_deviation, 0.5 * spec.collective.lateral_deviation);
    z.key = layer ? fmt::format("layer.{}", layers[k]) : fmt::format("material.{}", body_word(across.body));
    if (deepest > top) {
      z.depth = table_depths(top, z.bottom, deepest);
      add_damages(z, found);
    }
    if (layer) add_worn_through(z, found.rows);
    if (layer) add_strengths(z, found.rows);
    top = z.bottom;
  }
  if (across.body == BodyId::rail && found.place)
    out.curve = curve_of(across, *found.place, found.cell, 1.5 * found.units, mgt);
  if (across.body == BodyId::rail && !layers.empty()) out.curve.layer = spec.layers[layers.front()].thickness;
  for (LifeRow& row : found.rows) {
    for (double LifeRange::*v : kVariants) {
      if (std::isfinite(mgt)) row.mgt.*v = row.wheels.*v * mgt;
      row.wheels.*v *= out.wheels;
      if (across.body == BodyId::wheel) row.distance.*v = row.wheels.*v * turn_of(spec);
    }
    out.rows.push_back(row);
  }
}

std::string number_text(double v, double followed) {
  if (v == kNever) return followed == kNever ? "never" : fmt::format("> {:.3g}", followed);
  return v >= 1000 ? fmt::format("{:.0f}", v) : fmt::format("{:.3g}", v);
}

const LifeRow* shortest_of(const std::vector<LifeRow>& rows, bool with_wear) {
  const LifeRow* out = nullptr;
  for (const LifeRow& row : rows)
    if (row.mgt.known() && (with_wear || row.mechanism != kWornThrough) && (!out || row.mgt.best < out->mgt.best))
      out = &row;
  return out;
}

}  // namespace

double strength_factor(const CaseSpec& spec, std::size_t variant) {
  return 1 + 2 * spec.life.strength_scatter.value_or(0) * (static_cast<double>(variant) - 1);
}

Lives zone_lives(const CaseSpec& spec, const std::vector<LifeLoad>& loads, const RailDamage& rail,
                 const WheelDamage& wheel) {
  Lives out;
  for (const LifeLoad& load : loads) {
    out.wheels += load.passages;
    out.tonnes += load.passages * gross_tonnes(load.force);
  }
  if (loads.empty()) return out;
  add_body(spec, loads, across_rail(spec, rail, out.tonnes), 1e-6 * out.tonnes, out);
  add_body(spec, loads, across_wheel(spec, wheel, out.wheels), kNotApplicable, out);
  return out;
}

const LifeRow* shortest(const std::vector<LifeRow>& rows) { return shortest_of(rows, true); }
const LifeRow* first_damage(const std::vector<LifeRow>& rows) { return shortest_of(rows, false); }

std::string range_text(const LifeRange& r, double followed) {
  if (!r.known()) return "not known";
  if (r.low == r.best && r.best == r.high) return number_text(r.best, followed);
  return fmt::format("{} ({} to {})", number_text(r.best, followed), number_text(r.low, followed),
                     number_text(r.high, followed));
}

std::string life_text(const std::vector<LifeRow>& rows) {
  const LifeRow* row = shortest(rows);
  std::vector<std::string> unknown;
  for (const LifeRow& r : rows)
    if (!r.known() && r.body == body_word(BodyId::rail))
      unknown.push_back(fmt::format("{}: {} ({})", r.zone, r.mechanism, r.rests_on));
  std::string out;
  if (!row)
    out = "no failure mode is known";
  else if (row->mgt.best == kNever)
    out = row->followed == kNever
              ? "no failure in the known modes"
              : fmt::format("no failure in the known modes within {:.3g} MGT, the traffic that was followed",
                            row->followed);
  else
    out = fmt::format("lasts {} MGT: {}, {}, {}", range_text(row->mgt, row->followed),
                      row->zone == row->body ? row->body : fmt::format("{} of the {}", row->zone, row->body),
                      row->place, row->mechanism);
  return unknown.empty() ? out : fmt::format("{}; not known: {}", out, fmt::join(unknown, "; "));
}

}  // namespace railstrata
