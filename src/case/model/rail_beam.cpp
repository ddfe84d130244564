#include "model/rail_beam.hpp"

#include "mesh/beam_section.hpp"

namespace railstrata {

RailBeam rail_beam(const Model& model) {
  const BeamSection s = beam_section(model.rail);
  const MaterialSpec& m = model.spec.rail_material;
  return {m.young * s.inertia, s.shear_share * s.area * m.young / (2 * (1 + m.poisson)), m.density * s.area,
          m.density * s.inertia};
}

}  // namespace railstrata
