#include "geometry/height_field.hpp"

#include <algorithm>

namespace railstrata {
namespace {

double across(const Irregularity& is, double y) {
  if (!is.width) return 1;
  return std::abs(y) < 0.5 * *is.width ? 0.5 * (1 + std::cos(2 * std::numbers::pi * y / *is.width)) : 0;
}

double largest_slope(Irregularity is, const Sampled& sampled, double wheel_radius) {
  constexpr int kSamples = 4000;
  const auto& [range, rows] = sampled;
  is.on = BodyId::rail;
  const HeightField field({is}, BodyId::rail, wheel_radius);
  double most = 0;
  for (const double y : rows)
    for (int k = 0; k <= kSamples; ++k)
      most =
          std::max(most, std::abs(field.at(range.from + (range.to - range.from) * k / kSamples, is.offset + y).along));
  return most;
}

}  // namespace

HeightField::HeightField(const std::vector<Irregularity>& all, BodyId on, double wheel_radius) {
  for (const Irregularity& is : all) {
    if (is.on != on) continue;
    const double at = is.at.value_or(0);
    parts_.push_back({is, on == BodyId::wheel ? 2 * std::numbers::pi * wheel_radius : 0,
                      std::visit([&](const auto& shape) { return shape.height(at, wheel_radius); }, is.shape)});
  }
}

SurfaceHeight HeightField::at(double x, double y) const {
  SurfaceHeight sum;
  for (const Part& part : parts_) {
    double place = x;
    if (part.round > 0) {  // the turn that is nearest to it
      const Extent extent = extent_of(part.is);
      const double middle = std::isfinite(extent.to - extent.from) ? 0.5 * (extent.from + extent.to) : 0;
      place -= part.round * std::round((x - middle) / part.round);
    }
    const double aside = y - part.is.offset;
    const SurfaceHeight h = across(part.is, aside) * part.height(place, aside);
    sum = {sum.z + h.z, sum.along + h.along};
  }
  return sum;
}

Extent extent_of(const Irregularity& is) {
  return std::visit([&](const auto& shape) { return shape.extent(is.at.value_or(0)); }, is.shape);
}

double shortest_wave(const Irregularity& is, double wheel_radius) {
  return std::visit([&](const auto& shape) { return shape.shortest_wave(wheel_radius); }, is.shape);
}

double steepest_slope(const Irregularity& is, double wheel_radius) {
  return std::visit(
      [&](const auto& shape) {
        if constexpr (requires { shape.steepest_slope(wheel_radius); })
          return shape.steepest_slope(wheel_radius);
        else
          return largest_slope(is, shape.sampled(is.at.value_or(0)), wheel_radius);
      },
      is.shape);
}

double contact_reach(const std::vector<Irregularity>& irregularities, double wheel_radius) {
  double out = 0;
  for (const Irregularity& is : irregularities) {
    const double most = std::visit(
        [&](const auto& shape) {
          const Extent extent = extent_of(is);
          if constexpr (requires { shape.reach(wheel_radius); })
            return shape.reach(wheel_radius);
          else
            return 0.5 * (extent.to - extent.from);
        },
        is.shape);
    out += std::min(wheel_radius * steepest_slope(is, wheel_radius), most);
  }
  return out;
}

}  // namespace railstrata
