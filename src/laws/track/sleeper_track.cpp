#include "track/sleeper_track.hpp"

#include <cmath>
#include <map>

namespace railstrata {

// delft: pad, ballast and spacing of the models of TU Delft, in [Track3], get_input_2 and get_input_4; sleeper 280 kg.
// medium: UIC60 on sleepers B70 of 280 kg, in [RailFe]. cn60: pad and sleeper of [ZhaiWangLin2004]; of its two layers
// below the sleeper, 137.75 MN/m and 58.8 kN s/m on 77.5 MN/m and 31.2 kN s/m with a mass of 531 kg between them, the
// stiffness in series and about the damping of the lower one (in series it would be 20.4 kN s/m).
const SleeperTrack* named_track(std::string_view name) {
  const auto track = [](double pad, double pad_damping, double sleeper, double ballast, double ballast_damping) {
    return SleeperTrack{.pad_stiffness = pad,
                        .pad_damping = pad_damping,
                        .sleeper_mass = sleeper,
                        .ballast_stiffness = ballast,
                        .ballast_damping = ballast_damping};
  };
  static const std::map<std::string_view, SleeperTrack> all{{"delft", track(1300e6, 67.5e3, 140, 45e6, 32e3)},
                                                            {"medium", track(200e6, 28e3, 140, 40e6, 47e3)},
                                                            {"cn60", track(65e6, 75e3, 125.5, 50e6, 30e3)}};
  const auto found = all.find(name);
  return found == all.end() ? nullptr : &found->second;
}

std::vector<double> sleepers_between(const SleeperTrack& track, double begin, double end) {
  constexpr double kRoundOff = 1e-9;
  const double half = 0.5 * track.pad_length;
  std::vector<double> out;
  for (double k = std::ceil((begin + half) / track.spacing - track.phase - kRoundOff);; ++k) {
    const double at = (track.phase + k) * track.spacing;
    if (at + half > end + kRoundOff) return out;
    out.push_back(at);
  }
}

}  // namespace railstrata
