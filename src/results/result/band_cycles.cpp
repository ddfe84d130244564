// The stress cycles of a finite element body's contact band.
#include <utility>

#include "core/lagrange.hpp"
#include "result/band_surface.hpp"
#include "result/stress_cycles.hpp"

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
  void put_surface(StressHistory& out, int row) const;
  void put_below(StressHistory& out, int row, const BandRow& from) const;

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

void BandCycles::put_surface(StressHistory& out, int row) const {
  for (int c = 0; c < y_.count(); c += 2) {
    const std::vector<Sym3> nodes = surface_column(band_, surface_, Places::node(c));
    for (int s = 0; s < x_.count(); ++s)
      out.cycle(row, c)[s] = Places::is_node(s) ? nodes[s / 2] : 0.5 * (nodes[s / 2] + nodes[s / 2 + 1]);
  }
  for (int c = 1; c < y_.count(); c += 2)
    for (int s = 0; s < x_.count(); ++s)
      out.cycle(row, c)[s] = 0.5 * (out.cycle(row, c - 1)[s] + out.cycle(row, c + 1)[s]);
}

void BandCycles::put_below(StressHistory& out, int row, const BandRow& from) const {
  for (int c = 0; c < y_.count(); ++c) {
    const int left = Places::is_node(c) ? Places::node(c) - 1 : Places::element(c),
              right = Places::is_node(c) ? Places::node(c) + 1 : left + 1;
    const ColumnAxes axes = column_axes(band_, surface_, left, right);
    const LagrangeStencil across = lagrange_stencil(y_.centres.data(), static_cast<int>(y_.centres.size()), y_.at[c]);
    for (int s = 0; s < x_.count(); ++s) {
      const LagrangeStencil along = lagrange_stencil(x_.centres.data(), static_cast<int>(x_.centres.size()), x_.at[s]);
      Sym3 sum;
      for (int i = 0; i < across.count; ++i)
        for (int j = 0; j < along.count; ++j)
          if (const double weight = across.weight[i] * along.weight[j]; weight != 0)
            sum = sum + weight * centre(from, across.first + i, along.first + j);
      out.cycle(row, c)[s] = axes.turned(sum, x_.at[s]);
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

StressHistory band_cycles(const BandStress& band, const BandSurface& surface) {
  return BandCycles(band, surface).history();
}

}  // namespace railstrata
