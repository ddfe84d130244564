#include "runs/life_passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bem/contact_places.hpp"
#include "case/case_spec.hpp"
#include "material/strain_claim.hpp"
#include "passes/rail_passes.hpp"

namespace railstrata {
namespace {

/// s of net ~ n^-s between two passes of a point; 0 where it does not flow in both.
double trend_between(double net, double later_net, double ratio) {
  return net > 0 && later_net > 0 ? -std::log(later_net / net) / std::log(ratio) : 0;
}

/// The patch as a result of its own.
BemResult alone(const BemResult& result, const BemPatch& patch) {
  BemResult out;
  static_cast<BemPatch&>(out) = patch;
  out.wheel = result.wheel;
  out.rail = result.rail;
  return out;
}

PassedSection passed_section(const CaseSpec& spec, const BemResult& result, const Control* control) {
  const RailPasses rail = rail_passes(spec, {result});
  const SteadyBody body = body_of(rail);
  const Field strain = contact_strain(rail, body, rail.contact_stress.front());
  PassState state = body.virgin();
  PassLimits limits;
  limits.control = control;
  PassedSection out;
  out.passes = spec.life.passes;
  const int quarter = out.passes / 4, half = out.passes / 2;
  std::array<std::vector<double>, 2> earlier;  // net strain of those passes
  for (std::vector<double>& net : earlier) net.assign(body.grid().points(), 0);
  PassResult last;
  for (int n = 1; n <= out.passes; ++n) {
    last = body.run_pass(strain, state, limits);
    if (*std::max_element(last.accumulated.begin(), last.accumulated.end()) == 0) break;  // nor do the passes after it
    if (n == quarter) earlier[0] = last.net;
    if (n == half) earlier[1] = last.net;
  }
  const double place = along_plane(result.contact, result.place.point);
  for (int j = 0; j < rail.grid.ny; ++j) out.y.push_back(rail.grid.y(j) - place);
  for (int r = 0; r < rail.grid.rows(); ++r) out.depth.push_back(rail.grid.depth(r));
  out.zone = rail.zone;
  out.accumulated = last.accumulated;
  out.net = last.net;
  for (const std::array<double, 6>& e : last.plastic_strain) out.reached.push_back(equivalent_strain(e.data()));
  const double first = static_cast<double>(half) / quarter, second = static_cast<double>(out.passes) / half;
  for (std::size_t p = 0; p < last.net.size(); ++p) {
    out.trend[0].push_back(trend_between(earlier[0][p], earlier[1][p], first));
    out.trend[1].push_back(trend_between(earlier[0][p], last.net[p], first * second));
    out.trend[2].push_back(trend_between(earlier[1][p], last.net[p], second));
  }
  return out;
}

}  // namespace

std::vector<PassedSection> passed_sections(const CaseSpec& spec, const BemResult& result, const Control* control) {
  std::vector<PassedSection> out;
  for (const BemPatch* patch : patches_of(result)) {
    out.push_back(passed_section(spec, alone(result, *patch), control));
    out.back().patch = out.size() - 1;
  }
  return out;
}

}  // namespace railstrata
