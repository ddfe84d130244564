#include "app/summary_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/printable.hpp"
#include "io/summary_json.hpp"
#include "judge/check_limits.hpp"
#include "judge/judgement.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

/// A text in a field of so many columns; letters beyond ASCII count once.
std::string padded(std::string_view text, std::size_t width) {
  const auto letters = static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
  return std::string(text) + std::string(width - std::min(letters, width), ' ');
}

/// " ± 6.1" after a value in its unit; empty without an error bar.
std::string bar_text(double value) { return std::isfinite(value) ? " ± " + significant(value, 2) : std::string(); }

std::string numbers_text(const Summary& s) {
  const bool bars = std::isfinite(s.contact.error.p_max);
  std::string out;
  for (const ResultNumber& n : result_numbers()) {
    if (!n.shown || n.group == kShakedownGroup || n.group == kLayersGroup) continue;  // by zone, below
    const double v = shown_value(n, s);
    if (!std::isfinite(v)) continue;
    const ResultNumber* error = find_error_bar(n);
    const std::string bar = error ? bar_text(n.unit.factor * error->value(s)) : "";
    out += fmt::format("  {}{:>10} {}{}\n", padded(n.label, 18), significant(n.unit.factor * v, n.digits),
                       padded(std::string(n.unit.shown) + bar, bars ? 16 : 7), n.name);
  }
  return out + fmt::format("  {}{:>10}\n", padded("F_x/F_z", 18), fixed(s.contact.F_x / s.contact.F_z, 4));
}

std::string patches_text(const Summary& s) {
  std::string out;
  for (std::size_t k = 0; k < s.patches.size(); ++k) {
    const PatchSummary& p = s.patches[k];
    const ContactSummary& c = p.contact;
    out += fmt::format(
        "  patch {} at y = {} mm of the rail, {} mm of the wheel, at {}°: p_max {:.0f} MPa, F_x {}, normal force {}, "
        "lateral force {} kN, {:.1f} mm2, spin {} rad/m\n",
        k + 1, fixed(1e3 * p.rail_y, 1), fixed(1e3 * p.wheel_y, 1), fixed(unit::kDegrees.factor * c.contact_angle, 1),
        1e-6 * c.patch.p_max, fixed(1e-3 * c.F_x, 2), fixed(1e-3 * c.normal_force, 2), fixed(1e-3 * c.lateral_force, 2),
        1e6 * c.patch.area, fixed(c.spin_per_m, 3));
  }
  if (!out.empty())
    out +=
        "  above: the numbers of patch 1, which has the largest pressure, but F_x, F_y and F_z of all patches; below: "
        "the stresses under patch 1\n";
  return out;
}

std::string signed_mm(double metres) {
  const std::string text = fixed(1e3 * metres, 2);
  return text.starts_with('-') ? text : "+" + text;
}

std::string maximum_text(const StressMaximum& m) {
  return fmt::format("{:7.1f} MPa{} at x {}, y {}, depth {} mm", 1e-6 * m.value, bar_text(1e-6 * m.error),
                     signed_mm(m.x), signed_mm(m.y), fixed(1e3 * m.depth, 2));
}

/// Zones that the case has; of the wheel only if one of its layers makes more of them than the surface and below. The
/// layers' σ₁ stands below, with the stress of the process and the surface, where a strength asks for it.
std::string stresses_text(const Summary& s) {
  std::string out = "  stresses of the contact alone\n";
  const bool elsewhere = std::isfinite(layer_worst(s).sigma_1);
  for (const StressBody& body : stress_bodies()) {
    const StressSummary& stress = s.*body.member;
    if (body.key == "wheel" && !stress.layer) continue;
    for (const StressZone& zone : stress_zones()) {
      const std::optional<StressPair>& pair = stress.*zone.member;
      if (!pair) continue;
      out += "  " + padded(fmt::format("{} {}", body.key, zone.name), 24);
      for (const StressMeasure& m : stress_measures())
        if (!(elsewhere && zone.key == "layer" && m.key == "sigma1_max"))
          out += fmt::format("{}{} {}", m.member == stress_measures().front().member ? "" : "; ", m.name,
                             maximum_text((*pair).*m.member));
      out += "\n";
    }
  }
  return out;
}

std::string factor_text(double value) { return std::isfinite(value) ? fmt::format("{:.3f}", value) : "-"; }

std::string mpa(double value) { return fmt::format("{:.0f} MPa", 1e-6 * value); }

std::string value_text(const char* name, const std::optional<FatigueValue>& v, double factor, const char* unit) {
  if (!v) return {};
  const std::string along = std::isfinite(v->x) ? fmt::format(", x {:.1f} mm", 1e3 * v->x) : "";
  return fmt::format(", {} {:.3g}{} at {:.2f} mm{}", name, factor * v->value, unit, 1e3 * v->depth, along);
}

std::string interface_text(const InterfaceSummary& i) {
  std::string out = fmt::format("    interface {} on {} at {:.2f} mm: tension {}, shear {}, its range {} a passage",
                                printable(i.above), printable(i.below), 1e3 * i.depth, mpa(i.tension), mpa(i.shear),
                                mpa(i.shear_range));
  if (std::isfinite(i.delamination)) out += fmt::format(", delamination index {:.2f}", i.delamination);
  if (i.delamination >= 1) out += fmt::format(": {}", verdict_text(Verdict::interface_shears));
  return out + "\n";
}

std::string brittle_text(const BrittleSummary& z) {
  if (!std::isfinite(z.share_of_tensile) && !std::isfinite(z.critical_flaw) && !std::isfinite(z.thickness)) return {};
  std::string out = fmt::format("    {}: σ₁ {} {}, residual stress included", printable(z.zone), mpa(z.sigma1),
                                depth_in_words(z.depth));
  if (std::isfinite(z.share_of_tensile)) out += fmt::format(", {:.2f} of its tensile strength", z.share_of_tensile);
  if (z.critical_flaw > z.thickness)
    out += fmt::format(", opens no flaw within its thickness of {:.3g} mm", 1e3 * z.thickness);
  else if (std::isfinite(z.critical_flaw))
    out += fmt::format(", opens flaws deeper than {:.3f} mm", 1e3 * z.critical_flaw);
  if (z.share_of_tensile >= 1 && std::isfinite(z.thickness))
    out += fmt::format(": {}", verdict_text(Verdict::layer_cracks));
  return out + "\n";
}

std::string fatigue_text(const Summary& s) {
  std::string out;
  for (const BodyFatigue& b : s.fatigue) {
    const std::string values = value_text("Dang Van", b.dang_van, 1, " of its limit") +
                               value_text("Smith-Watson-Topper", b.smith_watson_topper, 1e-6, " MPa") +
                               value_text("Fatemi-Socie", b.fatemi_socie, 1, "") +
                               value_text("Jiang-Sehitoglu", b.jiang_sehitoglu, 1e-6, " MPa");
    if (!values.empty()) out += fmt::format("  {}{}\n", padded(b.body + " fatigue", 24), values.substr(2));
    for (const BrittleSummary& z : b.brittle) out += brittle_text(z);
    for (const InterfaceSummary& i : b.interfaces) out += interface_text(i);
  }
  return out;
}

/// Shakedown factors of each body's zones, from the surface down, with the level that decides.
std::string shakedown_text(const Summary& s) {
  std::string out;
  for (const BodyShakedown& b : s.shakedown.bodies) {
    for (const ZoneShakedown& z : b.zones)
      out += fmt::format(
          "  {}{}; load factors: first yield {}, shakedown {} (one track {}, at most {}), kinematic {}; decided {}\n",
          padded(z.zone == b.body ? b.body : b.body + ", " + z.zone, 24), verdict_text(verdict_of(z.factors)),
          factor_text(z.factors.first_yield), factor_text(z.factors.wandering), factor_text(z.factors.single_track),
          factor_text(z.factors.upper), factor_text(z.factors.kinematic), depth_in_words(z.depth));
    for (const std::string& note : b.notes) out += fmt::format("  {}\n", printable(note));
  }
  return out;
}

/// The answer in a line.
std::string lasts_text(const Summary& s) {
  const std::optional<Judgement> answer = judgement_of(s);
  if (!answer) return {};
  return fmt::format("  {}{}: {}\n", padded("does it last?", 24), lasts_row(answer->lasts).word,
                     printable(answer->reason));
}

/// Of the rail's steel, whose USFD depth stands above.
std::string steel_text(const Summary& s) {
  const SteelWear& steel = s.damage.rail_steel;
  return steel.text.empty() ? "" : fmt::format("  {}{}\n", padded("wear of the rail", 24), printable(steel.text));
}

std::string life_text(const Summary& s) {
  return s.life.text.empty() ? "" : fmt::format("  {}{}\n", padded("life, of such wheels", 24), printable(s.life.text));
}

std::string steps_text(const RunSummary& r) {
  if (!(r.added_mass > 0)) return "";
  return fmt::format(
      "  mass scaling     {:.3f} kg against stretching of thin rows: stable step {:.1f} ns instead of {:.1f} ns\n",
      r.added_mass, 1e9 * r.stable_step, 1e9 * r.unscaled_step);
}

std::string checks_text(const Summary& s) {
  std::string out = "  checks\n";
  for (const Check& k : s.checks) {
    const auto [name, unit] = check_words(k.name);
    out += fmt::format("    {:<6} {}{:>10}  (limit {})\n", k.ok ? "ok" : "FAILED", padded(name, 34),
                       with_unit(unit, shown_beside_limit(k.value, k.limit), 3), limit_text(unit, k.limit));
  }
  for (const Warning& w : s.warnings) {
    const CheckRow* row = find_check(w.name);
    const auto [name, unit] = check_words(w.name);
    out += fmt::format("    warn   {}{:>10}  (above {}): {}\n", padded(name, 34), with_unit(unit, w.value, 3),
                       limit_text(unit, w.limit),
                       row && !row->own_text ? fmt::format("{}: {}", row->what, row->advice) : w.text);
  }
  return out;
}

}  // namespace

std::string summary_text(const Summary& s) {
  const std::string place = std::isfinite(s.position) ? fmt::format(", wheel at {:.2f} mm", 1e3 * s.position) : "";
  return fmt::format("\n{}{}\n", printable(s.title), s.state.empty() ? place : ", " + s.state) + numbers_text(s) +
         patches_text(s) + stresses_text(s) + shakedown_text(s) + fatigue_text(s) + steel_text(s) + lasts_text(s) +
         life_text(s) + steps_text(s.run) + checks_text(s);
}

void print_summary(const Summary& s, bool json) {
  std::fputs((json ? summary_json(s).dump(2) + "\n" : summary_text(s)).c_str(), stdout);
}

bool all_checks_hold(const Summary& s) {
  return std::all_of(s.checks.begin(), s.checks.end(), [](const Check& k) { return k.ok; });
}

}  // namespace railstrata
