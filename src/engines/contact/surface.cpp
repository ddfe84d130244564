#include "contact/surface.hpp"

#include <algorithm>

namespace railstrata {

ContactSurface contact_surface(const SweptBody& body, const BodyLayout& layout, const SectionCurve& curve) {
  ContactSurface c;
  const Block& block = body.blocks[body.contact.block];
  const BlockLayout& lay = layout.blocks[body.contact.block];
  c.origin = body.origin;
  c.contact_at = body.contact_at;
  c.rises = body.rises();
  c.columns = body.contact.columns + 1;
  c.stations = block.stations;
  c.s = body.contact.s;
  for (int n = 0; n < c.columns; ++n) {
    c.node.push_back(block.section.nodes[n]);
    c.outward.push_back(curve(c.s[n]).outward);
  }
  for (int n = 0; n + 1 < c.columns; ++n) {
    c.sagitta.push_back(curve(0.5 * (c.s[n] + c.s[n + 1])).position - 0.5 * (c.node[n] + c.node[n + 1]));
    c.width.push_back(std::abs(c.s[n + 1] - c.s[n]));
  }
  if (body.kind == SweepKind::revolve) {
    c.radius = 0;
    for (const Vec2& n : c.node) c.radius = std::max(c.radius, std::abs(n.z));
  }
  c.first_line = lay.line(0, 0);
  c.stride = lay.stride;
  return c;
}

}  // namespace railstrata
