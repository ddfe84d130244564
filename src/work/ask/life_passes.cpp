#include "ask/life_passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "bem/contact_places.hpp"
#include "core/faults.hpp"
#include "material/strain_claim.hpp"
#include "passes/pass_runner.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

/// s of net ~ n^-s between two passes of a point; 0 where it does not flow in both.
double trend_between(double net, double later_net, double ratio) {
  return net > 0 && later_net > 0 ? -std::log(later_net / net) / std::log(ratio) : 0;
}

PassedSection passed_section(int wanted, PassRunner& passes) {
  PassedSection out;
  PassState state = passes.body().virgin();
  out.passes = wanted;
  const int quarter = wanted / 4, half = wanted / 2;
  std::array<std::vector<double>, 2> earlier;  // net strain of those passes
  PassResult last;
  for (int n = 1; n <= wanted; ++n) {
    last = passes.next({}, state).result;
    if (n == 1) earlier.fill(std::vector<double>(last.net.size(), 0.0));
    if (*std::max_element(last.accumulated.begin(), last.accumulated.end()) == 0) break;  // nor do the passes after it
    if (n == quarter) earlier[0] = last.net;
    if (n == half) earlier[1] = last.net;
  }
  const RailPasses& rail = passes.rail();
  const BemResult& patch = passes.contact();
  const double place = along_plane(patch.contact, patch.place.point);
  for (int j = 0; j < rail.grid.ny; ++j) out.y.push_back(rail.grid.y(j) - place);
  for (int r = 0; r < rail.grid.rows(); ++r) out.depth.push_back(rail.grid.depth(r));
  out.zone = rail.zone;
  out.accumulated = last.accumulated;
  out.net = last.net;
  for (const std::array<double, 6>& e : last.plastic_strain) out.reached.push_back(equivalent_strain(e.data()));
  const double first = static_cast<double>(half) / quarter, second = static_cast<double>(wanted) / half;
  for (std::size_t p = 0; p < last.net.size(); ++p) {
    out.trend[0].push_back(trend_between(earlier[0][p], earlier[1][p], first));
    out.trend[1].push_back(trend_between(earlier[0][p], last.net[p], first * second));
    out.trend[2].push_back(trend_between(earlier[1][p], last.net[p], second));
  }
  return out;
}

}  // namespace

PassedSections passed_sections(const CaseSpec& spec, const Placement& placement, const BemResult& result,
                               const BemOptions& bem, const Control* control) {
  std::optional<FollowingContact> following;
  if (spec.passes.pressure == PassPressure::following) {
    if (!result.further.empty())
      throw CaseError("passes.pressure: two contacts, and pressure follows the surface of one alone",
                      "passes.pressure = \"elastic\"");
    following.emplace(std::vector<CaseSpec>{spec}, std::vector<Placement>{placement}, bem);
  }
  PassedSections out;
  for (std::size_t v = 0; v < out.size(); ++v) {
    const double strength = strength_factor(spec, v);
    if (v != 1 && strength == 1) continue;
    for (const BemPatch* one : patches_of(result)) {
      PassRunner passes(spec, {alone(result, *one)}, following ? &*following : nullptr, control, strength);
      out[v].push_back(passed_section(spec.life.passes, passes));
      out[v].back().patch = out[v].size() - 1;
    }
  }
  return out;
}

}  // namespace railstrata
