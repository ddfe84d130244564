#pragma once
// The contact on a device: both surfaces, the rows of a step and what is kept from step to step. Views; the arrays are
// in device/contact_arrays.hpp.
//
// Rows stand in slots: node (c, j) of the rail that the last search looked at has slot (j - window_first) * inner + c -
// 1; a slot whose node was not chosen is passed over. The wheel's nodes around the contact, the band, count stations
// from band_first on: [station * columns + column].
#include "contact/enforcement_law.hpp"
#include "contact/mortar_law.hpp"
#include "device/body_kernels.hpp"

namespace railstrata::device {

/// A running surface (contact/surface.hpp).
struct SurfaceView {
  struct Stations {
    View<const double> at;
    RAILSTRATA_POINTWISE int nodes() const { return static_cast<int>(at.size()); }
  };
  Vec3 origin;
  Rotation<double> yaw;
  int columns = 0, stride = 0;
  std::ptrdiff_t first_line = 0;
  Stations stations;
  View<const Vec2> node, outward, sagitta;
  View<const double> width;
  View<const double> sine, cosine;  ///< of the stations' angles, of a wheel
  RAILSTRATA_POINTWISE std::ptrdiff_t index(int column, int station) const {
    return first_line + static_cast<std::ptrdiff_t>(column) * 3 * stride + station;
  }
};

/// Chains of added mass that begin on a surface.
struct SurfaceChains {
  View<const int> at;  ///< by column, -1: none
  ChainTables tables;
};

/// A row of the contact (contact/mortar.hpp) and its patch of the band.
struct RowRecord {
  double area, gap, compliance;
  int column, first;      ///< of the patch: the wheel's column, the band's station
  int columns, stations;  ///< none: the node is not chosen
  int fault;
};

/// How the contact is enforced (contact/enforcement.hpp).
struct EnforcementTables {
  RowLaw law;
  int max_sweeps;
  double tolerance;  ///< m
};

/// Where it is searched.
struct SearchLimits {
  double half_length, gap;  ///< m
  double reach;             ///< rad, of the band before the axle
};

/// Results of the search at the slots.
struct FoundNodes {
  View<int> near, at_edge;
};

/// State that is kept from step to step.
struct KeptContact {
  View<NodeTraction> tractions;  ///< [column * stations + station]
  View<Tangential> corrections;  ///< of the rail's facets, [(station * columns + column) * 4 + Gauss point]
  View<int> active;              ///< of the rail's facets: a chosen node is their corner
};

/// Nodes of a surface in a step: velocities before and after it [m/s], forces [N], answers to an impulse [1/kg].
struct SurfaceNodes {
  View<Vec3> before, after, force;
  View<double> answer;
};

/// Terms of the sums over rows: [of kRowNumbers][slot], [of kRowNumbers][part].
struct RowTotals {
  View<double> numbers, parts;
};

struct ContactTables {
  SurfaceView rail, wheel;
  EnforcementTables enforcement;
  SearchLimits search;
  int inner;                ///< columns of the rail that may be chosen
  int apart;                ///< independent_distance (contact/mortar.hpp)
  int window, band, patch;  ///< room for: stations of the window, of the band; wheel nodes of a row
  KeptContact kept;
  FoundNodes found;
  // of a step
  View<mortar_law::Hit> hits;  ///< of the window's facets and a station before, as corrections
  View<RowRecord> rows;
  View<double> weights;  ///< m_AW, [slot * patch + station * columns + column]
  View<RowStart> starts;
  View<int> slips;
  View<double> changes;                  ///< m/s, of a sweep
  SurfaceNodes rail_nodes, wheel_nodes;  ///< by slot; of the band
  RowTotals totals;

  RAILSTRATA_POINTWISE int slots() const { return window * inner; }
  RAILSTRATA_POINTWISE int column_of(int slot) const { return slot % inner + 1; }
  RAILSTRATA_POINTWISE int station_of(int slot, const StepState& now) const { return now.window_first + slot / inner; }
  RAILSTRATA_POINTWISE Vec3 normal(int column) const { return {0, rail.outward[column].y, rail.outward[column].z}; }
  RAILSTRATA_POINTWISE NodeTraction& traction(int column, int station) const {
    return kept.tractions[static_cast<std::ptrdiff_t>(column) * rail.stations.nodes() + station];
  }
};

/// Numbers of a row. Summed: force x, y, z, losses in friction and normal, whether it carries; then those whose
/// largest value is wanted: penetration, pressure.
inline constexpr int kRowSums = 6, kRowNumbers = 8;
inline constexpr int kRowParts = 64;  ///< that the rows are summed in

}  // namespace railstrata::device
