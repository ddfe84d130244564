#include "body/body.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/parallel.hpp"
#include "element/element_matrix.hpp"

namespace railstrata {
namespace {

// Half of an element's mass at a corner goes to each of its two stations.
void add_element_masses(const Body& body, int b, Field& mass) {
  const Block& block = body.mesh.blocks[b];
  const Section& section = block.section;
  const BlockLayout& lay = body.layout.blocks[b];
  const ElementTable<double>& table = body.elements[b].table;
  for (int e = 0; e < lay.elements; ++e) {
    const int next = e + 1 < lay.stations ? e + 1 : 0;
    const SweepScale scale{table.sigma[e], table.c[e]};
    for (int q = 0; q < static_cast<int>(section.quads.size()); ++q) {
      const double density = body.materials[block.material(q, e)].density;
      const std::array<double, 4> m = corner_masses(body.mesh.kind, quad_corners(section, q), scale, density);
      for (int n = 0; n < 4; ++n)
        for (int i = 0; i < 3; ++i) {
          const std::ptrdiff_t line = lay.line(section.quads[q][n], i);
          mass[line + e] += m[n];
          mass[line + next] += m[n];
        }
    }
  }
}

// Slaves have given their mass to their masters; prescribed nodes keep theirs for whatever carries them.
void find_free_nodes(Body& body) {
  std::vector<std::vector<bool>> prescribed;
  for (const BlockLayout& b : body.layout.blocks) prescribed.emplace_back(b.nodes, false);
  for (const SectionNode& n : body.mesh.prescribed) prescribed[n.block][n.node] = true;
  body.inverse_mass = body.layout.field();
  for (int b = 0; b < static_cast<int>(body.layout.blocks.size()); ++b)
    for (int n = 0; n < body.layout.blocks[b].nodes; ++n)
      for (int i = 0; i < 3; ++i) {
        const std::ptrdiff_t first = body.layout.blocks[b].line(n, i);
        const int count = body.layout.blocks[b].stations;
        if (prescribed[b][n]) continue;
        if (body.ties.is_slave(b, n)) {
          std::fill_n(body.mass.begin() + first, count, 0.0);
          continue;
        }
        for (int j = 0; j < count; ++j) body.inverse_mass[first + j] = 1 / body.mass[first + j];
        body.lines.push_back({first, count, i, b, n});
      }
}

// Diagonal blocks of an element's stiffness in its own frame: xx, yy, zz, xz of each corner. Both stations have the
// same values but for the sign of xz.
using CornerBlocks = std::array<double, 32>;

CornerBlocks corner_blocks(SweepKind kind, const BlockElements& elements, int cls, int quad) {
  const SpacingClass& mine = elements.classes[cls];
  const Matrix24 k =
      linear_stiffness(elements.table.quads[elements.reference(mine.set, quad)], sweep_scale(kind, mine.spacing),
                       elements.table.hourglass[elements.hourglass(mine, quad)]);
  CornerBlocks out;
  for (int a = 0; a < 8; ++a) {
    out[4 * a] = k(3 * a, 3 * a);
    out[4 * a + 1] = k(3 * a + 1, 3 * a + 1);
    out[4 * a + 2] = k(3 * a + 2, 3 * a + 2);
    out[4 * a + 3] = k(3 * a, 3 * a + 2);
  }
  return out;
}

}  // namespace

Body::Body(const SweptBody& swept, const std::vector<Elastic>& materials_, const ElementOptions& options_)
    : mesh(swept),
      layout(layout_of(swept)),
      materials(materials_),
      options(options_),
      tiling(tiling_of(swept, layout)),
      ties(swept, layout),
      element_mass(layout.field()) {
  for (int b = 0; b < static_cast<int>(mesh.blocks.size()); ++b) {
    elements.push_back(block_elements(mesh.kind, mesh.blocks[b], layout.blocks[b], materials, options));
    add_element_masses(*this, b, element_mass);
  }
  mass = element_mass;
  ties.apply_transpose(mass);
  find_free_nodes(*this);
}

double total_mass(const Body& body) {
  double sum = 0;
  for (const BlockLayout& l : body.layout.blocks)
    for (int n = 0; n < l.nodes; ++n)
      for (int j = 0; j < l.stations; ++j) sum += body.element_mass[l.line(n, 0) + j];
  return sum;
}

Vec3 reference_position(const Body& body, int block, int node, int station) {
  const Block& b = body.mesh.blocks[block];
  return swept_point(body.mesh.kind, body.mesh.origin, b.section.nodes[node], b.stations.at[station]);
}

void stiffness_diagonal(const Body& body, Field& diagonal) {
  assert(diagonal.size() == static_cast<std::size_t>(body.layout.size));
  std::fill(diagonal.begin(), diagonal.end(), 0.0);
  for (int b = 0; b < static_cast<int>(body.elements.size()); ++b) {
    const BlockElements& d = body.elements[b];
    const BlockLayout& lay = body.layout.blocks[b];
    const int quads = d.quads, classes = static_cast<int>(d.classes.size());
    std::vector<CornerBlocks> block(static_cast<std::size_t>(classes) * quads);
    for_each(static_cast<std::ptrdiff_t>(block.size()), [&](std::ptrdiff_t i) {
      block[i] = corner_blocks(body.mesh.kind, d, static_cast<int>(i / quads), static_cast<int>(i % quads));
    });
    for (int q = 0; q < quads; ++q)
      for (int a = 0; a < 8; ++a) {
        double* x = diagonal.data() + lay.line(body.mesh.blocks[b].section.quads[q][a % 4], 0);
        for (int e = 0; e < lay.elements; ++e) {
          const CornerBlocks& k = block[static_cast<std::size_t>(d.element_class[e]) * quads + q];
          const int j = a < 4 ? e : (e + 1 < lay.stations ? e + 1 : 0);
          const double c = d.cos_q[e], s = d.sin_q[e], cross_term = 2 * c * s * k[4 * a + 3];
          x[j] += c * c * k[4 * a] + s * s * k[4 * a + 2] - cross_term;
          x[j + lay.stride] += k[4 * a + 1];
          x[j + 2 * lay.stride] += s * s * k[4 * a] + c * c * k[4 * a + 2] + cross_term;
        }
      }
  }
}

StepBound element_step_bound(const Body& body) {
  StepBound best{std::numeric_limits<double>::infinity(), 0};
  for (int b = 0; b < static_cast<int>(body.elements.size()); ++b) {
    const BlockElements& d = body.elements[b];
    const Block& block = body.mesh.blocks[b];
    const Section& section = block.section;
    const int quads = d.quads, classes = static_cast<int>(d.classes.size());
    std::vector<double> step(static_cast<std::size_t>(quads) * classes);
    for_each(static_cast<std::ptrdiff_t>(step.size()), [&](std::ptrdiff_t i) {
      const int q = static_cast<int>(i % quads);
      const SpacingClass& mine = d.classes[i / quads];
      step[i] = element_stable_step(body.mesh.kind, quad_corners(section, q), sweep_scale(body.mesh.kind, mine.spacing),
                                    body.materials[block.material_of_set(mine.set, q)],
                                    d.table.hourglass[d.hourglass(mine, q)]);
    });
    const double smallest = *std::min_element(step.begin(), step.end());
    if (smallest < best.step) best = {smallest, b};
  }
  return best;
}

}  // namespace railstrata
