#pragma once
// The band of elements under a running surface: columns by arc length, rows along the surface normal, so that layers
// have their exact thickness everywhere.
#include <utility>
#include <vector>

#include "mesh/bodies.hpp"
#include "mesh/section_grid.hpp"

namespace railstrata {

/// Depths of the node rows below the surface, from 0, and the material of every row of elements (0 matrix, k the k-th
/// layer).
struct BandRows {
  std::vector<double> depth;
  std::vector<int> material;
  int count() const { return static_cast<int>(material.size()); }
};

/// Rows of the layers, then rows of height h to fine_depth (or, where that is deeper, two rows or the last layer row's
/// height below the layers), never below `limit`; neighbouring rows differ by a factor of at most about 2. Throws
/// CaseError when the layers reach below `limit`; `carrier` names what carries them ("head", "rim").
BandRows band_rows(const std::vector<LayerMesh>& layers, double h, double fine_depth, double limit,
                   const char* carrier);
/// The same with rows of one material merged up to the given height: the band beside the fine columns.
BandRows merged_rows(const BandRows& rows, double height);

/// Reach of a kink of the profile to both sides, see offset_point.
inline constexpr double kKinkHalfWidth = 2.5e-3;

/// Arc lengths between which the running surface is inclined by less than `angle` [rad], seen from the middle of the
/// profile; short of a kink that ends it.
std::pair<double, double> running_range(const Profile& profile, double angle);
/// Smallest radius of convex curvature in [s0, s1], measured over 4 mm of arc so that the noise of measured profiles
/// does not count.
double smallest_convex_radius(const Profile& profile, double s0, double s1);

/// Arc lengths of the fine columns: spacing h over fine_width, centred on contact_s, moved inside [range.first,
/// range.second] where it would leave it. Throws CaseError when fine_width is larger than the range or the contact
/// point too close to its end.
std::vector<double> fine_columns(double contact_s, double h, double fine_width, std::pair<double, double> range,
                                 const char* body);

/// Depths of the node rows at the lateral position y: those of `rows`, and of layers with rows that follow them moved
/// with the layers' thickness there.
std::vector<double> depths_at(const BandRows& rows, double y, const std::vector<LayerMesh>& layers);

/// Arc lengths at which layers end, within the profile. Throws CaseError for a layer wider than the
/// profile.
std::vector<double> layer_edges(const Profile& profile, const std::vector<LayerMesh>& layers, const char* carrier,
                                double carrier_width);

/// Point at a depth below the surface along the normal; s is clamped to the profile (round-off at its ends). Near a
/// kink of the profile the direction turns gradually over kKinkHalfWidth on both sides, so that columns do not cross;
/// the depth is still measured along the surface's own normal.
Vec2 offset_point(const Profile& profile, double s, double depth);

/// Adds the grid of offset points to a section: node rows from the surface down, each with one node per column.
/// Quadrilaterals in the order of ContactBand, with the material of their row where the layer is wide enough, else
/// matrix; of layers that vary across with that of their middle.
std::vector<NodeLine> add_band(Section& section, const Profile& profile, const std::vector<double>& s,
                               const BandRows& rows, const std::vector<LayerMesh>& layers);

/// Material of a row at the lateral position y.
int material_at(const BandRows& rows, int row, double y, const std::vector<LayerMesh>& layers);

/// Moves the bottom nodes of a band along their columns onto the polyline of the master nodes, where that changes the
/// last row by less than a fifth.
void seat_on_line(Section& band, const std::vector<NodeLine>& rows, const std::vector<Vec2>& line);

/// "matrix" and the layers' names.
std::vector<std::string> material_names(const std::vector<LayerMesh>& layers);
/// SweptBody::material_layer of these.
std::vector<int> material_layers(const std::vector<LayerMesh>& layers);

/// Column of a node line.
NodeLine column_of(const std::vector<NodeLine>& rows, std::size_t column);

}  // namespace railstrata
