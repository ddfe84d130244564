#pragma once
// A rigid wheel on several patches: its descent, the normal forces and the creepages are found together
// (several_patches.hpp has the equations).
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "bem/case_patch.hpp"
#include "bem/contact_places.hpp"
#include "bem/pressure_on_rail.hpp"
#include "bem/several_patches.hpp"
#include "halfspace/hertz.hpp"

namespace railstrata {

class WheelOnPatches {
 public:
  /// descent: of a given approach, m. Case and placement are kept by reference.
  WheelOnPatches(const CaseSpec& spec, const Placement& placement, const std::vector<PatchPlace>& places,
                 double descent, const BemOptions& options);

  /// Without friction first, which shows at little cost which patches merge; where none meet by more than `most`
  /// (PatchesMeet::reach), with friction. Starts from the neighbour's trial of this number and its solution. Returns
  /// the patches without friction. Throws as share_load.
  std::vector<BemStart> settle(std::size_t trial, double most);
  /// Of two patches those that meet most.
  std::optional<PatchesMeet> meeting() const;
  SharedLoad take();

 private:
  /// One patch of the wheel while the load is being shared.
  struct Member {
    PatchPlace place;
    Placement placement;  ///< its contact is the plane under the descent
    PatchRoom room{};
    bool turned = false;                            ///< the plane is another one than that of the grid
    HertzContact estimate{};                        ///< under the weight
    double below = 0;                               ///< h, m
    double approach = 0, laid_for = 0;              ///< m; the approach for which the grid was laid
    double normal = 0;                              ///< N, of the last solution; to begin with an estimate
    double expected = 0;                            ///< N, of the next
    double approach_before = 0, normal_before = 0;  ///< of the solution before
    CasePatch patch{};
    RollingSolution solution{};

    const RigidContact& contact() const { return placement.contact; }
    bool loaded() const;
    PressureOnRail on_rail() const { return {contact(), patch.grid, solution.normal.pressure, normal}; }
    double vertical() const;
    double stiffness() const;
    double largest_pressure(int column) const;
  };

  bool start_from(const std::vector<BemStart>& patches);
  bool surely_one() const;
  bool near_in(double share) const;
  bool approaches_settled() const;
  void lay_start(Member& m, const BemStart& start);
  std::vector<BemStart> starts() const;
  void descend();
  double vertical() const;
  Eigen::MatrixXd depressions() const;
  Eigen::VectorXd lacking_approaches(const Eigen::MatrixXd& bent) const;
  double step(const Eigen::MatrixXd& bent);
  double lay(double descent);
  double first_descent();
  void stand();
  void take_given_creepages();
  double solve_at(const Eigen::MatrixXd& bent);
  BemOptions cells_for(const Member& m, double approach) const;
  bool cells_suit();
  void lay_grid(Member& m);
  double cell_for(double semi_axis) const;
  void solve(Member& m) const;
  void solve_all();
  double sum(double TangentialSolution::*force) const;
  void balance_traction();
  template <class Excess>
  void find(SoughtCreepage& sought, Excess&& excess_now) const;
  [[noreturn]] void refuse_traction() const;

  const CaseSpec& spec_;
  const Placement& placement_;
  RigidContact reference_;
  std::vector<Member> members_;
  InfluenceCache cache_;
  BemOptions options_;
  double pressed_;  // the descent that is given, with an approach
  double weight_, modulus_;
  SoughtCreepage along_, across_;                                          // of the reference
  double descent_ = 0, stood_ = std::numeric_limits<double>::quiet_NaN();  // the planes are those of stood_
  bool rubs_ = false;                                                      // the patches have friction
  int iterations_ = 0;
};

}  // namespace railstrata
