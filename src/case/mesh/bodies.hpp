#pragma once
// Meshes of the two bodies.
#include <cmath>
#include <limits>

#include "friction/friction_table.hpp"
#include "geometry/body_shapes.hpp"
#include "geometry/placement.hpp"
#include "geometry/profile.hpp"
#include "geometry/rail_outline.hpp"
#include "mesh/swept.hpp"

namespace railstrata {

/// One layer, from the surface down. elements = 0: chosen (height at most 1 mm and at most the element size, at
/// least 2; at least 3 from 3 mm on).
struct LayerMesh {
  std::string name;
  double thickness = 0;  ///< m, along the surface normal
  double width =
      0.060;  ///< m, lateral extent, centred on the body's profile origin; clipped to the band that carries it
  int elements = 0;
  bool continues = false;  ///< a row of a graded layer that goes on below: no interface
  /// m along the rail, of a wheel along its arc from the first contact; infinite: endless. A layer lies below those
  /// before it that it meets; where they are not, it reaches up into their place.
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  std::vector<SweepRange> unbonded = {};  ///< where it has come off what lies below it
  double unbonded_friction = 0;
  /// Thickness over y of the body's profile; not empty: in place of the width, and `thickness` is the largest.
  std::vector<TablePoint> across = {};
  bool rows_follow = false;  ///< the rows of elements follow `across`; else they are level and elements take a material
  bool ends() const { return std::isfinite(from) || std::isfinite(to); }
  double low() const { return across.empty() ? -0.5 * width : across.front().at; }
  double high() const { return across.empty() ? 0.5 * width : across.back().at; }
  double thickness_at(double y) const { return y > low() && y < high() ? over_table(across, y, thickness) : 0; }
};

/// Rows of elements through a layer on elements of size h.
int layer_rows(const LayerMesh& layer, double h);

/// Sizes shared by both bodies, metres.
struct MeshSizes {
  double element = 1e-3;      ///< h: edge length at the running surface and in the studied subsurface
  double fine_width = 24e-3;  ///< lateral width of the fine cap, centred on the contact point
  double fine_depth =
      8e-3;  ///< depth of the fine cap (made deeper where the layers ask for it, at most the band that fits)
  int coarse_ratio = 3;    ///< station spacing of the rest in the fine range / h
  double largest = 12e-3;  ///< largest element edge far from the contact
  bool to_sides = false;   ///< of a section alone: fine columns may go on from the running surface down its sides
};

/// Rail: section from its profile (head, web, foot on the base) or a rectangular block under the profile; extruded from
/// x_begin - end_length to x_end + end_length, stations of spacing h between x_begin and x_end in the cap, coarse_ratio
/// * h in the rest, growing outside. Section in the model frame (canted), origin (0,0,0).
struct RailMeshSpec {
  RailShape shape = RailShape::rail;
  RailSection section = RailSection::CN60;  ///< below the head of the shape rail
  double contact_s = 0;                     ///< profile arc length of the contact point: centre of the fine cap
  double x_begin = 0, x_end = 0;
  double end_length = 0.12;
  double block_width = 0.06, block_height = 0.06;  ///< shape block only
  std::vector<LayerMesh> layers;
  std::vector<double> planes;  ///< m, where a layer begins or ends: node planes stand there
};
SweptBody mesh_rail(const Profile& profile, const TrackGeometry& track, const RailMeshSpec& spec,
                    const MeshSizes& sizes);

/// Rail that is a disc, its axle parallel to y at the depth `radius` below the origin, as wide as its profile;
/// block_height is the thickness of the ring, down to the bore. It is a wheel that stands on its head: revolved about
/// the axle, station angles pi - x/radius. Rails without a cant. Throws CaseError if the way is longer than a turn.
SweptBody mesh_ring_rail(const Profile& profile, double radius, const RailMeshSpec& spec, const MeshSizes& sizes);

/// Wheel: full ring of rim, web and hub (or a disc: rim of constant inner radius down to the bore) revolved about the
/// axle. Angles theta = arc / rolling radius; cap stations of spacing h between theta_begin and theta_end, growing
/// outside, or all round where these angles are a whole turn or nearly one apart; the web and hub have their own,
/// coarser stations so that the bore does not limit the time step. Section coordinates relative to the axle; origin =
/// axle centre in the model frame.
struct WheelMeshSpec {
  WheelShape shape = WheelShape::wheel;
  double contact_s = 0;
  double theta_begin = 0, theta_end = 0;
  WheelSection section;
  std::vector<LayerMesh> layers;
  std::vector<double> planes;  ///< rad, as RailMeshSpec's
};
SweptBody mesh_wheel(const Profile& profile, double wheel_radius, Vec3 axle, const WheelMeshSpec& spec,
                     const MeshSizes& sizes);

}  // namespace railstrata
