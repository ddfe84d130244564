#include "judge/judgement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "judge/check_limits.hpp"

namespace railstrata {
namespace {

constexpr std::array<LastsRow, 6> kLasts{{{"yes", "Lasts", "good"},
                                          {"narrowly", "Lasts narrowly", "open"},
                                          {"in one track only", "Lasts in one track only", "open"},
                                          {"perhaps in one track", "May last in one track", "open"},
                                          {"withheld", "Whether it lasts cannot be said", "open"},
                                          {"no", "Does not last", "bad"}}};

/// The body that fares worst; of two with one verdict the one with the smaller factor for wandering traffic.
const BodyShakedown* deciding_body(const ShakedownSummary& s) {
  const auto worse = [](const BodyShakedown& a, const BodyShakedown& b) {
    const Verdict of_a = verdict_of(a.factors), of_b = verdict_of(b.factors);
    return of_a != of_b ? of_a > of_b : a.factors.wandering < b.factors.wandering;
  };
  const auto at = std::min_element(s.bodies.begin(), s.bodies.end(), worse);
  return at == s.bodies.end() ? nullptr : &*at;
}

std::string zone_of(const std::string& body, const std::string& zone) {
  return zone == body ? body : fmt::format("{}: {}", body, zone);
}

std::string place(const std::string& body, const std::string& zone, double depth) {
  return fmt::format("{}, {}", zone == body ? body : fmt::format("{} of the {}", zone, body), depth_in_words(depth));
}

std::string by_factors(const BodyShakedown& b) {
  const Verdict verdict = verdict_of(b.factors);
  const std::string where = place(b.body, b.zone, b.depth);
  if (verdict == Verdict::elastic)
    return fmt::format("{}: {} (load factor to first yield {:.3f})", where, verdict_text(verdict),
                       b.factors.first_yield);
  if (std::isnan(b.factors.wandering)) return fmt::format("{}: {}", where, verdict_text(verdict));
  const std::string words =
      fmt::format("{}: {} (load factor to shakedown {:.3f}", where, verdict_text(verdict), b.factors.wandering);
  if (verdict == Verdict::one_track || verdict == Verdict::perhaps_one_track)
    return words + fmt::format(", in one track up to {:.3f})",
                               verdict == Verdict::one_track ? b.factors.single_track : b.factors.upper);
  return words + ")";
}

/// What a layer fails by beside its load factors: where, and the words.
struct LayerFailure {
  std::string zone, where, words;
};
std::vector<LayerFailure> layer_failures(const Summary& s) {
  std::vector<LayerFailure> out;
  for (const BodyFatigue& b : s.fatigue) {
    for (const BrittleSummary& z : b.brittle)
      if (z.share_of_tensile >= 1 && std::isfinite(z.thickness))
        out.push_back({zone_of(b.body, z.zone), place(b.body, z.zone, z.depth),
                       fmt::format("{} (σ₁ is {:.2f} of its tensile strength)", verdict_text(Verdict::layer_cracks),
                                   z.share_of_tensile)});
    for (const InterfaceSummary& i : b.interfaces)
      if (i.delamination >= 1)
        out.push_back(
            {zone_of(b.body, i.above), fmt::format("{} on {}, {}", i.above, i.below, depth_in_words(i.depth)),
             fmt::format("{} (delamination index {:.2f})", verdict_text(Verdict::interface_shears), i.delamination)});
  }
  return out;
}

/// What takes a "yes" back: words of `doubts`, in their order.
std::vector<std::string> doubts_of(const Summary& s) {
  std::vector<std::string> out;
  for (const BodyShakedown& b : s.shakedown.bodies)
    if (std::none_of(s.fatigue.begin(), s.fatigue.end(), [&](const BodyFatigue& f) { return f.body == b.body; }))
      out.push_back(fmt::format("layers of the {} not judged", b.body));
  for (const Check& c : s.checks)
    if (!c.ok) out.push_back(c.name);
  for (const Warning& w : s.warnings)
    if (const CheckRow* row = find_check(w.name); row && row->takes_back) out.push_back(w.name);
  return out;
}

std::string name_of(const std::string& check) {
  const CheckRow* row = find_check(check);
  return row ? std::string(row->name) : check;
}

Lasts lasts_of(const BodyShakedown& body, bool layers_hold) {
  const Verdict verdict = verdict_of(body.factors);
  if (!layers_hold) return Lasts::no;
  if (verdict == Verdict::one_track) return Lasts::one_track;
  if (verdict == Verdict::perhaps_one_track) return Lasts::perhaps_one_track;
  if (!verdict_row(verdict).lasts) return Lasts::no;
  const double factor = std::isnan(body.factors.wandering) ? body.factors.first_yield : body.factors.wandering;
  return factor < kAmple ? Lasts::narrowly : Lasts::yes;
}

}  // namespace

const LastsRow& lasts_row(Lasts lasts) { return kLasts[static_cast<std::size_t>(lasts)]; }

std::string depth_in_words(double depth) {
  return depth == 0 ? "at the surface" : fmt::format("{:.2f} mm deep", 1e3 * depth);
}

std::optional<Judgement> judgement_of(const Summary& summary) {
  const BodyShakedown* body = deciding_body(summary.shakedown);
  if (!body) return {};
  const Verdict verdict = verdict_of(body->factors);
  const std::vector<LayerFailure> layers = layer_failures(summary);
  Judgement out;
  out.lasts = lasts_of(*body, layers.empty());
  out.doubts = doubts_of(summary);
  std::vector<std::string> reasons;
  if (layers.empty() || !verdict_row(verdict).lasts) {
    out.zone = zone_of(body->body, body->zone);
    out.decides = place(body->body, body->zone, body->depth);
    reasons.push_back(by_factors(*body));
  } else {
    out.zone = layers.front().zone;
    out.decides = layers.front().where;
  }
  for (const LayerFailure& f : layers) reasons.push_back(fmt::format("{}: {}", f.where, f.words));
  out.reason = fmt::format("{}", fmt::join(reasons, "; "));
  if (out.lasts == Lasts::no || out.doubts.empty()) return out;
  std::vector<std::string> names;
  for (const std::string& doubt : out.doubts) names.push_back(name_of(doubt));
  out.lasts = Lasts::withheld;
  out.reason = fmt::format("{}; the numbers alone: {}", fmt::join(names, ", "), out.reason);
  return out;
}

}  // namespace railstrata
