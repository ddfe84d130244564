#pragma once
// The stress of a body's contact band at the centres of its elements, where that of these elements is most accurate.
// Plain numbers: nothing here knows the finite element solver.
#include <vector>

#include "contact/contact_field.hpp"
#include "fem/band_sample.hpp"
#include "mesh/swept.hpp"

namespace railstrata {

/// A body's contact band around the wheel: geometry and mean stresses, ready for maxima, lines and pictures.
struct BandStress {
  const SweptBody* body = nullptr;
  BandSample sample;
  double contact_y = 0;              ///< y of the rigid contact point in section coordinates
  std::vector<double> centre_y;      ///< per column, section coordinate
  std::vector<double> centre_depth;  ///< per row
  std::size_t index(int column, int row, int station) const {
    return (static_cast<std::size_t>(station) * sample.rows + row) * sample.columns + column;
  }
  Sym3 at(int column, int row, int station) const { return sample.stress[index(column, row, station)]; }
  /// Layer of an element: 0 the matrix, then the layers from the surface down.
  int layer(int column, int row, int station) const {
    const int quad = row * sample.columns + column;
    const Block& block = body->blocks[body->contact.block];
    return body->layer_of(sample.element.empty() ? block.section.quad_material[quad]
                                                 : block.material(quad, sample.element[station]));
  }
  double x(int station) const { return 0.5 * (sample.along[station] + sample.along[station + 1]); }
};
BandStress band_stress(const SweptBody& body, BandSample sample, double contact_y);

/// The surface of a finite element body.
struct BandSurface {
  std::vector<Sym3> stress;  ///< Pa, at the nodes (band_surface.hpp)
  const ContactField& field;
  double poisson = 0;  ///< of the surface
  double radius = 0;   ///< m, of the wheel; 0: the rail; negative: a rail that is a ring
};

/// Calls with the four points of a field around a place, their columns and the weights of bilinear interpolation; not
/// outside the field.
template <class Use>
void points_around(const ContactField& f, double x, double y, const Use& use) {
  const auto station = [&](int s) { return f.x[static_cast<std::size_t>(s) * f.columns]; };
  int c = 0, s = 0;
  while (c + 2 < f.columns && f.y[c + 1] <= y) ++c;
  while (s + 2 < f.stations && station(s + 1) <= x) ++s;
  const double a = (y - f.y[c]) / (f.y[c + 1] - f.y[c]), b = (x - station(s)) / (station(s + 1) - station(s));
  if (a < 0 || a > 1 || b < 0 || b > 1) return;
  for (int k = 0; k < 4; ++k)
    use(static_cast<std::size_t>(s + k / 2) * f.columns + c + k % 2, c + k % 2,
        (k % 2 ? a : 1 - a) * (k / 2 ? b : 1 - b));
}

/// Stress at a depth within the rows of one material around `row`, or at their border: of the parabola through the
/// three nearest element centres, where there are more than three rows, else of the straight line through two. Nearer
/// to the surface stress bends too much for a parabola of all three.
Sym3 stress_at_depth(const BandStress& band, int column, int row, int station, double depth);

/// Stress at the upper face of row `row`, which is an interface, recovered from the material above it or below.
inline Sym3 stress_at_interface(const BandStress& band, int column, int row, int station, bool below) {
  return stress_at_depth(band, column, below ? row : row - 1, station, band.body->contact.depth[row]);
}

}  // namespace railstrata
