#include "ask/profile_errors.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/faults.hpp"
#include "geometry/profile_scatter.hpp"
#include "geometry/profile_signs.hpp"
#include "judge/bem_summary.hpp"

namespace railstrata {
namespace {

struct Barred {
  double ContactErrors::*bar;
  double (*value)(const ContactSummary&);
};
using S = ContactSummary;
using E = ContactErrors;
constexpr std::array kBarred{
    Barred{&E::p_max, [](const S& c) { return c.patch.p_max; }},
    Barred{&E::q_max, [](const S& c) { return c.patch.q_max; }},
    Barred{&E::slip_area_fraction, [](const S& c) { return c.patch.slip_area_fraction; }},
    Barred{&E::F_x, [](const S& c) { return c.F_x; }},
    Barred{&E::F_y, [](const S& c) { return c.F_y; }},
    Barred{&E::creepage_x, [](const S& c) { return c.creepage_x; }},
    Barred{&E::creepage_y, [](const S& c) { return c.creepage_y; }},
};

/// The changes of one number over the fits.
struct Spread {
  double squares = 0, by_smoothing = 0;
  int moved = 0;
  void add(double change, bool of_moved) {
    if (of_moved) squares += change * change;
    if (of_moved) ++moved;
    if (!of_moved) by_smoothing = std::max(by_smoothing, std::abs(change));
  }
  double bar() const {
    constexpr double kStudent = 2.4;  // of six, 95 %
    return (moved > 0 ? kStudent * std::sqrt(squares / moved) : 0) + by_smoothing;
  }
};
using Spreads = std::array<Spread, kBarred.size()>;

/// What the fits of wheel and rail change of the contact.
Spreads spreads_of(const CaseSpec& spec, const Placement& placement, const BemOptions& bem, const ContactSummary& c) {
  const bool coarse = far_apart(placement.wheel) || far_apart(placement.rail);
  Spreads out;
  for (int k = 0; k < kOtherFits; ++k) {
    if (coarse && k >= 2 && k < kMovedFits) continue;
    try {
      Placement other = placement;
      other.wheel = other_fit(placement.wheel, k);
      other.rail = other_fit(placement.rail, k);
      other.contact = place_wheel(other.wheel, other.rail, other.track);
      const ContactSummary found = bem_contact_summary(spec, solve_bem(spec, other, bem)).contact;
      for (std::size_t i = 0; i < kBarred.size(); ++i)
        out[i].add(kBarred[i].value(found) - kBarred[i].value(c), k < kMovedFits && !coarse);
    } catch (const CaseError&) {  // a fit that cannot be placed says nothing
    } catch (const NumericalError&) {
    }
  }
  return out;
}

/// The edges of a profile that lie in the patch around the arc length s, as words; withholds the bars if there are any.
void withhold_at_edges(const Profile& profile, double s, ContactSummary& c, std::vector<std::string>& notes) {
  for (const ProfileEdge& edge : edges_of(profile)) {
    if (!(std::abs(edge.s - s) < c.patch.width)) continue;
    c.error.p_max = c.error.q_max = kNotApplicable;
    notes.push_back(
        fmt::format("{} has an edge of {:.0f} mrad at y = {:.1f} mm, in the patch: the pressure there grows with finer "
                    "cells and has no error bar; give the curve that the metal takes under the first wheels",
                    profile.name(), 1e3 * edge.turn, 1e3 * profile.at(edge.s).position.y));
  }
}

}  // namespace

void add_profile_errors(const CaseSpec& spec, const Placement& placement, const AskOptions& how,
                        std::vector<std::string>& notes, ContactSummary& c) {
  constexpr double kUnresolved = 2;  // fits of points far apart do not converge by a known order
  const std::size_t before = notes.size();
  withhold_at_edges(placement.rail, placement.contact.rail_s, c, notes);
  withhold_at_edges(placement.wheel, placement.contact.wheel_s, c, notes);
  if (notes.size() > before) return;
  if (!leaves_open(placement.wheel) && !leaves_open(placement.rail)) return;
  const bool coarse = far_apart(placement.wheel) || far_apart(placement.rail);
  const Spreads spreads = spreads_of(spec, placement, how.bem, c);
  for (std::size_t i = 0; i < kBarred.size(); ++i) {
    double& bar = c.error.*kBarred[i].bar;
    const bool always = kBarred[i].bar == &E::p_max;  // where the cells have no law too: several patches
    if (std::isnan(bar) && !always) continue;
    bar = (std::isnan(bar) ? 0 : bar) + (coarse ? kUnresolved : 1) * spreads[i].bar();
  }
}

}  // namespace railstrata
