#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "collective/collective_errors.hpp"
#include "collective/collective_files.hpp"
#include "collective/life_files.hpp"
#include "collective/wear_words.hpp"
#include "judge/judgement.hpp"
#include "record/number_text.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

double mgt_of(const Lives& lives) { return lives.tonnes / 1e6; }

/// The depth of a thousand passages, and how far the sum over all of them can be trusted.
ReportAnswer wear_answer(const std::vector<CollectiveRow>& rows, const CollectiveDamage& both) {
  const RailDamage& d = both.rail;
  const WearLaw wanted = rows.front().spec.collective.wear_law;
  const std::vector<KnownWear> known = known_wear(d);
  const auto asked = std::find_if(known.begin(), known.end(), [&](const KnownWear& w) { return w.law == wanted; });
  if (asked == known.end()) return {};
  const std::vector<double> depth = smoothed_wear(d, wanted);
  const auto deepest = std::max_element(depth.begin(), depth.end());
  const double passages = passages_of(rows);
  const double micro = unit::kMicrometres.factor * *deepest, y = d.y[static_cast<std::size_t>(deepest - depth.begin())],
               mgt = mgt_of(both.lives);
  const auto bar = [&](double factor) {
    return bar_at(both.error, fmt::format("/totals/{}_deepest/depth_m", asked->key), factor);
  };
  const std::string per_traffic =
      mgt > 0 ? fmt::format(", {:.3g}{} mm per 100 MGT", 100 / mgt * unit::kMillimetres.factor * *deepest,
                            bar(100 / mgt * unit::kMillimetres.factor))
              : "";
  ReportAnswer out{"plain", "Wear",
                   fmt::format("{:.3g}{} µm per 1000 passages{} at y = {:.1f} mm of the rail ({})",
                               1000 / passages * micro, bar(1000 / passages * unit::kMicrometres.factor), per_traffic,
                               unit::kMillimetres.factor * y, asked->words)};
  if (const std::string steel = steel_words(rows, wanted); !steel.empty()) out.text += "; " + steel;
  if (const std::string map = map_words(rows, wanted); !map.empty()) {
    out.tone = "open";
    out.text += "; " + map;
  }
  if (*deepest <= kMostWearOfOneProfile) return out;
  out.tone = "open";
  out.text += fmt::format(
      "; {:.0f} µm after all {:.0f} passages assumes an unworn profile; use `railstrata collective --steps`, which "
      "removes the wear step by step, for a forecast",
      micro, passages);
  return out;
}

/// Where the damage function grows most, and when it comes to a visible crack.
ReportAnswer rcf_answer(const CollectiveDamage& both) {
  const std::vector<double>& damage = both.rail.rcf_damage;
  const auto most = std::max_element(damage.begin(), damage.end());
  if (most == damage.end() || !(*most > 0)) return {};
  const double y = both.rail.y[static_cast<std::size_t>(most - damage.begin())], mgt = mgt_of(both.lives);
  const std::string place = "/totals/rcf_damage_largest/damage";
  return {*most >= 1 ? "bad" : "open", "Rolling contact fatigue",
          fmt::format("damage {:.3g}{} at y = {:.1f} mm of the rail, where 1 is a visible crack{}", *most,
                      bar_at(both.error, place), unit::kMillimetres.factor * y,
                      mgt > 0 ? fmt::format(": after {:.3g}{} MGT", mgt / *most,
                                            bar_at(both.error, place, mgt / (*most * *most)))
                              : "")};
}

/// Where its bar is known: the table of loads has the pressures themselves.
ReportAnswer pressure_answer(const std::vector<CollectiveRow>& rows, const CollectiveDamage& both) {
  const Unit& shown = unit::kMPa;
  const CollectiveRow* row = most_pressed_row(rows);
  const std::string bar = bar_at(both.error, "/totals/largest_pressure/p_max_Pa", shown.factor);
  if (!row || bar.empty()) return {};
  return {"plain", "Largest pressure",
          fmt::format("{:.0f}{} {}, load \"{}\"", shown.factor * row->summary.contact.patch.p_max, bar, shown.shown,
                      row->name)};
}

}  // namespace

/// What the vehicle code has for the same wheels, mean over those that give it.
ReportAnswer comparison_answer(const std::vector<CollectiveRow>& rows) {
  constexpr double kFar = 0.2;  // of the vehicle code's
  std::string text;
  bool far = false;
  bool turned = false;
  const auto compare = [&](const char* name, const Unit& unit, std::optional<double> LoadSpec::*given, auto&& here) {
    double wheels = 0, theirs = 0, ours = 0;
    for (const CollectiveRow& row : rows) {
      if (!row.sound() || !(row.given.*given)) continue;
      wheels += row.passages;
      theirs += row.passages * *(row.given.*given);
      ours += row.passages * here(row.summary);
    }
    if (!(wheels > 0)) return;
    far = far || std::abs(ours - theirs) > kFar * std::abs(theirs);
    turned = turned || ours * theirs < 0;
    text += fmt::format("{}{} {} here, {} there", text.empty() ? "" : "; ", name, with_unit(unit, ours / wheels, 3),
                        with_unit(unit, theirs / wheels, 3));
  };
  compare("T-gamma", unit::kNewtons, &LoadSpec::t_gamma, [](const Summary& s) { return s.damage.t_gamma; });
  compare("friction energy", unit::kNewtons, &LoadSpec::friction_energy,
          [](const Summary& s) { return s.damage.friction_energy; });
  compare("Y", unit::kKilonewtons, &LoadSpec::guiding_force, [](const Summary& s) { return -s.contact.F_y; });
  if (text.empty()) return {};
  if (turned) text += "; Y has the opposite sign: are y, psi and roll positive to the field side?";
  const bool matched = rows.front().spec.collective.match_guiding_force;
  const long unmatched =
      std::count_if(rows.begin(), rows.end(), [](const CollectiveRow& r) { return std::isnan(r.moved); });
  double farthest = 0;
  for (const CollectiveRow& row : rows) farthest = std::fmax(farthest, std::abs(row.moved));
  if (farthest > 0)
    text += fmt::format("; shifts moved by up to {} to reach this Y", with_unit(unit::kMillimetres, farthest, 2));
  if (unmatched > 0)
    text += fmt::format("; {} of {} loads do not reach it within {}", unmatched, rows.size(),
                        with_unit(unit::kMillimetres, kFarthestMatch, 1));
  const auto two = std::count_if(rows.begin(), rows.end(), [](const CollectiveRow& r) { return r.patches.size() > 1; });
  if (far && two > 0)
    text += fmt::format(
        "; {} of {} loads touch at two places, where a few µm of shift move the load from tread to flange{}", two,
        rows.size(), matched ? "" : " (collective.match_guiding_force adjusts the shift)");
  return {far ? "open" : "plain", "Comparison with the vehicle code", "mean of the wheels: " + text};
}

std::vector<ReportAnswer> collective_answers(const std::vector<CollectiveRow>& rows, const CollectiveDamage& both) {
  std::vector<ReportAnswer> out;
  if (const CollectiveRow* worst = worst_row(rows))
    if (const std::optional<Judgement> answer = judgement_of(worst->summary)) {
      const LastsRow& words = lasts_row(answer->lasts);
      const std::string bar = bar_at(both.error, "/worst_shakedown/wandering");
      out.push_back(
          {std::string(words.tone), std::string(words.title),
           fmt::format("load \"{}\", {}{}", worst->name, answer->reason, bar.empty() ? "" : "; load factor" + bar)});
    }
  ReportAnswer life = life_answer(both.lives);
  if (const LifeRow* row = shortest(both.lives.rows)) {
    const std::string bar = bar_at(both.error, fmt::format("/lives/{}/life_MGT", row - both.lives.rows.data()));
    if (!bar.empty()) life.text += fmt::format("; cells of the contacts:{} MGT", bar);
  }
  if (const auto failed = std::count_if(rows.begin(), rows.end(), [](const CollectiveRow& r) { return !r.sound(); });
      failed > 0 && !life.text.empty())
    life.text += fmt::format("; without {} of {} loads, which failed", failed, rows.size());
  for (const ReportAnswer& answer :
       {life, rcf_answer(both), wear_answer(rows, both), pressure_answer(rows, both), comparison_answer(rows)})
    if (!answer.text.empty()) out.push_back(answer);
  return out;
}

}  // namespace railstrata
