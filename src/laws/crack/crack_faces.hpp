#pragma once
// The faces of a straight crack under stresses that move: open, stuck or slipping, point by point.
//
// The tractions at the collocation points (crack_rule.hpp) are those of the body without the crack less S g, g the
// jumps of displacement there (normal and along the crack). Signorini's and Coulomb's conditions at each point:
//   open:  σ_n = -q, τ = 0;   closed:  g_n = 0, p = -σ_n - q >= 0;   stuck:  g_t as before;   slip:  τ = ± f p,
// q the pressure of a fluid in the crack. Slip remembers: places of the load are taken one after the other.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "crack/crack_rule.hpp"
#include "crack/plane_of_rolling.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

class CrackFaces {
 public:
  /// points: of crack_rule.
  CrackFaces(const CrackLine& line, const LayeredHalfSpace& body, int points);

  /// m from the start, of the collocation points.
  std::vector<double> places() const;
  /// Pa: the energy release rate is (K_I² + K_II²) over it.
  double modulus() const { return modulus_; }

  struct Faces {
    StressIntensity end;
    std::optional<StressIntensity> start;  ///< of a crack inside
    double open = 0, slipping = 0;         ///< shares of the length
    double volume = 0;                     ///< m², between the faces
    bool settled = true;                   ///< the conditions are met at every point
  };
  /// The next place of the load: tractions of the body without a crack at places(), Pa; the slip of the last one is
  /// remembered.
  Faces load(const std::vector<LineTraction>& applied, double friction, double fluid);

 private:
  void resist(const LayeredHalfSpace& body, int points);
  enum class State { open, stuck, forward, backward };
  Eigen::VectorXd solve(const Eigen::VectorXd& applied, double friction, double fluid) const;
  bool review(const Eigen::VectorXd& jump, const Eigen::VectorXd& traction, double friction, double fluid, bool one);

  CrackLine line_;
  const CrackRule* rule_;
  double modulus_ = 0;         ///< Pa, in plane strain; of a level crack Ē (level_crack.hpp)
  Eigen::MatrixXd stiffness_;  ///< S, Pa/m: normal components first, then those along
  std::vector<State> state_;
  Eigen::VectorXd before_;  ///< m, jumps at the last place of the load
};

}  // namespace railstrata
