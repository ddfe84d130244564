#pragma once
// One pass of a steadily rolling load over a body that yields, in one non-linear solution.
//
// In the frame of the load everything is steady: d/dt = -V d/dx, so that the history of a material point is what stands
// along its streamline, a straight line y, z = const of the undeformed body. [DangVanMaitournam1993] Strain at a point:
//
//   E(x, y, z) = e_contact(x, y, z) + e_residual(x, y, z) + e_before(y, z)
//
// e_contact: elastic, of the tractions of the contact, which are given (passes/following_contact.hpp finds those that
// go along with the yielding; PassResult::surface is what it needs). e_before: what the
// plastic strain of earlier passes, uniform along x, leaves in equilibrium. e_residual: the elastic answer to what this
// pass adds to it (plastic_strain_response.hpp). The law (material/plastic.hpp) takes E along every streamline and
// gives plastic strain, plastic strain gives e_residual: a fixed point, found with Anderson's acceleration.
//
// The law takes steps of first order, and a contact has sharp edges near the surface, so it is taken at more places
// than there are stations (SteadyGrid::path()): e_contact is given there, e_residual is a cubic between stations, and a
// station's plastic strain is the mean of its places. Neighbouring columns of a row go through the law together.
//
// Assumptions: a straight rail, layers without sideways ends on a half-space; small strains; the rail is endless and
// does not grow longer.
#include <array>
#include <vector>

#include "core/array.hpp"
#include "core/control.hpp"
#include "core/simd.hpp"
#include "material/plastic.hpp"
#include "steady/plastic_strain_response.hpp"
#include "steady/steady_grid.hpp"

namespace railstrata {

inline constexpr int kStreamlineHistory = kPlasticHistory<kMostBackstresses>;

/// A row of depth: what it is and how it yields; an infinite yield strength: it does not.
struct SteadyRow {
  RowModuli moduli;
  PlasticParameters<double> law;
};

/// State that a pass hands on to the next.
struct PassState {
  int passes = 0;
  std::vector<double> history;  ///< per point of the section (SteadyGrid::point) kStreamlineHistory numbers
  Field residual_strain;        ///< e_residual of the last pass (SteadyGrid::active_size), the next one's first guess
  Field rise;  ///< m, displacement of the surface that the last pass has added, as of PassResult::surface
};

/// Moves the first guess along with a load that runs so many columns to the side of the last one.
void move_guess(const SteadyGrid& grid, int columns, PassState& state);

/// Changes by one pass at the points of the section (SteadyGrid::point).
struct PassResult {
  int iterations = 0;
  double error = 0;                 ///< largest change of stress of the last iteration over the shear strength
  bool converged = true;            ///< error within the tolerance
  double late_flow = 0;             ///< largest p of the last quarter behind the load, over the largest Δp
  std::vector<double> accumulated;  ///< plastic strain p of this pass, Δp
  std::vector<double> net;          ///< net_strain (steady/pass_class.hpp)
  std::vector<std::array<double, 6>> residual_stress;  ///< Pa, after the pass, xx, yy, zz, xy, yz, xz
  std::vector<std::array<double, 6>> plastic_strain;   ///< E^p after the pass
  std::vector<double> forward, lateral;  ///< m, per column: displacement of the surface over the yielding rows' foot,
                                         ///< since the first pass; forward: along the travel of the load
  std::vector<double> sinking;           ///< m, per column, downward
  std::vector<double> before;            ///< history ahead of the load, as of PassState
  Field surface;  ///< m, displacement of the surface by plastic strain since the first pass, at stations and columns,
                  ///< as of PlasticStrainResponse::apply
};

/// A point of the section at a place of its streamline.
struct StationState {
  std::array<double, 6> strain{}, stress{};  ///< tensor shears; Pa
  double accumulated = 0;                    ///< plastic strain p over all passes
};

struct PassLimits {
  double tolerance = 1e-4;  ///< of the shear strength
  int iterations = 400;
  const Control* control = nullptr;  ///< asked to stop, the pass is given up between two iterations
};

/// Four stations around a place of the path, and their weights.
struct Between {
  int station[4];
  double weight[4];
};

/// A ball around the deviators of strain that a point of the section goes through, sizes as √(2/3 e:e).
struct StrainBall {
  std::array<double, 6> middle{};
  double radius = 0;
  int first = 0, last = 0;  ///< places of the path before and from which on it is far below the strength
};

/// The strain of a contact as the law takes it.
struct ContactPath {
  std::vector<StrainBall> balls;  ///< per point of the section
  Field strain;                   ///< columns that go through the law together side by side, place after place
};

/// A body and its grid; constant, but one pass at a time.
class SteadyBody {
 public:
  /// rows: of the grid's rows; below: what is under them, elastic. initial_stress: Pa, of the process, per row, in
  /// equilibrium by itself (along x and y alone); empty: none.
  SteadyBody(const SteadyGrid& grid, std::vector<SteadyRow> rows, RowModuli below,
             std::vector<std::array<double, 2>> initial_stress = {});

  const SteadyGrid& grid() const { return response_.grid(); }
  const std::vector<SteadyRow>& rows() const { return rows_; }
  PassState virgin() const;
  /// Displacement of the surface (as of PassResult) by what the state holds and a pass as the last one.
  Field surface_expected(const PassState& state) const;

  /// The next pass under the strain of a contact (active_size() of SteadyGrid::path(); tensor shears). The state
  /// advances; where the pass has not converged too, as the result states. Throws NumericalError at a strain that is no
  /// number; Interrupted when it is given up, the state is then as it was.
  PassResult run_pass(const Field& contact_strain, PassState& state, const PassLimits& limits = {}) const;
  /// The same within a wider body that is uniform along x: `before` (six components by point of the section) is the
  /// strain there by what earlier passes have left; `contact`: path_of its strain. After the first pass rows where no
  /// point comes near its yield strength are left out. Without iterations the first guess is taken as it is and stays;
  /// else that of the next pass is of one more iteration. What the result has beyond histories and strains is empty.
  PassResult run_pass_within(const Field& before, const ContactPath& contact, PassState& state,
                             const PassLimits& limits = {}) const;
  ContactPath path_of(const Field& contact_strain) const;
  /// The way of points of the section through the pass that `result` and `state` are of, at the places of the path in
  /// their order.
  std::vector<std::vector<StationState>> streamlines(const Field& contact_strain, const PassResult& result,
                                                     const PassState& state,
                                                     const std::vector<std::size_t>& points) const;
  /// Strain of an elastic stress of the contact, xx, yy, zz, xy, yz, xz, in a row.
  std::array<double, 6> strain_of(int row, const std::array<double, 6>& stress) const;
  /// The other way round, Pa.
  std::array<double, 6> stress_of(int row, const std::array<double, 6>& strain) const;

 private:
  struct Work;
  std::vector<StrainBall> balls_of(const Field& contact_strain) const;
  void follow(const ContactPath& contact, const PassState& state, Work& work) const;
  struct Columns;
  struct Surroundings;
  double largest_excess(const Columns& columns, const std::vector<StrainBall>& balls, const Surroundings& around,
                        const std::vector<double>& history) const;
  bool rests(const Columns& columns, const Surroundings& around, const Pack* history) const;
  template <class Visit>
  void take_law(const Columns& columns, const ContactPath& contact, const Surroundings& around, int from, int to,
                Pack* history, Visit&& visit) const;
  double compare(Work& work) const;
  void add_section(const Field& section, Field& surface) const;
  Field uniform_strain(const std::vector<double>& history, Field* surface = nullptr) const;
  void iterate(const ContactPath& contact, PassState& state, const PassLimits& limits, Work& work,
               PassResult& out) const;
  void conclude(const std::vector<double>& before, const Field& strain, const PassState& state, PassResult& out) const;

  PlasticStrainResponse response_;
  PlasticStrainResponse section_;  // the same for what is uniform along x: one station as long as the grid
  std::vector<SteadyRow> rows_;
  std::vector<int> terms_;                             // backstresses per row
  std::vector<Between> between_;                       // of the places of the path
  std::vector<std::array<double, 6>> initial_strain_;  // per row
};

}  // namespace railstrata
