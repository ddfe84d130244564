#include "fem/track_step.hpp"

namespace railstrata {

TrackStep::TrackStep(const RailPads& pads) : pads_(pads) {
  std::size_t nodes = 0;
  for (const auto& pad : pads.nodes) nodes += pad.size();
  dashpots_.reserve(3 * nodes);
}

void TrackStep::press(const Field& u, const Field& v, double dt, std::vector<MassGroup>& sleepers, Field& f) {
  const SleeperTrack& t = pads_.track;
  dt_ = dt;
  elastic_ = kinetic_ = 0;
  of_sleepers_ = {};
  dashpots_.clear();
  for (std::size_t k = 0; k < sleepers.size(); ++k) {
    MassGroup& sleeper = sleepers[k];
    double all_springs = 0, all_dashpots = 0;  // N, of the pad
    for (const NodeShare& n : pads_.nodes[k])
      for (int i = 0; i < 3; ++i) {
        const double part = n.share * (i < 2 ? t.pad_shear : 1.0);
        const std::ptrdiff_t at = n.index + static_cast<std::ptrdiff_t>(i) * n.stride;
        const double pressed = u[at] - (i < 2 ? 0.0 : sleeper.z), spring = part * t.pad_stiffness * pressed,
                     dashpot = part * t.pad_damping * (v[at] - (i < 2 ? 0.0 : sleeper.vz));
        f[at] += spring + dashpot;
        elastic_ += 0.5 * spring * pressed;
        dashpots_.push_back({at, dashpot, v[at]});
        if (i < 2) continue;
        all_springs += spring;
        all_dashpots += dashpot;
      }
    move(sleeper, all_springs, all_dashpots);
  }
}

void TrackStep::move(MassGroup& sleeper, double spring, double dashpot) {
  const SleeperTrack& t = pads_.track;
  const double elastic = t.ballast_stiffness * sleeper.z, viscous = t.ballast_damping * sleeper.vz, before = sleeper.vz;
  elastic_ += 0.5 * elastic * sleeper.z;
  sleeper.vz += dt_ * (spring + dashpot - elastic - viscous) / t.sleeper_mass;
  sleeper.z += dt_ * sleeper.vz;
  const double middle = 0.5 * (before + sleeper.vz);
  of_sleepers_.ballast += dt_ * viscous * middle;
  of_sleepers_.pads -= dt_ * dashpot * middle;
  kinetic_ += 0.5 * t.sleeper_mass * before * sleeper.vz;
}

TrackLosses TrackStep::losses(const Field& v) const {
  TrackLosses out = of_sleepers_;
  for (const Dashpot& d : dashpots_) out.pads += dt_ * d.force * 0.5 * (d.before + v[d.index]);
  return out;
}

}  // namespace railstrata
