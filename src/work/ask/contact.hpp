#pragma once
// A wheel on a rail that is solved state by state, as a vehicle's time steps ask for it.
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ask/named.hpp"
#include "ask/next_start.hpp"
#include "ask/state.hpp"
#include "bem/contact_derivative.hpp"
#include "core/body_id.hpp"
#include "core/faults.hpp"
#include "core/vec.hpp"
#include "model/model.hpp"
#include "reader/case_file.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// Physics has no answer for inputs that are in range.
struct NoAnswer : CaseError {
  using CaseError::CaseError;
  explicit NoAnswer(const CaseError& e) : CaseError(e) {}
};

/// Whether forces can be believed.
struct Trust {
  bool checks_hold = true;
  bool beyond = false;  ///< continued from the largest approach that half-spaces bear
};
/// What a contact gives; meanings and signs are those of rs_forces (railstrata.h). NaN: does not apply.
struct Forces : Trust {
  double force_x = 0, force_y = 0, force_z = 0;
  double normal_force = 0, lateral_force = 0, spin_moment = 0;
  double creepage_x = 0, creepage_y = 0, spin = 0;
  double approach = 0, contact_angle = 0;
  double p_max = 0, q_max = 0;
  double patch_area = 0, slip_area = 0;
  double dissipation = 0;
  int patches = 0, cells = 0, iterations = 0;
};
/// In the order of rs_forces; the first kSlopes are those of rs_derivatives.
inline constexpr std::array<Named<Forces, double, int, bool>, 21> kForces{
    {{"force_x", "N", &Forces::force_x},
     {"force_y", "N", &Forces::force_y},
     {"force_z", "N", &Forces::force_z},
     {"normal_force", "N", &Forces::normal_force},
     {"lateral_force", "N", &Forces::lateral_force},
     {"spin_moment", "N m", &Forces::spin_moment},
     {"creepage_x", "", &Forces::creepage_x},
     {"creepage_y", "", &Forces::creepage_y},
     {"spin", "1/m", &Forces::spin},
     {"approach", "m", &Forces::approach},
     {"contact_angle", "rad", &Forces::contact_angle},
     {"p_max", "Pa", &Forces::p_max},
     {"q_max", "Pa", &Forces::q_max},
     {"patch_area", "m2", &Forces::patch_area},
     {"slip_area", "m2", &Forces::slip_area},
     {"dissipation", "W", &Forces::dissipation},
     {"patches", "", &Forces::patches},
     {"cells", "", &Forces::cells},
     {"iterations", "", &Forces::iterations},
     {"checks_hold", "", &Forces::checks_hold},
     {"beyond", "", &Forces::beyond}}};
inline constexpr std::size_t kSlopes = 11;
/// Derivatives of the first of kForces.
using Slopes = std::array<double, kSlopes>;

Forces forces_of(const BemResult& result, const Summary& summary);
int cells_with_pressure(const ContactField& field);

/// The linear equations of a contact's last solution; without `of`: it has none.
struct ContactEquations {
  BemOptions options;
  std::optional<ContactDerivatives> of;
};

/// The case with its profiles read once, what solutions share, and the last one. Belongs to one thread at a time.
class Contact {
 public:
  /// Throws CaseError: a case that it does not take.
  explicit Contact(const LoadedCase& loaded);
  /// With its solution and where the next one starts from: what follows has the same bits. The influence functions are
  /// shared, which several threads may use.
  Contact(const Contact&) = default;
  Contact& operator=(const Contact&) = delete;

  /// Solves the case in a state. With State::extrapolate a given approach that flattens the patch has an answer, with
  /// `beyond`; the solution is then that of the largest approach that half-spaces bear, within a tenth. A wheel that is
  /// lifted (approach <= 0, or load 0) has no forces. After an error there is no last solution. Throws CaseError,
  /// NoAnswer, NumericalError.
  Forces solve(const State& state = {});
  void drop_solution();
  /// Derivatives of the last solution by inputs of its state, one after the other. Throws CaseError: no solution, an
  /// input that is a result in it; and as solve.
  std::vector<Slopes> slopes(const std::vector<const StateMember*>& inputs);

  /// Refer to this contact, until it is asked or moved again. Null: no solution.
  std::unique_ptr<ContactEquations> equations();
  /// The case in a state, until the next call. Throws as solve.
  PlacedCase case_in(const State& state) {
    const Placement& there = set(state, here_);
    return {here_.spec, there};
  }

  /// Of the last solution. Throws CaseError: there is none, or not this patch.
  const BemPatch& patch(int index) const;
  /// Stresses below the patch of the largest pressure, points as Subsurface::at has them. Throws CaseError.
  std::vector<Sym3> stress(BodyId body, const std::vector<Vec3>& points) const;

  void set_cell(double cell);
  /// One tolerance t of all parts: t of slip, friction's force and the weight, 0.01 t of the gap.
  void set_tolerance(double t);
  /// A profile in place of the case's: points along the curve, m. Throws CaseError, and the old one stays.
  void set_profile(BodyId body, std::vector<Vec2> points);
  /// Moves the wheel to where it touches on this track (model/placement). Throws NoAnswer.
  void move_to(const TrackGeometry& track, const HeldPlace& held, const KnownPlace& known = {});

  const CaseSpec& spec() const { return spec_; }
  const Placement& placement() const { return placement_; }
  double load_tolerance() const { return options_.balance; }
  /// Null: none, or the wheel is lifted.
  const BemResult* last() const { return last_ ? &*last_ : nullptr; }
  /// Checks that fail and notes of the last solution and of its profiles, one a line.
  const std::string& remarks() const { return remarks_; }
  NextStart start;           ///< of the next solution
  bool of_wheelset = false;  ///< a part of a wheelset, which ends with it

 private:
  /// The case in a state, with a place of its own where the state moves the wheel.
  struct InState {
    CaseSpec spec;
    Placement moved;
    bool placed = false;  ///< `moved` stands where its track says
  };
  const Placement& set(const State& state, InState& out) const;
  const Placement& place(InState& out, const KnownPlace& known = {}) const;
  Forces lifted(State state);
  Forces pressed(const State& state);
  /// An approach that was refused: forces grow along the line through those of the two largest bearable ones of 10 um
  /// 1.1^k. Throws what refused it where none is.
  Forces continued(State state, const NoAnswer& refused);
  static void set_tolerance(BemOptions& options, double t);

  CaseSpec spec_;
  Placement placement_;
  InState here_, more_, less_;
  BemOptions options_;
  std::shared_ptr<InfluenceCache> cache_ = std::make_shared<InfluenceCache>();
  std::optional<BemResult> last_;
  std::optional<State> state_;  // of the last answer
  std::string remarks_;
};

}  // namespace railstrata
