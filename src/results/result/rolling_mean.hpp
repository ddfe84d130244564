#pragma once
// The mean of the samples taken around a wanted position, in the frame that moves with the wheel.
#include "contact/contact_field.hpp"
#include "fem/rolling_run.hpp"
#include "result/patch.hpp"

namespace railstrata {

struct MeanContact {
  double position = 0;
  ContactField field;
  PatchMeasures patch;       ///< of the mean field
  double p_max_scatter = 0;  ///< standard deviation / mean of the samples' p_max
  double F_x = 0, F_y = 0, F_z = 0;
  double creepage = 0, lateral_creepage = 0, spin_per_m = 0;
  BandSample rail, wheel;  ///< mean stresses and displacements
};

/// Throws NumericalError when there is no sample.
MeanContact mean_contact(const RollingSystem& system, const PositionSamples& samples);

/// The contact field of a single sample.
ContactField contact_field(const RollingSystem& system, const RollingSample& sample);

}  // namespace railstrata
