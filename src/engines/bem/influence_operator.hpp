#pragma once
// Displacements of the contacting surfaces from tractions on a grid, by convolution; and approximate inverses that
// precondition the solvers.
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "bem/patch_grid.hpp"
#include "bem/plane_fft.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

struct CaseSpec;
struct Placement;
class RowsDifference;
class SectionStore;

/// Linear operator of a pair of bodies (combined_compliance) on nx x ny cells of dx x dy. All planes have index j + ny
/// i. Tractions Pa, displacements m. Costs: one plane in and out about 0.16 ms for 100 x 100 cells on one core. Const
/// members may be called from several threads at once.
class InfluenceOperator {
 public:
  /// film: what a third-body layer between the surfaces adds to the displacement by traction of a cell itself [m/Pa],
  /// ThirdBody::flexibility.
  /// line: plane strain (halfspace/line_contact.hpp), ny = 1.
  InfluenceOperator(const SurfaceCompliance& pair, int nx, int ny, double dx, double dy, double film = 0,
                    bool line = false);

  /// The same with what the sections of the bodies add. wheel: alone; curvature: of its surface along x, 1/m.
  InfluenceOperator(std::shared_ptr<const InfluenceOperator> flat, std::shared_ptr<const RowsDifference> rows,
                    std::shared_ptr<const InfluenceOperator> wheel, double curvature);

  /// The same of rows that turn: `turn` is the angle of each row's normal, rad, [j], and rows follow each other by arc
  /// length. A traction moves the surface along its own direction, wherever that is looked at; pressure and traction
  /// across couple by the mean of their influences.
  InfluenceOperator(const InfluenceOperator& flat, const Plane& turn);

  int nx() const { return fft_.nx(); }
  int ny() const { return fft_.ny(); }
  /// Displacement at (i dx, 0), i = 0 or 1, from the centre of a cell under unit traction.
  const RectangleInfluence& of_one_cell(int i) const { return near_[i]; }
  double film() const { return film_; }  ///< m/Pa
  /// Normal and tangential problems interact: not for half-spaces of equal bodies.
  bool couples() const { return rows_ || !spectra_->nx.empty() || turns(); }

  /// Normal elastic displacement u_n = u_z'(rail) + u_z'(wheel) by pressure, each into its body: nx x ny.
  void normal(const double* p, double* u_n) const;
  /// Rail minus wheel, from tangential tractions. rows = nx, or nx + 1 for one more row of cells ahead of the grid.
  void tangential(const double* q_x, const double* q_y, double* u_x, double* u_y, int rows) const;
  PlanePair tangential(const Plane& q_x, const Plane& q_y, int rows) const;
  /// Rail minus wheel, from pressure.
  PlanePair tangential_from_pressure(const Plane& p, int rows) const;
  /// Normal elastic displacement by tangential tractions.
  Plane normal_from_traction(const Plane& q_x, const Plane& q_y) const;
  /// Of sections: slip along x, over V, of a wheel whose surface moves by u_n towards the axle and so is shorter, u_n
  /// over its radius. Pressure and weights of slip change places (Betti).
  bool stretches() const { return wheel_ != nullptr; }
  Plane stretch_of_wheel(const Plane& p, int rows) const;
  /// The same by centrifugal force at this speed [m/s], of each row of cells: below 0, the wheel widens.
  Plane stretch_by_rotation(double speed) const;
  /// Of a rail's section on springs: strain of its running surface by bending under a vertical load, 1/N; else 0.
  double stretch_by_load() const;

  /// Approximate inverses of `normal` and `tangential`: the inverses on the periodic grid, symmetric positive definite.
  void precondition_normal(const double* u_n, double* p) const;
  void precondition_tangential(const double* u_x, const double* u_y, double* q_x, double* q_y) const;

  /// The same pair and cells for planes of nx x ny, at most as many: made once for each size and kept, up to some.
  /// first_y: their first row of this one's, which sections and rows that turn ask for.
  std::shared_ptr<const InfluenceOperator> part(int nx, int ny, int first_y) const;

 private:
  /// Of tables that are odd in x or y imaginary parts (nx, ny); inverses of the periodic grid.
  struct Spectra {
    std::vector<double> nn, xx, xy, yy, nx, ny;
    std::vector<double> inv_nn, inv_xx, inv_xy, inv_yy;
  };
  InfluenceOperator(const InfluenceOperator& whole, int nx, int ny, int first_y);
  void make_spectra(std::vector<RectangleInfluence> table, bool couples);
  bool turns() const { return !cosine_.empty(); }
  void set_turns(const Plane& cosine, const Plane& sine);
  void turned_tangential(const double* q_x, const double* q_y, double* u_x, double* u_y, int rows) const;
  /// by_row times the scalar product of by_row times `in`, which is added to out.
  void add_component(const Plane& by_row, const double* in, const std::vector<double>& spectrum, double* out,
                     int rows) const;
  /// ∑ of sin(turn_i - turn_j) times the mean influence, index i of the rows of the result.
  Plane across_turns(const double* in, int rows) const;
  PlaneFft fft_;
  double film_;
  Plane plane_of(int rows) const { return Plane(static_cast<std::size_t>(rows) * static_cast<std::size_t>(ny())); }
  RectangleInfluence near_[2];
  std::vector<RectangleInfluence> table_;  // of the padded plane, without a film: index j + (my/2 + 1) i
  mutable std::mutex parts_mutex_;
  struct Part {
    int first_y;
    std::shared_ptr<const InfluenceOperator> op;
  };
  mutable std::vector<Part> parts_;
  std::shared_ptr<const Spectra> spectra_;
  Plane cosine_, sine_;                                    // of each row's turn; empty: a plane
  std::vector<double> mean_hat_;                           // of nn and yy, of rows that turn
  std::shared_ptr<const InfluenceOperator> flat_, wheel_;  // null: half-spaces
  std::shared_ptr<const RowsDifference> rows_;
  double curvature_ = 0;
};

/// The bodies whose sections are meant, in the plane of `placement`; both are kept by reference during a call.
struct SectionsAsked {
  const CaseSpec& spec;
  const Placement& placement;
};

/// Influence operators of earlier solutions: cases of a sweep share bodies and grid. Safe to share between threads.
class InfluenceCache {
 public:
  InfluenceCache();
  /// film: flexibility of a third-body layer, m/Pa.
  std::shared_ptr<const InfluenceOperator> get(const LayeredHalfSpace& wheel, const LayeredHalfSpace& rail,
                                               const PatchGrid& grid, double film = 0);
  /// With the sections of the bodies (bem.bodies).
  std::shared_ptr<const InfluenceOperator> get(const LayeredHalfSpace& wheel, const LayeredHalfSpace& rail,
                                               const PatchGrid& grid, double film, const SectionsAsked& sections);
  const std::shared_ptr<SectionStore>& sections() const { return sections_; }

 private:
  /// rail: null: of the wheel alone.
  std::shared_ptr<const InfluenceOperator> flat(const LayeredHalfSpace& wheel, const LayeredHalfSpace* rail,
                                                const PatchGrid& grid, double film);
  struct Entry {
    LayeredHalfSpace wheel;
    std::optional<LayeredHalfSpace> rail;
    PatchGrid grid;
    double film;
    SurfaceCompliance pair;
    std::shared_ptr<const InfluenceOperator> op;
  };
  std::mutex mutex_;
  std::list<Entry> entries_;  // most recently used first
  std::shared_ptr<SectionStore> sections_;
};

}  // namespace railstrata
