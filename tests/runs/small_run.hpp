#pragma once
// A case as text, small enough for a test: a disc with a crowned tread rolls 12 mm over a flat block, 4 mm elements.
#include "reader/case_file.hpp"

namespace railstrata::run_checks {

inline constexpr const char* kSmallCase = R"(
[geometry]
rail_profile = "flat"
wheel_profile = "arc:R=430 mm"
rail_shape = "block"
wheel_shape = "disc"
cant = 0.0
bore_radius = "250 mm"
[vehicle]
wheel_mass = "1500 kg"
sprung_mass = "7000 kg"
[drive]
speed = "12 m/s"
torque_ramp = "0.4 ms"
[mesh]
element_size = "4 mm"
fine_width = "32 mm"
fine_depth = "8 mm"
coarse_ratio = 2
largest = "20 mm"
end_length = "60 mm"
[run]
positions = ["5 mm", "10 mm"]
window = "4 mm"
run_up = "0 mm"
run_up_damping = "0 1/s"
[output]
series_frames = 3
)";

inline LoadedCase small_case(const std::vector<std::string>& overrides = {}) {
  return parse_case(kSmallCase, "small.toml", overrides);
}

}  // namespace railstrata::run_checks
