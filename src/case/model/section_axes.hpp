#pragma once
// Axes of the rigid contact point in a body's section.
#include <cmath>

#include "model/model.hpp"

namespace railstrata {

/// `into` the body, `across` in the contact plane: of the rail to its field side.
struct SectionAxes {
  Vec2 point, across, into;
  SectionAxes(const Model& m, BodyId id) {
    const RigidContact& c = m.placement.contact;
    const bool rail = id == BodyId::rail;
    const Vec2 outward = rail ? m.rail_section_normal(c.rail_s) : m.wheel_section_normal(c.wheel_s);
    point = rail ? m.rail_section_point(c.rail_s) : m.wheel_section_point(c.wheel_s);
    into = {-outward.y, -outward.z};
    across = {outward.z, -outward.y};
  }
  double depth(Vec2 p) const { return dot(p - point, into); }
  double aside(Vec2 p) const { return std::abs(dot(p - point, across)); }
};

}  // namespace railstrata
