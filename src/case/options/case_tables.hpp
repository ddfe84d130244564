#pragma once
// The tables of the case's keys, one function a table; option_table.hpp puts them together.
#include "options/option_table.hpp"

namespace railstrata {

OptionTable geometry_table();
OptionTable rail_material_table();
OptionTable wheel_material_table();
OptionTable layer_table();
OptionTable stretch_table();
OptionTable irregularity_table();
OptionTable vehicle_table();
OptionTable track_table();
OptionTable drive_table();
OptionTable friction_table();
OptionTable third_body_table();
OptionTable mesh_table();
OptionTable run_table();
OptionTable bem_table();
OptionTable transient_table();
OptionTable load_table();
OptionTable collective_table();
OptionTable life_table();
OptionTable grinding_table();
OptionTable passes_table();
OptionTable output_table();

}  // namespace railstrata
