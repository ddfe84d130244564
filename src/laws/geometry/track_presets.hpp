#pragma once
// Wheelsets and tracks that belong together: the usual numbers of Europe, China and North America.
#include <string>
#include <string_view>

namespace railstrata {

enum class TrackKind {
  by_profile,  ///< that of the wheel's profile; of a wheel from a file that of the rail's; else CN
  CN,
  EN,
  AAR
};

/// m; cant: tangent of the rail's inclination. The defaults are those of CN.
struct TrackNumbers {
  double gauge = 1.435, gauge_depth = 0.016, back_to_back = 1.353, cant = 0.025, wheel_radius = 0.430;
  double flange_back_to_tape = 0.070;
};

/// New wheels on straight track.
struct TrackPreset : TrackNumbers {
  TrackKind kind;
  std::string_view name;
};

/// Never of by_profile. `profile`: a built-in name in any case.
const TrackPreset& track_preset(TrackKind kind);
/// by_profile: of a word that names none.
TrackKind track_kind_named(std::string_view name);
/// by_profile: of a file, an arc, a plane and a profile without a track of its own.
TrackKind track_of_profile(const std::string& profile);
/// Which preset counts: `wanted`, or that of the profiles. Arcs and planes stand on no track: CN, the program's
/// default.
const TrackPreset& track_preset_of(TrackKind wanted, const std::string& wheel, const std::string& rail);

}  // namespace railstrata
