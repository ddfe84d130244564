#include "fem/interface_step.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "mesh/split_interface.hpp"

namespace railstrata {
namespace {

constexpr double kSamePlace = 1e-9;  // m

// Outward, at a node of the band's grid: across the line between the neighbours of its row.
Vec3 normal_at(const Section& section, const ContactBand& band, int node) {
  const int column = node % (band.columns + 1), first = node - column;
  const Vec2 along = section.nodes[static_cast<std::size_t>(first + std::min(column + 1, band.columns))] -
                     section.nodes[static_cast<std::size_t>(first + std::max(column - 1, 0))];
  return (1 / norm(along)) * Vec3{0, -along.z, along.y};
}

// Stations within the stretches, their ends left out: they hold.
std::vector<StationRange> open_stations(const std::vector<SweepRange>& open, const std::vector<double>& at) {
  std::vector<StationRange> out;
  for (const SweepRange& stretch : open) {
    const auto begin = std::upper_bound(at.begin(), at.end(), stretch.from + kSamePlace),
               end = std::lower_bound(at.begin(), at.end(), stretch.to - kSamePlace);
    if (begin < end) out.push_back({static_cast<int>(begin - at.begin()), static_cast<int>(end - at.begin())});
  }
  return out;
}

std::vector<StationRange> between(const std::vector<StationRange>& ranges, int stations) {
  std::vector<StationRange> out;
  int begin = 0;
  for (const StationRange& range : ranges) {
    out.push_back({begin, range.begin});
    begin = range.end;
  }
  out.push_back({begin, stations});
  return out;
}

}  // namespace

InterfaceStep::InterfaceStep(const Body& rail) : mass_(rail.mass) {
  const Block& block = rail.mesh.blocks[rail.mesh.contact.block];
  const BlockLayout& lay = rail.layout.blocks[rail.mesh.contact.block];
  for (const SplitInterface& interface : rail.mesh.interfaces) {
    const std::vector<StationRange> open = open_stations(interface.open, block.stations.at);
    each_pair(interface, rail.mesh.contact, [&](int above, int below) {
      lines_.push_back({lay.line(above, 0), lay.line(below, 0), lay.stride,
                        normal_at(block.section, rail.mesh.contact, above), interface.friction, open,
                        between(open, lay.stations)});
    });
  }
  losses_.resize(lines_.size());
}

void InterfaceStep::join(Field& f) const {
  for_each(static_cast<std::ptrdiff_t>(lines_.size()), [&](std::ptrdiff_t k) {
    const Line& line = lines_[k];
    for (const StationRange& range : line.joined)
      for (int i = 0; i < 3; ++i)
        for (int j = range.begin; j < range.end; ++j) {
          const std::ptrdiff_t above = line.above + j + static_cast<std::ptrdiff_t>(i) * line.stride,
                               below = line.below + j + static_cast<std::ptrdiff_t>(i) * line.stride;
          const double slowing = (f[above] + f[below]) / (mass_[above] + mass_[below]);
          f[above] = mass_[above] * slowing;
          f[below] = mass_[below] * slowing;
        }
  });
}

InterfaceLosses InterfaceStep::press(const Field& u, const Field& v, double dt, double damping_rate, Field& f) {
  for_each(static_cast<std::ptrdiff_t>(lines_.size()),
           [&](std::ptrdiff_t k) { losses_[k] = press_line(lines_[k], u, v, dt, damping_rate, f); });
  InterfaceLosses sum;
  for (const InterfaceLosses& l : losses_) {
    sum.friction += l.friction;
    sum.normal += l.normal;
  }
  return sum;
}

// Work is force times the mean of the velocities before and after the update, exact for the scheme.
InterfaceLosses InterfaceStep::press_line(const Line& line, const Field& u, const Field& v, double dt,
                                          double damping_rate, Field& f) const {
  InterfaceLosses out;
  for (const StationRange& range : line.open)
    for (int j = range.begin; j < range.end; ++j) {
      const std::ptrdiff_t above = line.above + j, below = line.below + j;
      const auto relative = [&](const Field& of) {
        return vector_at(of, above, line.stride) - vector_at(of, below, line.stride);
      };
      const double slow_above = 1 / mass_[above], slow_below = 1 / mass_[below];
      const Vec3 before = relative(v), slowing = slow_above * vector_at(f, above, line.stride) -
                                                 slow_below * vector_at(f, below, line.stride);
      const Vec3 free = (1 - dt * damping_rate) * before - dt * slowing;
      const NodePair pair{line.normal, 1 / (slow_above + slow_below), line.friction};
      const PairForce force = pair_force(pair, relative(u), free, dt);
      const Vec3 whole = force.whole(line.normal), mean = 0.5 * (before + free + (dt / pair.mass) * whole);
      add_vector(f, above, line.stride, -whole);
      add_vector(f, below, line.stride, whole);
      out.normal -= dt * force.pressure * dot(mean, line.normal);
      out.friction -= dt * dot(force.shear, mean);
    }
  return out;
}

InterfaceGap InterfaceStep::gap(const Field& u) const {
  InterfaceGap out;
  for (const Line& line : lines_)
    for (const StationRange& range : line.open)
      for (int j = range.begin; j < range.end; ++j) {
        const Vec3 apart = vector_at(u, line.above + j, line.stride) - vector_at(u, line.below + j, line.stride);
        const double opening = dot(apart, line.normal);
        out.opening = std::max(out.opening, opening);
        out.slip = std::max(out.slip, norm(apart - opening * line.normal));
      }
  return out;
}

}  // namespace railstrata
