#include "single_track/history_stress.hpp"

#include <algorithm>
#include <cassert>
#include <stdexcept>

#include "core/lagrange.hpp"
#include "core/parallel.hpp"

namespace railstrata {
namespace {

/// How far along a direction from `from` one stays between the ends: a share of `way`, at most 1.
double share_inside(double from, double way, double low, double high) {
  double share = 1;
  if (from + way > high) share = (high - from) / way;
  if (from + way < low) share = (low - from) / way;
  return share;
}

}  // namespace

HistoryStress::HistoryStress(const StressHistory& history, double centre_x, double centre_y)
    : history_(&history), centre_x_(centre_x), centre_y_(centre_y) {
  const StressHistory& h = history;
  if (h.x.empty() || h.y.empty() || h.depth.empty() || h.stress.size() != h.x.size() * h.y.size() * h.depth.size())
    throw std::invalid_argument("stress history: it is empty or its arrays do not fit each other");
  if (h.depth.front() != 0) throw std::invalid_argument("stress history: its first row is not the surface");
  if (centre_x < h.x.front() || centre_x > h.x.back() || centre_y < h.y.front() || centre_y > h.y.back())
    throw std::invalid_argument("stress history: the centre of the patch lies outside of it");
  for (int row = 0; row < h.rows(); ++row) {
    if (row == 0 || h.depth[row] == h.depth[row - 1]) spans_.push_back({.first = row, .count = 0});
    ++spans_.back().count;
  }
}

HistoryStress::Span HistoryStress::span_at(double depth, bool below_interface) const {
  for (const Span& s : spans_) {
    const double bottom = history_->depth[s.first + s.count - 1];
    if (depth < bottom || (depth == bottom && !below_interface)) return s;
  }
  return spans_.back();
}

Sym3 HistoryStress::at(Vec3 p, bool below_interface) const {
  const StressHistory& h = *history_;
  const double dx = p.x - centre_x_, dy = p.y - centre_y_;
  const double share =
      std::min({share_inside(centre_x_, dx, h.x.front(), h.x.back()), share_inside(0, p.z, 0, h.depth.back()),
                h.columns() > 1 ? share_inside(centre_y_, dy, h.y.front(), h.y.back()) : 1.});
  const double z = share * p.z;
  const Span span = span_at(z, below_interface);
  const LagrangeStencil along = lagrange_stencil(h.x.data(), h.samples(), centre_x_ + share * dx),
                        across = lagrange_stencil(h.y.data(), h.columns(), centre_y_ + share * dy),
                        down = lagrange_stencil(h.depth.data() + span.first, span.count, z);
  Sym3 sum;
  for (int r = 0; r < down.count; ++r)
    for (int c = 0; c < across.count; ++c) {
      const Sym3* cycle = h.cycle(span.first + down.first + r, across.first + c) + along.first;
      const double weight = share * share * down.weight[r] * across.weight[c];
      for (int i = 0; i < along.count; ++i) sum = sum + (weight * along.weight[i]) * cycle[i];
    }
  return sum;
}

std::vector<Sym3> HistoryStress::operator()(const std::vector<Vec3>& points, bool below_interface) const {
  std::vector<Sym3> out(points.size());
  for_each(static_cast<std::ptrdiff_t>(points.size()),
           [&](std::ptrdiff_t i) { out[i] = at(points[i], below_interface); });
  return out;
}

std::vector<double> HistoryStress::interfaces() const {
  std::vector<double> depths;
  for (std::size_t s = 1; s < spans_.size(); ++s) depths.push_back(history_->depth[spans_[s].first]);
  return depths;
}

double HistoryStress::of_rows(const std::vector<double>& values, double depth, bool below_interface) const {
  assert(values.size() == history_->depth.size());
  const Span span = span_at(depth, below_interface);
  const double* at = history_->depth.data() + span.first;
  const int above = static_cast<int>(std::upper_bound(at, at + span.count, depth) - at);
  const int upper = std::clamp(above - 1, 0, span.count - 1);
  if (upper + 1 >= span.count || depth <= at[upper]) return values[span.first + upper];
  const double t = (depth - at[upper]) / (at[upper + 1] - at[upper]);
  return (1 - t) * values[span.first + upper] + t * values[span.first + upper + 1];
}

SingleTrackInput single_track_input(const StressHistory& history, std::vector<double> shear_strength,
                                    double half_length, double half_width, double centre_x, double centre_y) {
  if (shear_strength.size() != history.depth.size())
    throw std::invalid_argument("single track: strengths are one for each row of the history");
  const HistoryStress stress(history, centre_x, centre_y);
  SingleTrackInput in;
  in.stress = stress;
  in.shear_strength = [stress, strength = std::move(shear_strength)](double depth, bool below_interface) {
    return stress.of_rows(strength, depth, below_interface);
  };
  in.interfaces = stress.interfaces();
  in.half_length = half_length;
  in.half_width = half_width;
  in.centre_x = centre_x;
  in.centre_y = centre_y;
  return in;
}

}  // namespace railstrata
