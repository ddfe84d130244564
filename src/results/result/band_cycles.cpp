// A finite element body's contact band: its stresses and their cycles.
#include <cmath>
#include <utility>

#include "core/lagrange.hpp"
#include "core/rotation.hpp"
#include "material/elastic.hpp"
#include "result/stress_cycles.hpp"
#include "result/surface_peaks.hpp"

namespace railstrata {
namespace {

/// Rows of a band: where each takes its stresses from.
struct BandRow {
  enum class From { surface, centre, interface_above, interface_below } from;
  int row;
};

std::vector<BandRow> band_rows(const BandStress& b) {
  std::vector<BandRow> rows{{BandRow::From::surface, 0}};
  for (int r = 0; r < b.sample.rows; ++r) {
    if (r > 0 && b.layer(b.sample.columns / 2, r, 0) != b.layer(b.sample.columns / 2, r - 1, 0)) {
      rows.push_back({BandRow::From::interface_above, r});
      rows.push_back({BandRow::From::interface_below, r});
    }
    rows.push_back({BandRow::From::centre, r});
  }
  return rows;
}

/// The rail's z axis points down into it, the wheel's up: stresses of the model frame in the axes of a column whose
/// surface rises with `angle` towards the field side, and of the wheel's station at x.
Sym3 in_column_frame(const Sym3& stress, double angle, double radius, double x) {
  Sym3 s = roll(rotation_by(-angle), stress);
  if (radius > 0) {  // about y, by the station's azimuth; small
    const double t = x / radius, c = std::cos(t), d = std::sin(t);
    s = {c * c * s.xx + 2 * c * d * s.xz + d * d * s.zz,
         s.yy,
         d * d * s.xx - 2 * c * d * s.xz + c * c * s.zz,
         c * s.xy + d * s.yz,
         c * s.yz - d * s.xy,
         (c * c - d * d) * s.xz + c * d * (s.zz - s.xx)};
    return s;
  }
  s.yz = -s.yz;
  s.xz = -s.xz;
  return s;
}

/// Pressure, traction and state at a point of a contact field, linear between its points.
struct TouchAt {
  double p = 0, q = 0;  ///< Pa
  ContactState state = ContactState::separated;
};
TouchAt touch_at(const ContactField& f, double x, double y) {
  TouchAt out;
  double q_x = 0, q_y = 0, slip = 0;
  points_around(f, x, y, [&](std::size_t i, int, double weight) {
    out.p += weight * f.p[i];
    q_x += weight * f.q_x[i];
    q_y += weight * f.q_y[i];
    if (f.state[i] == ContactState::slip) slip += weight;
  });
  out.q = std::hypot(q_x, q_y);
  if (out.p > 0) out.state = slip >= 0.5 ? ContactState::slip : ContactState::stick;
  return out;
}

/// Places along a direction: nodes and, between them, the elements' centres. The outermost elements are left out, where
/// no surface stress is recovered. An even place k is the node k/2 + 1, an odd one the centre of element (k + 1)/2.
struct Places {
  std::vector<double> at;       ///< m
  std::vector<double> centres;  ///< m, of all elements
  int count() const { return static_cast<int>(at.size()); }
  static int node(int place) { return place / 2 + 1; }
  static int element(int place) { return (place + 1) / 2; }
  static bool is_node(int place) { return place % 2 == 0; }
};

class BandCycles {
 public:
  BandCycles(const BandStress& band, const BandSurface& surface);
  StressHistory history() const;

 private:
  Places places(const std::vector<double>& nodes, std::vector<double> centres) const;
  Sym3 centre(const BandRow& row, int column, int station) const;
  /// Stresses of the recovered surface at the nodes of a column, with the peaks between them.
  std::vector<Sym3> surface_column(int column) const;
  void put_surface(StressHistory& out, int row) const;
  void put_below(StressHistory& out, int row, const BandRow& from) const;
  Sym3 turned(const Sym3& stress, double angle, double x) const {
    return in_column_frame(stress, angle, surface_.radius, x);
  }

  const BandStress& band_;
  const BandSurface& surface_;
  std::vector<BandRow> rows_;
  Places x_, y_;
};

BandCycles::BandCycles(const BandStress& band, const BandSurface& surface)
    : band_(band), surface_(surface), rows_(band_rows(band)) {
  const BandSample& s = band.sample;
  std::vector<double> x_centres, y_nodes, y_centres;
  for (int k = 0; k < s.stations; ++k) x_centres.push_back(band.x(k));
  const auto& nodes = band.body->blocks[band.body->contact.block].section.nodes;
  for (int c = 0; c <= s.columns; ++c) y_nodes.push_back(nodes[c].y - band.contact_y);
  for (const double y : band.centre_y) y_centres.push_back(y - band.contact_y);
  x_ = places(s.along, std::move(x_centres));
  y_ = places(y_nodes, std::move(y_centres));
}

Places BandCycles::places(const std::vector<double>& nodes, std::vector<double> centres) const {
  Places out;
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    if (k > 1) out.at.push_back(centres[k - 1]);
    out.at.push_back(nodes[k]);
  }
  out.centres = std::move(centres);
  return out;
}

Sym3 BandCycles::centre(const BandRow& row, int column, int station) const {
  if (row.from == BandRow::From::centre) return band_.at(column, row.row, station);
  return stress_at_interface(band_, column, row.row, station, row.from == BandRow::From::interface_below);
}

std::vector<Sym3> BandCycles::surface_column(int column) const {
  const auto& nodes = band_.body->blocks[band_.body->contact.block].section.nodes;
  const double angle = std::atan2(nodes[column + 1].z - nodes[column - 1].z, nodes[column + 1].y - nodes[column - 1].y);
  const int stations = band_.sample.stations;
  std::vector<Sym3> cycle;
  for (int j = 1; j < stations; ++j)
    cycle.push_back(turned(surface_.stress[static_cast<std::size_t>(j) * (band_.sample.columns + 1) + column], angle,
                           band_.sample.along[j]));
  const std::vector<Sym3> recovered = cycle;
  const auto stress = [&](int i) { return recovered[i]; };
  SurfaceRow row{{}, {}, {}, stress, surface_.poisson};
  for (int j = 1; j < stations; ++j) {
    const TouchAt touch = touch_at(surface_.field, band_.sample.along[j], band_.body->origin.y + nodes[column].y);
    row.p.push_back(touch.p);
    row.q.push_back(touch.q);
    row.state.push_back(touch.state);
  }
  const SurfacePeaks peaks = surface_peaks(row);
  if (!peaks.any()) return cycle;
  if (peaks.first > 0) cycle[peaks.first - 1] = peaks.behind;
  if (peaks.last + 1 < static_cast<int>(cycle.size())) cycle[peaks.last + 1] = peaks.ahead;
  for (const SurfacePeaks::Front& f : peaks.fronts) cycle[f.at] = f.stress;
  return cycle;
}

void BandCycles::put_surface(StressHistory& out, int row) const {
  for (int c = 0; c < y_.count(); c += 2) {
    const std::vector<Sym3> nodes = surface_column(Places::node(c));
    for (int s = 0; s < x_.count(); ++s)
      out.cycle(row, c)[s] = Places::is_node(s) ? nodes[s / 2] : 0.5 * (nodes[s / 2] + nodes[s / 2 + 1]);
  }
  for (int c = 1; c < y_.count(); c += 2)
    for (int s = 0; s < x_.count(); ++s)
      out.cycle(row, c)[s] = 0.5 * (out.cycle(row, c - 1)[s] + out.cycle(row, c + 1)[s]);
}

void BandCycles::put_below(StressHistory& out, int row, const BandRow& from) const {
  const auto& nodes = band_.body->blocks[band_.body->contact.block].section.nodes;
  for (int c = 0; c < y_.count(); ++c) {
    const int left = Places::is_node(c) ? Places::node(c) - 1 : Places::element(c),
              right = Places::is_node(c) ? Places::node(c) + 1 : left + 1;
    const double angle = std::atan2(nodes[right].z - nodes[left].z, nodes[right].y - nodes[left].y);
    const LagrangeStencil across = lagrange_stencil(y_.centres.data(), static_cast<int>(y_.centres.size()), y_.at[c]);
    for (int s = 0; s < x_.count(); ++s) {
      const LagrangeStencil along = lagrange_stencil(x_.centres.data(), static_cast<int>(x_.centres.size()), x_.at[s]);
      Sym3 sum;
      for (int i = 0; i < across.count; ++i)
        for (int j = 0; j < along.count; ++j)
          if (const double weight = across.weight[i] * along.weight[j]; weight != 0)
            sum = sum + weight * centre(from, across.first + i, along.first + j);
      out.cycle(row, c)[s] = turned(sum, angle, x_.at[s]);
    }
  }
}

StressHistory BandCycles::history() const {
  StressHistory out;
  out.x = x_.at;
  out.y = y_.at;
  for (const BandRow& row : rows_) {
    const bool centre = row.from == BandRow::From::centre, surface = row.from == BandRow::From::surface;
    out.depth.push_back(surface ? 0 : centre ? band_.centre_depth[row.row] : band_.body->contact.depth[row.row]);
    out.zone.push_back(
        band_.layer(band_.sample.columns / 2, row.from == BandRow::From::interface_above ? row.row - 1 : row.row, 0));
  }
  out.stress.resize(rows_.size() * out.x.size() * out.y.size());
  for (int r = 0; r < out.rows(); ++r) {
    if (rows_[r].from == BandRow::From::surface)
      put_surface(out, r);
    else
      put_below(out, r, rows_[r]);
  }
  return out;
}

}  // namespace

BandStress band_stress(const SweptBody& body, BandSample sample, double contact_y) {
  BandStress b{&body, std::move(sample), contact_y, {}, {}};
  const ContactBand& band = body.contact;
  const auto& nodes = body.blocks[band.block].section.nodes;
  for (int c = 0; c < band.columns; ++c) b.centre_y.push_back(0.5 * (nodes[c].y + nodes[c + 1].y));
  for (int r = 0; r < band.rows; ++r) b.centre_depth.push_back(0.5 * (band.depth[r] + band.depth[r + 1]));
  return b;
}

Sym3 stress_at_interface(const BandStress& b, int column, int row, int station, bool below) {
  const int near = below ? row : row - 1, far = below ? row + 1 : row - 2;
  const Sym3 stress = b.at(column, near, station);
  if (far < 0 || far >= b.sample.rows || b.layer(column, far, station) != b.layer(column, near, station)) return stress;
  const double t = (b.body->contact.depth[row] - b.centre_depth[near]) / (b.centre_depth[near] - b.centre_depth[far]);
  return stress + t * (stress - b.at(column, far, station));
}

StressHistory band_cycles(const BandStress& band, const BandSurface& surface) {
  return BandCycles(band, surface).history();
}

}  // namespace railstrata
