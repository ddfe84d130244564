#include "model/zone.hpp"

#include <fmt/format.h>

#include "spec/case_spec.hpp"

namespace railstrata {

std::vector<std::size_t> layers_on(const CaseSpec& spec, BodyId body) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < spec.layers.size(); ++i)
    if (spec.layers[i].on == body) out.push_back(i);
  return out;
}

const MaterialSpec& zone_material(const CaseSpec& spec, BodyId body, int zone) {
  if (zone == 0) return body == BodyId::rail ? spec.rail_material : spec.wheel_material;
  return spec.layers.at(layers_on(spec, body).at(zone - 1)).material;
}

std::string zone_name(const CaseSpec& spec, BodyId body, int zone) {
  if (zone == 0) return std::string(body_word(body));
  return spec.layers.at(layers_on(spec, body).at(zone - 1)).name;
}

std::string zone_key(const CaseSpec& spec, BodyId body, int zone) {
  if (zone == 0) return fmt::format("material.{}", body_word(body));
  return fmt::format("layer.{}", layers_on(spec, body).at(zone - 1));
}

}  // namespace railstrata
