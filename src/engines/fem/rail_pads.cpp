#include "fem/rail_pads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr double kPoint = 1e-6;  // m, in place of a length of 0

/// Integrals of the stations' shape functions over [begin, end].
std::vector<double> shape_integrals(const std::vector<double>& at, double begin, double end) {
  std::vector<double> out(at.size(), 0.0);
  for (std::size_t j = 0; j + 1 < at.size(); ++j) {
    const double low = std::max(begin, at[j]), high = std::min(end, at[j + 1]);
    if (low >= high) continue;
    const double right = (0.5 * (low + high) - at[j]) / (at[j + 1] - at[j]);
    out[j] += (high - low) * (1 - right);
    out[j + 1] += (high - low) * right;
  }
  return out;
}

/// Half the distances to both neighbours in an increasing list.
double tributary(const std::vector<double>& at, std::size_t j) {
  return 0.5 * (at[std::min(j + 1, at.size() - 1)] - at[j > 0 ? j - 1 : 0]);
}

void normalize(std::vector<NodeShare>& shares) {
  double sum = 0;
  for (const NodeShare& s : shares) sum += s.share;
  for (NodeShare& s : shares) s.share /= sum;
}

}  // namespace

std::vector<NodeShare> spread_along(const Body& body, std::vector<SectionNode> nodes, double x, double length) {
  const auto across = [&](const SectionNode& n) { return body.mesh.blocks[n.block].section.nodes[n.node].y; };
  std::sort(nodes.begin(), nodes.end(), [&](const auto& a, const auto& b) { return across(a) < across(b); });
  std::vector<double> y;
  for (const SectionNode& n : nodes) y.push_back(across(n));
  const double half = 0.5 * std::max(length, kPoint);
  std::vector<NodeShare> out;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const SectionNode& n = nodes[k];
    const BlockLayout& lay = body.layout.blocks[n.block];
    const std::vector<double>& at = body.mesh.blocks[n.block].stations.at;
    if (x - half < at.front() || x + half > at.back())
      throw CaseError(fmt::format("x = {:.0f} mm lies beyond the rail's ends", 1e3 * x), "give more track.bays",
                      "track.bays");
    const std::vector<double> part = shape_integrals(at, x - half, x + half);
    for (std::size_t j = 0; j < part.size(); ++j)
      if (part[j] > 0)
        out.push_back({lay.line(n.node, 0) + static_cast<std::ptrdiff_t>(j), lay.stride, part[j] * tributary(y, k)});
  }
  normalize(out);
  return out;
}

std::vector<NodeShare> section_mean(const Body& rail, double x, double length) {
  std::vector<NodeShare> out;
  for (const NodeLine& l : rail.lines) {
    if (l.component != 0) continue;
    const std::vector<double>& at = rail.mesh.blocks[l.block].stations.at;
    const std::vector<double> part = shape_integrals(at, x - 0.5 * length, x + 0.5 * length);
    for (std::size_t j = 0; j < part.size(); ++j)
      if (part[j] > 0)
        out.push_back({l.first + static_cast<std::ptrdiff_t>(j), rail.layout.blocks[l.block].stride,
                       part[j] * rail.mass[l.first + j] / tributary(at, j)});
  }
  normalize(out);
  return out;
}

double mean_height(const std::vector<NodeShare>& of, const Field& values) {
  double sum = 0;
  for (const NodeShare& s : of) sum += s.share * values[s.index + 2 * s.stride];
  return sum;
}

RailPads rail_pads(const Body& rail, const SleeperTrack& track) {
  const std::vector<SectionNode>& base = rail.mesh.on_pads;
  if (base.empty()) return {};
  const std::vector<double>& at = rail.mesh.blocks[base.front().block].stations.at;
  RailPads out{track, sleepers_between(track, at.front() + kPoint, at.back() - kPoint), {}};
  if (out.none()) throw CaseError("no sleeper lies below the rail", "give more track.bays", "track.bays");
  for (const double x : out.x) out.nodes.push_back(spread_along(rail, base, x, track.pad_length));
  return out;
}

void require_stable(const RailPads& pads, const Body& rail, double dt, double safety) {
  const SleeperTrack& t = pads.track;
  double worst = 0;
  for (const auto& pad : pads.nodes)
    for (const NodeShare& n : pad)
      worst = std::max(worst, n.share * std::max(1.0, t.pad_shear) * rail.inverse_mass[n.index] * dt *
                                  (t.pad_stiffness * dt + 2 * t.pad_damping));
  const double room = 4 * (1 - safety * safety);
  if (worst > room)
    throw CaseError(
        fmt::format("the pads are too stiff for the time step at the foot's nodes: {:.2g} of {:.2g}", worst, room),
        "give a longer track.pad_length, less track.pad_damping or run.step_safety", "track.pad_length");
}

void press_on_sleepers(const RailPads& pads, const Field& u, Field& f) {
  const double stiffness[3] = {pads.track.pad_shear * pads.track.pad_stiffness,
                               pads.track.pad_shear * pads.track.pad_stiffness, pads.track.pad_stiffness};
  for (const auto& pad : pads.nodes)
    for (const NodeShare& n : pad)
      for (int i = 0; i < 3; ++i) {
        const std::ptrdiff_t at = n.index + static_cast<std::ptrdiff_t>(i) * n.stride;
        f[at] += n.share * stiffness[i] * u[at];
      }
}

void let_sleepers_sink(const RailPads& pads, const Field& u, Field& f) {
  for (const auto& pad : pads.nodes) {
    const double force = pads.track.pad_stiffness * pads.follows() * mean_height(pad, u);
    for (const NodeShare& n : pad) f[n.index + 2 * n.stride] -= n.share * force;
  }
}

std::vector<MassGroup> sleepers_below(const RailPads& pads, const Field& u, const Field& v) {
  std::vector<MassGroup> out;
  for (const auto& pad : pads.nodes)
    out.push_back({pads.follows() * mean_height(pad, u), pads.follows() * mean_height(pad, v)});
  return out;
}

std::size_t sleeper_near(const RailPads& pads, double x) {
  const auto away = [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); };
  return static_cast<std::size_t>(std::min_element(pads.x.begin(), pads.x.end(), away) - pads.x.begin());
}

}  // namespace railstrata
