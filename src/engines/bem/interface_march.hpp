#pragma once
// A patch that rolls over an interface which slides where its shear exceeds a limit.
//
// In the frame of the patch the shear is that of the loads plus K slip (interface_waves.hpp). Every step the patch goes
// on by one cell, and the slip of before, a cell farther back, changes by the ds that makes
//   ½ s·(-K s) - loads·s + Σ limit |ds|,   s = slip before + ds,
// least: Coulomb's law for a given limit, tau_b + f p with the pressure of the step before. By alternating directions
// (ADMM): one part is diagonal in waves, the other in cells. Slip stays behind where shear does not undo it. The border
// of the grid, where its periods meet, does not slide.
#include "bem/interface_waves.hpp"

namespace railstrata {

struct ShearLimit {
  double shear = 0;     ///< Pa, without pressure
  double friction = 0;  ///< of the pressure; tension counts as none
};

/// Of an interface that does not slide, on the cells of the grid.
struct InterfaceLoad {
  PlanePair shear;
  Plane pressure;
};

/// What one passage does, once the state around the patch stays as it is.
struct InterfacePassage {
  double largest = 0;  ///< m, slip of the passage, anywhere
  double left = 0;     ///< m, largest slip of the passage that stays behind
  double area = 0;     ///< m², that slips at one time, by more than a tenth of the fastest
  double work = 0;     ///< J/m, of friction
  double shear = 0;    ///< Pa, largest
};

class InterfaceMarch {
 public:
  InterfaceMarch(InterfaceWaves waves, const ShearLimit& limit, int border);

  /// Rolls until the state is steady, over slip that lies ahead (ahead()); then that is what it leaves behind.
  InterfacePassage pass(const InterfaceLoad& load);
  /// Makes what the last passage left that which lies ahead of the next one.
  void turn_to_next();

  int border() const { return border_; }
  const InterfaceWaves& waves() const { return waves_; }
  const PlanePair& slip() const { return slip_; }    ///< m, with what lay ahead
  const PlanePair& shear() const { return shear_; }  ///< Pa
  const PlanePair& rate() const { return rate_; }    ///< m per cell of rolling
  const PlanePair& ahead() const { return ahead_; }  ///< m, of each row of cells across
  PlanePair left() const;                            ///< the same behind, with what lay ahead

 private:
  void step(const InterfaceLoad& load);
  bool settle(const InterfaceLoad& load, const PlanePair& before, const Plane& bound);
  bool held(int i, int j) const;

  InterfaceWaves waves_;
  ShearLimit limit_;
  int border_;
  double hold_;
  PlanePair slip_, shear_, rate_, ahead_;
};

}  // namespace railstrata
