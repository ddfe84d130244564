#include "spec/curve_spec.hpp"

namespace railstrata {

const std::vector<BogieType>& bogie_types() {
  // Estimates: usual wheelbases and loads, springs of examples/vehicle/curving.py
  static const std::vector<BogieType> types{
      {"coach", Certainty::published, "first vehicle of the Manchester benchmarks [Iwnicki1998]", {}},
      {"wagon",
       Certainty::estimated,
       "loaded wagon of 22.5 t an axle, wheelbase of a Y25",
       {.axle_load = 220.7e3,
        .wheelbase = 1.8,
        .wheelset_mass = 1300,
        .longitudinal = 7.5e6,
        .lateral = 2.5e6,
        .centre_of_gravity = 2.0}},
      {"locomotive",
       Certainty::estimated,
       "four-axle locomotive of 84 t",
       {.axle_load = 206e3,
        .wheelbase = 2.6,
        .wheelset_mass = 2500,
        .longitudinal = 2.5e6,
        .lateral = 2e6,
        .centre_of_gravity = 1.8,
        .traction_coefficient = 0.1}}};
  return types;
}

}  // namespace railstrata
