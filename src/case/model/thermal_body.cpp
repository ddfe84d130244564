#include "model/thermal_body.hpp"

namespace railstrata {

namespace {

ThermalMaterial thermal(const MaterialSpec& m) {
  return {m.strength.heat.conductivity, m.density, m.strength.heat.capacity};
}

}  // namespace

ThermalBody thermal_body(const CaseSpec& spec, BodyId body) {
  ThermalBody out;
  out.base = thermal(body == BodyId::rail ? spec.rail_material : spec.wheel_material);
  for (const LayerSpec& layer : spec.layers)
    if (layer.on == body && layer.thickness > 0) {
      if (out.layer_thickness > 0) {
        out.deeper.push_back(thermal(layer.material));
        continue;
      }
      out.layer_thickness = layer.thickness;
      out.layer = thermal(layer.material);
    }
  return out;
}

}  // namespace railstrata
