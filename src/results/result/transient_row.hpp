#pragma once
// One state of a transient: a row of history.csv.
#include "bem/transient.hpp"

namespace railstrata {

/// Forces on the wheel, as in a summary.
struct TransientLoads {
  double load = 0;                             ///< N, wanted
  double F_x = 0, F_y = 0, F_z = 0;            ///< N, model frame
  double normal_force = 0, lateral_force = 0;  ///< N, contact plane
  double spin_moment = 0;                      ///< N m
};

/// What does not apply is NaN: creepages of a shift, displacements of what rolls.
struct TransientMotion {
  double creepage_x = 0, creepage_y = 0, spin = 0;  ///< 1, 1, 1/m
  double displacement_x = 0, displacement_y = 0;    ///< m
  double approach = 0;                              ///< m
};

struct TransientRow : TransientLoads, TransientMotion {
  int step = 0;
  double distance = 0, time = 0;                           ///< m; s
  double p_max = 0, q_max = 0;                             ///< Pa
  double contact_area = 0, stick_area = 0, slip_area = 0;  ///< m², of cells
  double friction_power = 0;                               ///< W; of a shift NaN
  double friction_work = 0;                                ///< J, since the start
};

TransientRow transient_row(const TransientState& state);

/// "after 25 mm of rolling from rest".
std::string state_text(const CaseSpec& spec, const TransientState& state);

}  // namespace railstrata
