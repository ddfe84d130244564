#pragma once
// Surface-to-surface contact of a wheel rolling on a rail: search, weighted gaps and the rows that couple a rail node
// to the wheel.
//
// The rail's surface nodes carry the contact traction with dual (biorthogonal) shape functions [Wohlmuth2000],
// [PusoLaursen2004]:
//   gap        g_A  = (1/a_A) int psi_A (x_wheel - x_rail) . n_A dA           a_A = int N_A dA
//   velocity   w_A  = sum_W m_AW v_W - v_A,   m_AW = (1/a_A) int psi_A N_W dA   (wheel relative to rail)
//   forces     on rail node A:  a_A tau_A,   on wheel node W:  - sum_A a_A m_AW tau_A     (tau: traction on the rail)
// so a uniform pressure passes through non-matching meshes exactly, momentum is conserved, and the rail's side stays
// diagonal. Integrals use 2 x 2 Gauss points on the rail's facets. Gaps are those of the exact profiles and of the
// exact circle of revolution, displaced by the interpolated nodal displacements: the facets of a polygonal wheel do not
// knock. Heights along either surface (geometry/height_field.hpp) are added at every Gauss point, along the normal of
// the profile; a row's normal is tilted by the slope of the rail's height at its node.
//
// A yawed wheel is met in its own axes: rail points, normals and the axle's travel are turned back about the vertical
// through the axle's start, and all that follows is that of a straight wheel. A rail that is a ring has its points and
// normals on circles about its own axle, as the wheel has.
//
// Search: both surfaces are sweeps, so the wheel's facet under a rail point follows from the wheel's angle; a small
// tangential correction is carried from step to step.
#include <array>

#include "contact/mortar_law.hpp"
#include "contact/surface.hpp"
#include "core/array.hpp"
#include "core/rotation.hpp"

namespace railstrata {

/// One rail node that may be in contact.
struct ContactRow {
  int column, station;  ///< on the rail's surface
  std::ptrdiff_t rail;  ///< index of component x in the rail's fields
  int first, count;     ///< range in MortarRows::weights
  double area;          ///< a_A, m²
  double gap;           ///< g_A, m, negative: penetration
  Vec3 normal;          ///< out of the rail
  Vec3 on_wheel;        ///< the same in the wheel's axes, which the yaw turns
};

struct WheelWeight {
  std::ptrdiff_t wheel;  ///< index of component x in the wheel's fields
  double m;
};

struct MortarRows {
  std::vector<ContactRow> rows;
  std::vector<WheelWeight> weights;
  bool reached_edge = false;  ///< a node at the border of the fine zone (of either body) would be in contact
};

class MortarContact {
 public:
  MortarContact(ContactSurface rail, ContactSurface wheel);

  const ContactSurface& rail() const { return rail_; }
  const ContactSurface& wheel() const { return wheel_; }

  /// Displacements are those of the model frame, for the wheel in its own axes; the pose is that of the model frame.

  /// Chooses the rail nodes whose gap is below `gap_limit` (m) within `half_length` (m) of the axle; call it every few
  /// steps, before rows().
  void search(const Field& u_rail, const Field& u_wheel, const AxlePose& in_model, double half_length,
              double gap_limit);
  /// Gaps and weights of the chosen nodes at the present positions. The result is reused by the next call.
  /// In groups that share no wheel node, one after the other: nodes of equal remainder of column and station by
  /// independent_distance. So sweeps over the rows may go through a group in any order, or in threads.
  const MortarRows& rows(const Field& u_rail, const Field& u_wheel, const AxlePose& in_model);

  /// A facet of the rail with a chosen node at one of its corners.
  struct Facet {
    int column, station;
    Tangential correction[4];  ///< m, mismatch of the last step at the Gauss points
  };
  /// All that a search takes over from those before it.
  const std::vector<Facet>& facets() const { return facets_; }
  /// Puts back what facets() gave; to be followed by a search.
  void restore(std::vector<Facet> facets) { facets_ = std::move(facets); }

 private:
  using Hit = mortar_law::Hit;
  using WheelPatch = mortar_law::WheelPatch;

  Vec3 rail_point(const Field& u, int column, int station, double weight_y, double weight_x) const;
  Vec3 rail_normal(int column, int station) const;
  SurfaceHeight rail_height(int column, int station, double weight_y, double weight_x) const;
  void raise_wheel(const AxlePose& pose, Hit& hit) const;
  void turn_to(const AxlePose& pose);
  Vec3 gauss_point(const Field& u_rail, const Facet& facet, int g) const;
  Hit opposite(const Field& u_wheel, const AxlePose& pose, Vec3 point, Tangential correction,
               const Hit& guess = Hit{}) const;

  void reserve_window();
  void test_nodes(const Field& u_rail, const Field& u_wheel, const AxlePose& pose, double gap_limit);
  void choose_nodes();
  void keep_corrections();
  void start_corrections(const Field& u_rail, const Field& u_wheel, const AxlePose& pose);

  void update_hits(const Field& u_rail, const Field& u_wheel, const AxlePose& pose);
  std::size_t facet_at(int column, int station) const;
  int facet_index(int column, int station) const { return facet_of_[facet_at(column, station)]; }
  void choose_node(int column, int station);
  /// Facets of which a node is the corner (1, 1), (0, 1), (1, 0), (0, 0).
  std::array<int, 4> facets_around(int column, int station) const;
  void integrate_row(std::size_t row);
  void append_weights(std::size_t row);

  ContactSurface rail_, wheel_;  // width of a ring: area of its facets per unit of the sweep coordinate
  struct Turn {
    std::vector<double> sin, cos;  // of the stations
    double psi = 0;
    Rotation<double> by;  // psi
  };
  Turn wheel_turn_, rail_turn_;                 // the latter of a rail that is a ring
  int window_first_ = 0, window_stations_ = 0;  // rail stations that the last search looked at
  int inner_columns_ = 0;                       // of the rail: the outermost are tied to the coarser mesh
  int apart_ = 1;                               // columns or stations between rows that share no wheel node
  std::vector<char> near_, edge_;               // nodes of the window, [station * inner_columns_ + column - 1]
  std::vector<int> chosen_column_, chosen_station_;
  std::vector<Facet> facets_, before_;    // of this search and of the one before
  std::vector<int> facet_of_;             // index in facets_ or -1, over the window and a station more at either end
  std::vector<std::array<Hit, 4>> hits_;  // at the Gauss points of facets_
  MortarRows result_;
  struct RowPatch {
    WheelPatch on;
    std::size_t first_sum;
  };
  std::vector<RowPatch> patches_;  // of the rows
  std::vector<double> sum_;        // their weights, not yet divided by the area
};

}  // namespace railstrata
