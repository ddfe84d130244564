#include "material/material_path.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr int kTerms = kMostBackstresses, kNewton = 10;  // of the law: increments may be as coarse as a user likes
constexpr int kMostSolves = 60, kMostHalvings = 12;      // of the search for the strain of a stress
constexpr double kStressTolerance = 1e-9, kLawTolerance = 1e-8;  // over the yield stress
constexpr double kProbe = 1e-8;  // strain of a difference quotient: the law is linear but for kinks

using State = MaterialState;

double yield_stress(const PlasticParameters<double>& p, double accumulated) {
  return p.yield + (p.saturation != 0 ? p.saturation * saturated_share(p.rate * accumulated) : 0.0);
}

/// The state after a step to a strain; `before` stays.
State stepped(const PlasticMaterial& m, const State& before, const std::array<double, 6>& strain) {
  State out = before;
  out.strain = strain;
  double e[6], s[6];
  std::copy(strain.begin(), strain.end(), e);
  advance_plastic<kTerms, kNewton>(m.plastic, e, out.history.data());
  plastic_stress(m.lambda, m.plastic.mu, e, out.history.data(), s);
  std::copy(s, s + 6, out.stress.begin());
  out.dissipated += plastic_dissipation<kTerms>(m.plastic, s, before.history.data(), out.history.data());
  return out;
}

class Driver {
 public:
  Driver(const PlasticMaterial& material, const MaterialPath& path) : m_(material), path_(path) {
    for (int j = 0; j < 6; ++j)
      if (path.prescribed[j] == Prescribed::stress) free_.push_back(j);
  }

  /// From a state to the prescribed values; false where none is found.
  bool step(State& state, const std::array<double, 6>& target) {
    std::array<double, 6> strain = state.strain;
    for (int j = 0; j < 6; ++j)
      if (path_.prescribed[j] == Prescribed::strain) strain[j] = target[j];
    State next = stepped(m_, state, strain);
    for (int solve = 0; !met(next, target); ++solve)
      if (solve == kMostSolves || !improve(state, target, strain, next)) return false;
    if (next.history[6] > state.history[6] &&
        !(std::abs(yield_excess(m_.plastic, next.strain, next.history)) < kLawTolerance))
      throw NumericalError("the material law did not converge within an increment; use more increments");
    state = next;
    return true;
  }

 private:
  Eigen::VectorXd residual(const State& s, const std::array<double, 6>& target) const {
    Eigen::VectorXd r(free_.size());
    for (std::size_t k = 0; k < free_.size(); ++k) r[k] = s.stress[free_[k]] - target[free_[k]];
    return r;
  }
  bool met(const State& s, const std::array<double, 6>& target) const {
    if (free_.empty()) return true;
    const double scale = std::isfinite(m_.plastic.yield) ? m_.plastic.yield : m_.plastic.mu * 1e-3;
    return residual(s, target).lpNorm<Eigen::Infinity>() <= kStressTolerance * scale;
  }

  /// One Newton step on the free strains, halved until the stresses come nearer to the wanted ones.
  bool improve(const State& before, const std::array<double, 6>& target, std::array<double, 6>& strain,
               State& next) const {
    const auto n = static_cast<Eigen::Index>(free_.size());
    const Eigen::VectorXd r = residual(next, target);
    Eigen::MatrixXd tangent(n, n);
    for (Eigen::Index c = 0; c < n; ++c) {
      std::array<double, 6> probe = strain;
      probe[free_[c]] += kProbe;
      tangent.col(c) = (residual(stepped(m_, before, probe), target) - r) / kProbe;
    }
    const Eigen::VectorXd move = tangent.fullPivLu().solve(-r);
    if (!move.allFinite()) return false;
    double share = 1;
    for (int halving = 0; halving < kMostHalvings; ++halving, share *= 0.5) {
      std::array<double, 6> tried = strain;
      for (Eigen::Index c = 0; c < n; ++c) tried[free_[c]] += share * move[c];
      State there = stepped(m_, before, tried);
      if (!(residual(there, target).norm() < r.norm())) continue;
      strain = tried;
      next = there;
      return true;
    }
    return false;
  }

  const PlasticMaterial& m_;
  const MaterialPath& path_;
  std::vector<int> free_;  ///< components whose stress is prescribed: their strains are sought
};

}  // namespace

double largest_stress(const PlasticParameters<double>& p) {
  double out = p.yield + p.saturation;
  for (int k = 0; k < kMostBackstresses; ++k)
    if (p.modulus[k] > 0) out += p.modulus[k] / p.recall[k];  // γ = 0: infinite
  return out;
}

double yield_excess(const PlasticParameters<double>& p, const std::array<double, 6>& strain,
                    const std::array<double, kPlasticHistory<kMostBackstresses>>& history) {
  const double mean = (strain[0] + strain[1] + strain[2]) / 3;
  double relative[6];
  for (int j = 0; j < 6; ++j) {
    relative[j] = 2 * p.mu * (strain[j] - (j < 3 ? mean : 0.0) - history[j]);
    for (int k = 0; k < kMostBackstresses; ++k) relative[j] -= history[7 + 6 * k + j];
  }
  const double yield = yield_stress(p, history[6]);
  return std::sqrt(1.5 * double_contraction(relative, relative)) / yield - 1;
}

std::vector<MaterialState> drive_path(const PlasticMaterial& material, const MaterialPath& path, int increments,
                                      CallableRef<void(const MaterialState&)> at_increment) {
  assert(increments > 0);
  Driver driver(material, path);
  std::vector<MaterialState> out;
  State state;
  std::array<double, 6> from{};
  for (const std::array<double, 6>& to : path.points) {
    for (int i = 1; i <= increments; ++i) {
      std::array<double, 6> target;
      for (int j = 0; j < 6; ++j) target[j] = i == increments ? to[j] : from[j] + (to[j] - from[j]) * i / increments;
      if (!driver.step(state, target))
        throw BeyondMaterial{static_cast<int>(out.size()), static_cast<double>(i - 1) / increments};
      at_increment(state);
    }
    out.push_back(state);
    from = to;
  }
  return out;
}

}  // namespace railstrata
