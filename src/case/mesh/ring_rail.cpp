#include "mesh/bodies.hpp"

#include <fmt/format.h>

#include <numbers>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr double kRimOfRing = 0.6;  // what is meshed like a wheel's rim; below it the coarser stations of a plate

void check_ring(double radius, const RailMeshSpec& spec) {
  if (spec.block_height >= radius)
    throw CaseError(fmt::format("a ring of {:g} mm around its axle has no room for {:g} mm of material", 1e3 * radius,
                                1e3 * spec.block_height),
                    "make geometry.block_height smaller than geometry.rail_radius: it is the ring's thickness");
  if (spec.x_end - spec.x_begin > 2 * std::numbers::pi * radius)
    throw CaseError(
        fmt::format("the path, with the patch at both ends, is {:.1f} mm: more than one turn of the ring of {:.1f} mm",
                    1e3 * (spec.x_end - spec.x_begin), 2e3 * std::numbers::pi * radius),
        "bring run.positions closer together");
}

}  // namespace

SweptBody mesh_ring_rail(const Profile& profile, double radius, const RailMeshSpec& spec, const MeshSizes& sizes) {
  check_ring(radius, spec);
  WheelMeshSpec ring;
  ring.shape = WheelShape::disc;
  ring.contact_s = spec.contact_s;
  ring.theta_begin = std::numbers::pi - spec.x_end / radius;
  ring.theta_end = std::numbers::pi - spec.x_begin / radius;
  ring.section.rim_thickness = kRimOfRing * spec.block_height;
  ring.section.bore_radius = radius - spec.block_height;
  ring.layers = spec.layers;
  SweptBody body = mesh_wheel(profile.upturned(), radius, {0, 0, -radius}, ring, sizes);
  body.name = "rail";
  body.contact_at = std::numbers::pi;
  return body;
}

}  // namespace railstrata
