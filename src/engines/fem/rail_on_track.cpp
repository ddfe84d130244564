#include "fem/rail_on_track.hpp"

#include <cmath>
#include <numbers>

#include "body/field_algebra.hpp"
#include "body/stable_step.hpp"
#include "body/traversal.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "fem/rolling_system.hpp"
#include "fem/track_step.hpp"

namespace railstrata {
namespace {

constexpr double kHammerLength = 20e-3;  // m, of the hammer's force along the rail

/// A force that is not elastic: its work is that of the velocities before and after the update.
struct BookedForce {
  std::ptrdiff_t index;
  double force, before;
  double BlowEnergy::*account;
};

class Strike {
 public:
  Strike(const Body& rail, const RailPads& pads, const HammerBlow& blow)
      : rail_(rail),
        blow_(blow),
        elements_(rail),
        ends_(end_absorbers(rail)),
        u_(rail.layout.field()),
        v_(u_),
        f_(u_),
        track_(pads),
        sleepers_(pads.x.size()),
        section_(section_mean(rail, blow.x, kHammerLength)) {
    std::vector<SectionNode> top;
    for (int c = 0; c <= rail.mesh.contact.columns; ++c)
      if (rail.is_free(rail.mesh.contact.block, c)) top.push_back({rail.mesh.contact.block, c});
    head_ = spread_along(rail, top, blow.x, kHammerLength);
    out_.dt = blow.safety * lanczos_stable_step(rail);
    require_stable(pads, rail, out_.dt, blow.safety);
  }

  BlowResponse run(const std::function<void(double)>& progress) {
    const auto steps = static_cast<long>(std::ceil(blow_.time / out_.dt));
    for (long n = 0; n < steps; ++n) {
      step(static_cast<double>(n) * out_.dt, n + 1 == steps);
      if (progress && n % 256 == 0) progress(static_cast<double>(n) / static_cast<double>(steps));
    }
    return std::move(out_);
  }

 private:
  double force_at(double time) const {
    return time < blow_.duration ? 0.5 * (1 - std::cos(2 * std::numbers::pi * time / blow_.duration)) : 0.0;
  }
  /// On the rail, from outside: positive z is up.
  void push(std::ptrdiff_t index, double force, double BlowEnergy::*account) {
    f_[index] -= force;
    booked_.push_back({index, force, v_[index], account});
  }

  /// With the mean of the velocities before and after the update: stable at any coefficient. After all other forces.
  void absorb(const EndDashpot& d) {
    const double mobility = out_.dt * rail_.inverse_mass[d.index], half = 0.5 * d.coefficient * mobility;
    const double before = v_[d.index], after = ((1 - half) * before - mobility * f_[d.index]) / (1 + half);
    push(d.index, -0.5 * d.coefficient * (before + after), &BlowEnergy::ends);
  }

  void step(double time, bool last) {
    elements_.linear_force(u_, f_);
    rail_.ties.apply_transpose(f_);
    booked_.clear();
    if (last) {
      Field on_free = f_;
      clear_held(rail_, on_free);
      out_.energy.kept = 0.5 * dot(u_, on_free);
    }
    track_.press(u_, v_, out_.dt, sleepers_, f_);
    const double force = force_at(time);
    if (force > 0)
      for (const NodeShare& n : head_) push(n.index + 2 * n.stride, -force * n.share, &BlowEnergy::supplied);
    for (const EndDashpot& d : ends_) absorb(d);
    out_.force.push_back(force);
    out_.section.push_back(-mean_height(section_, u_));
    out_.head.push_back(-mean_height(head_, u_));
    update(last);
  }
  void update(bool last) {
    const Field before = last ? v_ : Field();
    for_each(static_cast<std::ptrdiff_t>(u_.size()), [&](std::ptrdiff_t i) {
      const double mobility = rail_.inverse_mass[i];
      if (mobility == 0) return;
      v_[i] -= out_.dt * mobility * f_[i];
      u_[i] += out_.dt * v_[i];
    });
    for (const BookedForce& b : booked_) {
      const double work = out_.dt * b.force * 0.5 * (b.before + v_[b.index]);
      out_.energy.*b.account += b.account == &BlowEnergy::supplied ? work : -work;
    }
    const TrackLosses losses = track_.losses(v_);
    out_.energy.pads += losses.pads;
    out_.energy.ballast += losses.ballast;
    if (last) {
      out_.energy.kept += track_.elastic() + track_.kinetic();
      for (std::size_t i = 0; i < v_.size(); ++i)
        if (rail_.inverse_mass[i] > 0) out_.energy.kept += 0.5 * rail_.mass[i] * before[i] * v_[i];
    }
    rail_.ties.apply_homogeneous(u_);
  }

  const Body& rail_;
  const HammerBlow& blow_;
  Traversal elements_;
  std::vector<EndDashpot> ends_;
  Field u_, v_, f_;
  TrackStep track_;
  std::vector<MassGroup> sleepers_;
  std::vector<NodeShare> section_, head_;
  std::vector<BookedForce> booked_;
  BlowResponse out_;
};

}  // namespace

BlowResponse strike(const Body& rail, const RailPads& pads, const HammerBlow& blow,
                    const std::function<void(double)>& progress) {
  return Strike(rail, pads, blow).run(progress);
}

}  // namespace railstrata
