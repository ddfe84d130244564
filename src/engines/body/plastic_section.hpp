#pragma once
// Yielded section of a straight rail whose state is the same at all stations: plastic strains, accumulated plastic
// strain and backstresses at the Gauss points of its section. It is taken from stations over which a wheel has rolled
// steadily and put to all stations, as the beginning of the next pass.
#include <vector>

#include "body/body.hpp"

namespace railstrata {

/// State of the quadrilaterals that may yield, in the order of blocks and quadrilaterals.
struct PlasticSection {
  struct Quad {
    int block, quad;
    friend auto operator<=>(const Quad&, const Quad&) = default;
  };
  int point_entries = 0;        ///< numbers of a point, as PlasticElements has them
  std::vector<Quad> quads;      ///< of the mesh
  std::vector<double> history;  ///< [quads][pairs of Gauss points][point_entries]

  const double* point(std::size_t quad, int pair) const {
    return history.data() + (quad * kGaussPairs + static_cast<std::size_t>(pair)) * point_entries;
  }
};

/// Mean over the elements whose centres lie between two positions along the sweep [m]; of a block without such an
/// element the one around their middle. Elements that stay elastic count with zeros. Extruded bodies.
PlasticSection plastic_section(const Body& body, const PlasticHistory& history, double from, double to);

/// A section's numbers for the quadrilaterals of another one, in their order; zeros where it has none.
PlasticSection on_quads(const PlasticSection& section, const PlasticSection& like);

/// A history with the section at every station, in equilibrium with nothing yet: the eigenstress is that of the plastic
/// strains, no plastic work is done and all elements sleep. Throws CaseError if what has yielded may not yield in this
/// body.
PlasticHistory history_of_section(const Body& body, const PlasticSection& section);

/// Mean of a quadrilateral's points, by their shares of the volume.
struct SectionStrain {
  std::array<double, 6> plastic{};  ///< Ep; 11 along the sweep, 22 lateral, 33 up, 12, 23, 13
  double accumulated = 0;           ///< p
};
SectionStrain section_strain(const Body& body, const PlasticSection& section, std::size_t quad);

}  // namespace railstrata
