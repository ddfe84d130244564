#include "fem/rail_on_track.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "body/stable_step.hpp"
#include "body/traversal.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "fem/rolling_system.hpp"
#include "fem/static_vector.hpp"

namespace railstrata {
namespace {

constexpr double kHammerLength = 20e-3;  // m, of the hammer's force along the rail
constexpr double kPoint = 1e-6;          // m, in place of a length of 0

/// Integrals of the stations' shape functions over [begin, end].
std::vector<double> shape_integrals(const std::vector<double>& at, double begin, double end) {
  std::vector<double> out(at.size(), 0.0);
  for (std::size_t j = 0; j + 1 < at.size(); ++j) {
    const double low = std::max(begin, at[j]), high = std::min(end, at[j + 1]);
    if (low >= high) continue;
    const double right = (0.5 * (low + high) - at[j]) / (at[j + 1] - at[j]);
    out[j] += (high - low) * (1 - right);
    out[j + 1] += (high - low) * right;
  }
  return out;
}

/// Half the distances to both neighbours in an increasing list.
double tributary(const std::vector<double>& at, std::size_t j) {
  return 0.5 * (at[std::min(j + 1, at.size() - 1)] - at[j > 0 ? j - 1 : 0]);
}

void normalize(std::vector<NodeShare>& shares) {
  double sum = 0;
  for (const NodeShare& s : shares) sum += s.share;
  for (NodeShare& s : shares) s.share /= sum;
}

/// Mean by mass of the sections around x.
std::vector<NodeShare> section_mean(const Body& rail, double x) {
  std::vector<NodeShare> out;
  for (const NodeLine& l : rail.lines) {
    if (l.component != 0) continue;
    const std::vector<double>& at = rail.mesh.blocks[l.block].stations.at;
    const std::vector<double> part = shape_integrals(at, x - 0.5 * kHammerLength, x + 0.5 * kHammerLength);
    for (std::size_t j = 0; j < part.size(); ++j)
      if (part[j] > 0)
        out.push_back({l.first + static_cast<std::ptrdiff_t>(j), rail.layout.blocks[l.block].stride,
                       part[j] * rail.mass[l.first + j] / tributary(at, j)});
  }
  normalize(out);
  return out;
}

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
        pads_(pads),
        blow_(blow),
        elements_(rail),
        ends_(end_absorbers(rail)),
        u_(rail.layout.field()),
        v_(u_),
        f_(u_),
        z_(pads.x.size(), 0.0),
        w_(z_),
        section_(section_mean(rail, blow.x)) {
    std::vector<SectionNode> top;
    for (int c = 0; c <= rail.mesh.contact.columns; ++c)
      if (rail.is_free(rail.mesh.contact.block, c)) top.push_back({rail.mesh.contact.block, c});
    head_ = spread_along(rail, top, blow.x, kHammerLength);
    out_.dt = blow.safety * lanczos_stable_step(rail);
    require_stable_pads();
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
  /// Central differences with dashpots of the half step before are stable up to omega² dt² + 2 c dt/m = 4.
  void require_stable_pads() const {
    const SleeperTrack& t = pads_.track;
    double worst = 0;
    for (const auto& pad : pads_.nodes)
      for (const NodeShare& n : pad)
        worst = std::max(worst, n.share * std::max(1.0, t.pad_shear) * rail_.inverse_mass[n.index] * out_.dt *
                                    (t.pad_stiffness * out_.dt + 2 * t.pad_damping));
    const double room = 4 * (1 - blow_.safety * blow_.safety);
    if (worst > room)
      throw CaseError(
          fmt::format("the pads are too stiff for the time step at the foot's nodes: {:.2g} of {:.2g}", worst, room),
          "give a longer track.pad_length, less track.pad_damping or run.step_safety", "track.pad_length");
  }
  double mean(const std::vector<NodeShare>& of) const {
    double sum = 0;
    for (const NodeShare& s : of) sum += s.share * u_[s.index + 2 * s.stride];
    return sum;
  }
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

  void press_pads() {
    const SleeperTrack& t = pads_.track;
    for (std::size_t k = 0; k < pads_.nodes.size(); ++k) {
      double spring = 0, dashpot = 0;
      for (const NodeShare& n : pads_.nodes[k]) {
        const double stiffness = n.share * t.pad_stiffness, damping = n.share * t.pad_damping;
        for (int i = 0; i < 2; ++i) {
          const std::ptrdiff_t at = n.index + i * n.stride;
          f_[at] += t.pad_shear * stiffness * u_[at];
          elastic_ += 0.5 * t.pad_shear * stiffness * u_[at] * u_[at];
          push(at, -t.pad_shear * damping * v_[at], &BlowEnergy::pads);
        }
        const std::ptrdiff_t at = n.index + 2 * n.stride;
        const double pressed = u_[at] - z_[k], rate = damping * (v_[at] - w_[k]);
        f_[at] += stiffness * pressed;
        elastic_ += 0.5 * stiffness * pressed * pressed;
        push(at, -rate, &BlowEnergy::pads);
        spring += stiffness * pressed;
        dashpot += rate;
      }
      elastic_ += 0.5 * t.ballast_stiffness * z_[k] * z_[k];
      move_sleeper(k, spring - t.ballast_stiffness * z_[k], dashpot);
    }
  }
  void move_sleeper(std::size_t k, double elastic, double from_pad) {
    const SleeperTrack& t = pads_.track;
    const double ballast = t.ballast_damping * w_[k], before = w_[k];
    w_[k] += out_.dt * (elastic + from_pad - ballast) / t.sleeper_mass;
    z_next_.push_back(z_[k] + out_.dt * w_[k]);
    const double middle = 0.5 * (before + w_[k]);
    out_.energy.ballast += out_.dt * ballast * middle;
    out_.energy.pads -= out_.dt * from_pad * middle;
    kinetic_ += 0.5 * t.sleeper_mass * before * w_[k];
  }

  void step(double time, bool last) {
    elements_.linear_force(u_, f_);
    rail_.ties.apply_transpose(f_);
    booked_.clear();
    z_next_.clear();
    elastic_ = kinetic_ = 0;
    if (last) elastic_ = 0.5 * dot(u_, f_on_free());
    press_pads();
    const double force = force_at(time);
    if (force > 0)
      for (const NodeShare& n : head_) push(n.index + 2 * n.stride, -force * n.share, &BlowEnergy::supplied);
    for (const EndDashpot& d : ends_) absorb(d);
    out_.force.push_back(force);
    out_.section.push_back(-mean(section_));
    out_.head.push_back(-mean(head_));
    update(last);
    z_.swap(z_next_);
  }
  /// Internal forces where nodes are free.
  Field f_on_free() const {
    Field out = f_;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (rail_.inverse_mass[i] == 0) out[i] = 0;
    return out;
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
    if (last) {
      for (std::size_t i = 0; i < v_.size(); ++i)
        if (rail_.inverse_mass[i] > 0) kinetic_ += 0.5 * rail_.mass[i] * before[i] * v_[i];
      out_.energy.kept = elastic_ + kinetic_;
    }
    rail_.ties.apply_homogeneous(u_);
  }

  const Body& rail_;
  const RailPads& pads_;
  const HammerBlow& blow_;
  Traversal elements_;
  std::vector<EndDashpot> ends_;
  Field u_, v_, f_;
  std::vector<double> z_, w_, z_next_;  // of the sleepers
  std::vector<NodeShare> section_, head_;
  std::vector<BookedForce> booked_;
  double elastic_ = 0, kinetic_ = 0;  // J, of the present step
  BlowResponse out_;
};

}  // namespace

std::vector<NodeShare> spread_along(const Body& body, std::vector<SectionNode> nodes, double x, double length) {
  const auto across = [&](const SectionNode& n) { return body.mesh.blocks[n.block].section.nodes[n.node].y; };
  std::sort(nodes.begin(), nodes.end(), [&](const auto& a, const auto& b) { return across(a) < across(b); });
  std::vector<double> y;
  for (const SectionNode& n : nodes) y.push_back(across(n));
  const double half = 0.5 * std::max(length, kPoint);
  std::vector<NodeShare> out;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const SectionNode& n = nodes[k];
    const BlockLayout& lay = body.layout.blocks[n.block];
    const std::vector<double>& at = body.mesh.blocks[n.block].stations.at;
    if (x - half < at.front() || x + half > at.back())
      throw CaseError(fmt::format("x = {:.0f} mm lies beyond the rail's ends", 1e3 * x), "give more track.bays",
                      "track.bays");
    const std::vector<double> part = shape_integrals(at, x - half, x + half);
    for (std::size_t j = 0; j < part.size(); ++j)
      if (part[j] > 0)
        out.push_back({lay.line(n.node, 0) + static_cast<std::ptrdiff_t>(j), lay.stride, part[j] * tributary(y, k)});
  }
  normalize(out);
  return out;
}

RailPads rail_pads(const Body& rail, const std::vector<SectionNode>& base, const SleeperTrack& track) {
  const std::vector<double>& at = rail.mesh.blocks[base.front().block].stations.at;
  RailPads out{track, sleepers_between(track, at.front() + kPoint, at.back() - kPoint), {}};
  for (const double x : out.x) out.nodes.push_back(spread_along(rail, base, x, track.pad_length));
  return out;
}

BlowResponse strike(const Body& rail, const RailPads& pads, const HammerBlow& blow,
                    const std::function<void(double)>& progress) {
  return Strike(rail, pads, blow).run(progress);
}

}  // namespace railstrata
