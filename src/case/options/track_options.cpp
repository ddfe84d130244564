#include "options/option_slots.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using C = CaseSpec;
using Sleepers = SleeperTrack;

bool on_sleepers(const CaseSpec& spec, std::size_t) { return !spec.track.held(); }

template <auto Member>
Option of_sleepers(std::string_view key, std::string_view doc, const Dimension& dimension, const Range& range) {
  return option(key, at<&C::track, &TrackSpec::support, Member>, doc, dimension, range).where(on_sleepers);
}

}  // namespace

OptionTable track_table() {
  return {
      "track",
      "Pads, sleepers and ballast below one rail (docs/track.md); with bem.bodies = \"sections\" an even "
      "support of their stiffness",
      {choice_at<&C::track, &TrackSpec::preset>(
           "preset",
           "Preset that supplies the defaults of the keys below; held: no track, the foot's base is fixed. "
           "geometry.track is gauge and cant",
           {{"held", TrackSet::held},
            {"delft", TrackSet::delft},
            {"medium", TrackSet::medium},
            {"cn60", TrackSet::cn60}})
           .where(on_sleepers),
       of_sleepers<&Sleepers::spacing>("spacing", "Spacing of the sleepers", kLength, {0.2, 2}),
       of_sleepers<&Sleepers::phase>("phase",
                                     "Distance from x = 0, where the wheel starts, to the next sleeper, over the "
                                     "spacing: 0 is over a sleeper, 0.5 midspan",
                                     kNumber, {0, 1}),
       of_sleepers<&Sleepers::pad_stiffness>("pad_stiffness", "Vertical, of one pad", kStiffness, {1e5, 1e11}),
       of_sleepers<&Sleepers::pad_damping>("pad_damping", "Vertical, of one pad", kDamping, {0, 1e8}),
       of_sleepers<&Sleepers::pad_length>("pad_length", "Along the rail; 0: only at the nearest station", kLength,
                                          {0, 1}),
       of_sleepers<&Sleepers::pad_shear>("pad_shear",
                                         "Lateral and longitudinal stiffness and damping of a pad over the vertical "
                                         "ones; the sleeper does not move laterally",
                                         kNumber, above(0, 10)),
       of_sleepers<&Sleepers::sleeper_mass>("sleeper_mass", "Mass of half a sleeper, which moves vertically", kMass,
                                            above(0, 1e4)),
       of_sleepers<&Sleepers::ballast_stiffness>("ballast_stiffness", "Below half a sleeper", kStiffness, {1e4, 1e11}),
       of_sleepers<&Sleepers::ballast_damping>("ballast_damping", "Below half a sleeper", kDamping, {0, 1e8}),
       of_sleepers<&Sleepers::bays>(
           "bays", "Length of the rail in sleeper spacings, centred on the wheel's path; replaces mesh.end_length",
           kNumber, {2, 400})}};
}

}  // namespace railstrata
