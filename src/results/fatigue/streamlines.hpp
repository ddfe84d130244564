#pragma once
// Wear, friction energy, heat and local fatigue of the surface in one passage, per streamline across the rail, from the
// contact field of either engine.
#include <vector>

#include "contact/contact_field.hpp"
#include "damage/wear_indices.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"
#include "spec/history_spec.hpp"

namespace railstrata {

/// A column of the field: what a strip of the rail along x sees. Numbers that the case gives no data for are NaN.
struct StreamlineRow {
  double y = 0, z = 0;                    ///< m, model frame, on the rail's surface
  double width = 0;                       ///< m, across, of the surface
  double friction_energy = 0;             ///< J/m² per passage
  double usfd_depth = kNotApplicable;     ///< m per passage [LewisDwyerJoyce2004], times the steel's factor
  double archard_depth = kNotApplicable;  ///< m per passage, with the rail's wear_coefficient over its hardness
  double kth_depth = kNotApplicable;      ///< m per passage, Jendel's map, dry laboratory surfaces
  double kth_seized = 0, kth_fast = 0;    ///< m of it outside the map (damage/wear.hpp)
  double wheel_usfd_depth = kNotApplicable, wheel_archard_depth = kNotApplicable,
         wheel_kth_depth = kNotApplicable;  ///< m per turn of the wheel, with the wheel's own data
  double temperature_rise = 0;              ///< K
  double rise_lower = 0, rise_upper = 0;    ///< K, bounds of it whatever the layers' order and thickness
  double local_fatigue = kNotApplicable;    ///< largest |q|/p - k/p
  double depth(WearLaw law) const {         ///< m per passage
    return law == WearLaw::usfd ? usfd_depth : law == WearLaw::kth ? kth_depth : archard_depth;
  }
  double wheel_depth(WearLaw law) const {  ///< m per turn of the wheel
    return law == WearLaw::usfd ? wheel_usfd_depth : law == WearLaw::kth ? wheel_kth_depth : wheel_archard_depth;
  }
};

/// One row per column with contact, y ascending. Empty for a shift, which does not roll.
std::vector<StreamlineRow> streamlines(const CaseSpec& spec, const ContactField& field);

/// T-gamma of one patch, from its forces and creepages.
TGamma t_gamma(const ContactSummary& contact);

/// Damage of the whole contact; `rows`: those of all its patches. Empty without friction.
DamageSummary damage_summary(const CaseSpec& spec, const Summary& summary, const std::vector<StreamlineRow>& rows);

}  // namespace railstrata
