#include "geometry/track_presets.hpp"

#include <array>
#include <stdexcept>

#include "core/nearest_word.hpp"
#include "geometry/profile_names.hpp"

namespace railstrata {
namespace {

constexpr double kInch = 25.4e-3;
constexpr double kWideFlange = (2 + 27 / 32.0) * kInch;

// CN: gauge 16 mm below the top, 1353 mm between the backs, 1:40 [TG01]; the LMA wheels of CRH2, 860 mm.
// EN: 1360 mm [EN15313], gauge 14 mm below the top [EN13848], 1:40 (1:20 is usual too), new wheels of 920 mm [UIC510].
// AAR: gauge 5/8 inch below the top, between the backs 53 to 53 1/4 inches, the middle here [CFR49 213.53, 229.73];
// rails on plates of 1:40, wheels of 36 inches, 2 27/32 inches from the flange back to the tape line, the narrow
// flange [AARM107].
constexpr std::array kPresets{
    TrackPreset{{}, TrackKind::CN, "CN"}, TrackPreset{{1.435, 0.014, 1.360, 0.025, 0.460}, TrackKind::EN, "EN"},
    TrackPreset{{56.5 * kInch, 0.625 * kInch, 53.125 * kInch, 0.025, 18 * kInch, kWideFlange}, TrackKind::AAR, "AAR"}};

struct ProfileTrack {
  std::string_view profile;
  TrackKind kind;
};
constexpr std::array kOfProfiles{ProfileTrack{"LMA", TrackKind::CN}, ProfileTrack{"CN60", TrackKind::CN},
                                 ProfileTrack{"S1002", TrackKind::EN}, ProfileTrack{"UIC60", TrackKind::EN},
                                 ProfileTrack{"UIC54", TrackKind::EN}};

}  // namespace

const TrackPreset& track_preset(TrackKind kind) {
  for (const TrackPreset& p : kPresets)
    if (p.kind == kind) return p;
  throw std::logic_error("no track preset belongs to this profile");
}

TrackKind track_kind_named(std::string_view name) {
  for (const TrackPreset& p : kPresets)
    if (p.name == name) return p.kind;
  return TrackKind::by_profile;
}

TrackKind track_of_profile(const std::string& profile) {
  for (const ProfileTrack& p : kOfProfiles)
    if (edit_distance(p.profile, profile) == 0) return p.kind;
  return TrackKind::by_profile;
}

const TrackPreset& track_preset_of(TrackKind wanted, const std::string& wheel, const std::string& rail) {
  if (wanted != TrackKind::by_profile) return track_preset(wanted);
  TrackKind kind = names_primitive(wheel) || names_primitive(rail) ? TrackKind::CN : track_of_profile(wheel);
  if (kind == TrackKind::by_profile) kind = track_of_profile(rail);
  return track_preset(kind == TrackKind::by_profile ? TrackKind::CN : kind);
}

}  // namespace railstrata
