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
// knock.
//
// Search: both surfaces are sweeps, so the wheel's facet under a rail point follows from the wheel's angle; a small
// tangential correction is carried from step to step.
#include "contact/surface.hpp"
#include "core/array.hpp"

namespace railstrata {

/// Rigid position of the axle: displacement from the start and rotation psi (positive rolling forward).
struct AxlePose {
  double x = 0, z = 0, psi = 0;
};

/// One rail node that may be in contact.
struct ContactRow {
  int column, station;  ///< on the rail's surface
  std::ptrdiff_t rail;  ///< index of component x in the rail's fields
  int first, count;     ///< range in MortarRows::weights
  double area;          ///< a_A, m²
  double gap;           ///< g_A, m, negative: penetration
  Vec3 normal;          ///< out of the rail
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

  /// Chooses the rail nodes whose gap is below `reach` (m) within `half_length` (m) of the axle; call it every few
  /// steps, before rows().
  void search(const Field& u_rail, const Field& u_wheel, const AxlePose& pose, double half_length, double reach);
  /// Gaps and weights of the chosen nodes at the present positions. The result is reused by the next call.
  const MortarRows& rows(const Field& u_rail, const Field& u_wheel, const AxlePose& pose);

  struct Facet {
    int column, station;
    Vec2 correction[4];  ///< tangential (x, y) mismatch of the last step at the Gauss points
  };
  /// All that a search remembers of what came before it.
  const std::vector<Facet>& memory() const { return facets_; }
  /// To be followed by a search.
  void recall(std::vector<Facet> memory) { facets_ = std::move(memory); }

 private:
  struct Hit {                  // the wheel's surface opposite a rail point
    int column, station;        // facet
    double weight_y, weight_t;  // bilinear coordinates in it
    Vec3 offset;                // x_wheel - x_rail
    bool inside;                // within the wheel's contact band
  };
  Vec3 rail_point(const Field& u, int column, int station, double weight_y, double weight_x) const;
  Hit opposite(const Field& u_wheel, const AxlePose& pose, Vec3 point, Vec2 correction) const;
  int wheel_station(double theta, double& weight) const;

  void turn_to(double psi);
  void reserve_window();

  ContactSurface rail_, wheel_;
  std::vector<double> sin_t_, cos_t_;  // of the wheel's stations
  double cos_psi_ = 1, sin_psi_ = 0;
  std::vector<int> chosen_column_, chosen_station_;
  std::vector<Facet> facets_;
  struct GaussHit {
    Hit hit[4];
  };
  std::vector<GaussHit> hits_;
  std::vector<int> facet_of_;      // dense map over the search window
  std::vector<char> near_, edge_;  // of the search, and the facets that it found before
  std::vector<Facet> before_;
  int window_first_ = 0, window_stations_ = 0;
  MortarRows result_;
  std::vector<double> scratch_;
};

}  // namespace railstrata
