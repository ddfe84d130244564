#include "passes/pass_way.hpp"

#include <algorithm>

#include "material/elastic.hpp"

namespace railstrata {
namespace {

Sym3 as_tensor(const std::array<double, 6>& s) { return {s[0], s[1], s[2], s[3], s[4], s[5]}; }

std::size_t largest(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

/// Where the elastic stress of a row's column comes nearest to yield.
std::size_t nearest_to_yield(const RailPasses& rail) {
  const SteadyGrid& g = rail.grid;
  const Field& stress = rail.contact_stress.front();
  std::vector<double> share(g.points());
  for (int r = 0; r < g.rows(); ++r)
    for (int j = 0; j < g.ny; ++j)
      for (int i = 0; i < g.active_stations(); ++i) {
        std::array<double, 6> s{};
        for (int c = 0; c < 6; ++c) s[c] = stress[g.index(c, r, i, j)];
        double& most = share[g.point(r, j)];
        most = std::max(most, von_mises(as_tensor(s)) / rail.rows[static_cast<std::size_t>(r)].law.yield);
      }
  return largest(share);
}

}  // namespace

std::vector<WayPoint> way_points(const RailPasses& rail, const PassResult& last, const PassState& state) {
  const SteadyGrid& g = rail.grid;
  std::vector<double> p(g.points());
  for (std::size_t n = 0; n < p.size(); ++n) p[n] = state.history[n * kStreamlineHistory + 6];
  const std::size_t net = largest(last.net), flowed = largest(p);
  const std::size_t governing = last.net[net] > 0 ? net : p[flowed] > 0 ? flowed : nearest_to_yield(rail);
  const int column = static_cast<int>(governing) % g.ny;
  std::vector<WayPoint> out{{"governing", governing}};
  const auto add = [&](const std::string& name, int row) {
    const std::size_t n = g.point(row, column);
    const bool there = std::any_of(out.begin(), out.end(), [&](const WayPoint& w) { return w.point == n; });
    if (!there) out.push_back({name, n});
  };
  add("surface", 0);
  for (int r = 1; r < g.rows(); ++r)
    if (rail.zone[static_cast<std::size_t>(r)] != rail.zone[static_cast<std::size_t>(r) - 1]) {
      add("above the border", r - 1);
      add("below the border", r);
    }
  return out;
}

PassWay pass_way(const RailPasses& rail, const SteadyBody& body, const Field& contact, const PassResult& last,
                 const PassState& state) {
  const SteadyGrid& g = rail.grid;
  PassWay out;
  out.points = way_points(rail, last, state);
  out.column = static_cast<int>(out.points.front().point) % g.ny;
  std::vector<std::size_t> points;
  for (const WayPoint& w : out.points) points.push_back(w.point);
  out.loops = body.streamlines(contact, last, state, points);
  points.clear();
  for (int r = 0; r < g.rows(); ++r) points.push_back(g.point(r, out.column));
  const auto column = body.streamlines(contact, last, state, points);
  for (int r = 0; r < g.rows(); ++r)
    for (int i = 0; i < g.active_stations(); ++i) {
      std::array<double, 6> e{};
      for (int c = 0; c < 6; ++c) e[c] = contact[g.index(c, r, i, out.column)];
      std::array<double, 6> s = body.stress_of(r, e);
      const auto& process = rail.initial_stress[static_cast<std::size_t>(r)];
      s[0] += process[0];
      s[1] += process[1];
      out.elastic.push_back(von_mises(as_tensor(s)));
      out.yielding.push_back(
          von_mises(as_tensor(column[static_cast<std::size_t>(r)][static_cast<std::size_t>(i)].stress)));
    }
  return out;
}

}  // namespace railstrata
