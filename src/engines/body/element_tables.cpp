#include "body/element_tables.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

constexpr int kLineEnd = 64 / sizeof(float);  // lines end with a whole pack of any number type

bool same_spacing(double a, double b) { return std::abs(a - b) < 1e-9 * b; }

// Index of `value` in `known`, added if it is new.
template <class T, class Same>
int class_of(std::vector<T>& known, const T& value, Same&& same) {
  const auto at = std::find_if(known.begin(), known.end(), [&](const T& k) { return same(k, value); });
  if (at != known.end()) return static_cast<int>(at - known.begin());
  known.push_back(value);
  return static_cast<int>(known.size()) - 1;
}

std::vector<double> spacings(const Block& block, const BlockLayout& lay) {
  std::vector<double> out(lay.elements);
  for (int e = 0; e < lay.elements; ++e) out[e] = block.stations.end(e) - block.stations.at[e];
  return out;
}

void fill_station_lines(SweepKind kind, const std::vector<double>& spacing, int padded, ElementTable<double>& table) {
  assert(padded >= static_cast<int>(spacing.size()));
  for (auto line : table.kLines) (table.*line).assign(padded, 0.0);
  for (std::size_t e = 0; e < spacing.size(); ++e) {
    const StationScale<double> scale = station_scale(sweep_scale(kind, spacing[e]));
    table.inv_sigma[e] = scale.inv_sigma;
    table.inv_c[e] = scale.inv_c;
    table.sigma_c[e] = scale.sigma_c;
    table.sigma[e] = scale.sigma;
    table.c[e] = scale.c;
  }
}

void fill_frames(SweepKind kind, const Block& block, const BlockLayout& lay, BlockElements& out) {
  for (Field* line : {&out.theta, &out.cos_q, &out.sin_q}) line->assign(lay.elements, 0.0);
  for (int e = 0; e < lay.elements; ++e) {
    out.theta[e] = kind == SweepKind::revolve ? block.stations.centre(e) : 0.0;
    out.cos_q[e] = std::cos(out.theta[e]);
    out.sin_q[e] = std::sin(out.theta[e]);
  }
}

// Groups and classes of the elements; returns the spacings that hourglass stiffnesses are made for.
std::vector<double> classify(const std::vector<double>& spacing, const Block& block, int padded, BlockElements& out) {
  assert(!spacing.empty() && padded >= static_cast<int>(spacing.size()));
  std::vector<double> hourglass_spacings;
  const int elements = static_cast<int>(spacing.size());
  for (int e = 0; e < elements; ++e) {
    if (e % kHourglassGroup == 0) {
      const int count = std::min(kHourglassGroup, elements - e);
      const double shortest = *std::min_element(&spacing[e], &spacing[e] + count);
      out.hourglass_class.push_back(class_of(hourglass_spacings, shortest, same_spacing));
    }
    const SpacingClass mine{spacing[e], out.hourglass_class.back(), block.set_of(e)};
    out.element_class.push_back(class_of(out.classes, mine, [](const SpacingClass& a, const SpacingClass& c) {
      return same_spacing(a.spacing, c.spacing) && a.hourglass == c.hourglass && a.set == c.set;
    }));
  }
  out.hourglass_class.resize(padded / kHourglassGroup, out.hourglass_class.back());
  return hourglass_spacings;
}

void fill_sets(const Block& block, int padded, BlockElements& out) {
  out.quads = static_cast<int>(block.section.quads.size());
  if (block.along.empty()) return;
  out.set = block.along.of_element;
  out.set.resize(static_cast<std::size_t>(padded), out.set.back());
  for (int q = 0; q < out.quads; ++q) {
    const auto same = [&](const std::vector<int>& s) { return s[q] == block.section.quad_material[q]; };
    out.varies.push_back(!std::all_of(block.along.sets.begin(), block.along.sets.end(), same));
  }
}

ElementTable<float> rounded(const ElementTable<double>& from) {
  ElementTable<float> to;
  for (const QuadReference& r : from.quads) to.quads.push_back(rounded(r));
  for (const HourglassStiffness& h : from.hourglass) {
    to.hourglass.emplace_back();
    std::transform(h.begin(), h.end(), to.hourglass.back().begin(), [](double x) { return static_cast<float>(x); });
  }
  for (std::size_t k = 0; k < from.kLines.size(); ++k) {
    const ElementTable<double>::Line& line = from.*from.kLines[k];
    (to.*to.kLines[k]).assign(line.begin(), line.end());
  }
  return to;
}

}  // namespace

std::array<Vec2, 4> quad_corners(const Section& s, int quad) {
  const auto& q = s.quads[quad];
  return {s.nodes[q[0]], s.nodes[q[1]], s.nodes[q[2]], s.nodes[q[3]]};
}

BlockElements block_elements(SweepKind kind, const Block& block, const BlockLayout& lay,
                             const std::vector<Elastic>& materials, const ElementOptions& options) {
  const Section& section = block.section;
  const int quads = static_cast<int>(section.quads.size());
  const int padded = (lay.elements + kLineEnd - 1) / kLineEnd * kLineEnd;
  const auto material = [&](std::ptrdiff_t set, int q) -> const Elastic& {
    return materials[block.material_of_set(static_cast<int>(set), q)];
  };
  BlockElements out;
  fill_sets(block, padded, out);
  ElementTable<double>& table = out.table;
  const std::vector<double> spacing = spacings(block, lay);
  fill_station_lines(kind, spacing, padded, table);
  fill_frames(kind, block, lay, out);
  const std::vector<double> hourglass_spacings = classify(spacing, block, padded, out);

  out.hourglass_classes = static_cast<int>(hourglass_spacings.size());
  table.quads.reserve(static_cast<std::size_t>(block.sets()) * quads);
  for (int set = 0; set < block.sets(); ++set)
    for (int q = 0; q < quads; ++q)
      table.quads.push_back(quad_reference(kind, quad_corners(section, q), material(set, q)));
  table.hourglass.assign(table.quads.size() * out.hourglass_classes, HourglassStiffness{});
  for_each(static_cast<std::ptrdiff_t>(table.hourglass.size()), [&](std::ptrdiff_t i) {
    const int q = static_cast<int>(i % quads);
    const std::ptrdiff_t n = i / quads;  // of set and class
    const SweepScale scale = sweep_scale(kind, hourglass_spacings[n % out.hourglass_classes]);
    table.hourglass[i] =
        hourglass_stiffness(kind, quad_corners(section, q), scale, material(n / out.hourglass_classes, q),
                            options.element, kHourglassCoefficient);
  });
  if (options.precision == Precision::single_precision) out.single = rounded(table);
  return out;
}

}  // namespace railstrata
