#include "bem/several_patches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/patch_extent.hpp"

namespace railstrata {
namespace {

/// A part's centre of pressure and its ends across the rail, m.
struct PartExtent {
  double force = 0, centre = 0, low = HUGE_VAL, high = -HUGE_VAL;
};

std::vector<PartExtent> extents_of(const PatchOnWheel& p, const ConnectedRegions& part) {
  std::vector<PartExtent> out(static_cast<std::size_t>(part.count));
  const PatchGrid& g = p.patch.grid;
  for (std::size_t k = 0; k < part.of.size(); ++k) {
    if (part.of[k] == ConnectedRegions::kNone) continue;
    PartExtent& e = out[static_cast<std::size_t>(part.of[k])];
    const double y = g.y_of(k), force = p.solution.normal.pressure[k];
    e.force += force;
    e.centre += force * y;
    e.low = std::min(e.low, y - 0.5 * g.dy);
    e.high = std::max(e.high, y + 0.5 * g.dy);
  }
  for (PartExtent& e : out) e.centre /= e.force;
  return out;
}

double power_of(const TangentialSolution& t, std::size_t k) {
  return t.q_x[k] * t.cell_slip.x[k] + t.q_y[k] * t.cell_slip.y[k];
}

/// Empties the cells that are not its own, and counts what is left.
template <class Own>
void keep(const PatchGrid& g, RollingSolution& s, Own&& own) {
  TangentialSolution& t = s.tangential;
  const double dA = g.cell_area();
  double all = 0, kept = 0;
  s.normal.load = t.force_x = t.force_y = t.moment = t.slip_area = t.stick_area = 0;
  for (std::size_t k = 0; k < g.size(); ++k) {
    all += power_of(t, k);
    if (!own(k)) {
      s.normal.pressure[k] = t.q_x[k] = t.q_y[k] = t.cell_slip.x[k] = t.cell_slip.y[k] = 0;
      t.state[k] = ContactState::separated;
      continue;
    }
    kept += power_of(t, k);
    s.normal.load += s.normal.pressure[k] * dA;
    t.force_x += t.q_x[k] * dA;
    t.force_y += t.q_y[k] * dA;
    t.moment += (g.x_of(k) * t.q_y[k] - g.y_of(k) * t.q_x[k]) * dA;
    if (t.state[k] == ContactState::stick) t.stick_area += dA;
    if (t.state[k] == ContactState::slip) t.slip_area += dA;
  }
  t.dissipation = all != 0 ? t.dissipation * kept / all : 0.0;
}

/// Each contact's own, in order along the rail.
std::vector<RigidContact> own_places(const PatchOnWheel& whole, const Placement& placement, double descent) {
  std::vector<ContactPlace> each;
  for (const RigidContact& c : whole.contacts) each.push_back({c, 0});
  put_in_order(each);
  for (std::size_t k = 0; k < each.size(); ++k) each[k].patch = k;
  std::vector<PatchPlace> places = patch_places(placement, each);
  places.front().stretch.low = whole.stretch.low;
  places.back().stretch.high = whole.stretch.high;
  std::vector<RigidContact> out;
  for (const PatchPlace& place : places) out.push_back(plane_of(placement, place, descent));
  return out;
}

}  // namespace

std::vector<PatchPiece> pieces_of(const PatchOnWheel& whole, const Placement& placement, double descent) {
  const std::vector<RigidContact> places = own_places(whole, placement, descent);
  const ConnectedRegions part = connected_regions(whole.patch.grid.ny, whole.solution.normal.pressure, 0);
  const std::vector<PartExtent> extents = extents_of(whole, part);
  const auto t_of = [&](const RigidContact& c) { return along_plane(whole.contact, c.point); };
  std::vector<std::size_t> place_of;  // of each part
  for (const PartExtent& e : extents) {
    const auto off = [&](const RigidContact& c) { return std::abs(t_of(c) - e.centre); };
    const auto nearest =
        std::min_element(places.begin(), places.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });
    place_of.push_back(static_cast<std::size_t>(nearest - places.begin()));
  }
  std::vector<PatchPiece> out;
  for (std::size_t c = 0; c < places.size(); ++c) {
    if (std::find(place_of.begin(), place_of.end(), c) == place_of.end()) continue;
    PatchPiece piece{places[c], whole};
    keep(whole.patch.grid, piece.patch.solution, [&](std::size_t k) {
      const int of = part.of[k];
      return of != ConnectedRegions::kNone && place_of[static_cast<std::size_t>(of)] == c;
    });
    out.push_back(std::move(piece));
  }
  std::stable_sort(out.begin(), out.end(), [](const PatchPiece& a, const PatchPiece& b) {
    return a.patch.solution.normal.load > b.patch.solution.normal.load;
  });
  return out.size() > 1 ? std::move(out) : std::vector<PatchPiece>{{whole.contact, whole}};
}

}  // namespace railstrata
