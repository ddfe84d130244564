#include "crack/crack_faces.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <utility>

#include "crack/dislocation.hpp"
#include "crack/layered_dislocation.hpp"
#include "crack/level_crack.hpp"

namespace railstrata {

CrackFaces::CrackFaces(const CrackLine& line, const LayeredHalfSpace& body, int points)
    : line_(line), rule_(&crack_rule(line.kind, line.level() ? level_points(line, points) : points)) {
  if (line.level()) {
    LevelCrack level = level_crack(body, line, *rule_);
    modulus_ = level.modulus;
    stiffness_ = std::move(level.stiffness);
  } else {
    const HalfSpaceMaterial material = material_at(body, line.z(line.length));
    modulus_ = material.young / (1 - material.poisson * material.poisson);
    resist(body, points);
  }
  const Eigen::Index n = rule_->point.size();
  state_.assign(static_cast<std::size_t>(n), State::stuck);
  before_ = Eigen::VectorXd::Zero(2 * n);
}

void CrackFaces::resist(const LayeredHalfSpace& body, int points) {
  const CrackLine& line = line_;
  const Eigen::Index n = rule_->point.size();
  const std::complex<double> along = std::polar(1.0, line.angle), across = std::complex<double>(0, 1) * along;
  const auto place = [&](double share) {
    return std::complex<double>(line.x(share * line.length), line.z(share * line.length));
  };
  stiffness_ = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  const auto add = [&](auto stress, const Eigen::VectorXd& nodes, const Eigen::MatrixXd& density) {
    Eigen::MatrixXd traction(2 * n, nodes.size());
    for (const bool opens : {true, false}) {
      for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index j = 0; j < nodes.size(); ++j) {
          const LineTraction t = traction_on(stress(material_at(body, place(rule_->point[k]).imag()),
                                                    place(rule_->point[k]), place(nodes[j]), opens ? across : along),
                                             line.angle);
          traction(k, j) = t.normal;
          traction(n + k, j) = t.shear;
        }
      stiffness_.middleCols(opens ? 0 : n, n) -= traction * density;
    }
  };
  add(whole_plane_stress, rule_->node, rule_->density);
  add(image_stress, rule_->image_node, rule_->image_density);
  const auto points_of = [&](const Eigen::VectorXd& shares) {
    std::vector<CrackPoint> out;
    for (const double share : shares) out.push_back({line.x(share * line.length), line.z(share * line.length)});
    return out;
  };
  const Eigen::MatrixXd layers = layers_traction(body, line.angle, points_of(rule_->point), points_of(rule_->node),
                                                 line.length / static_cast<double>(points));
  if (const Eigen::Index nodes = rule_->node.size(); layers.size() > 0) {
    stiffness_.leftCols(n) -= layers.leftCols(nodes) * rule_->density;
    stiffness_.rightCols(n) -= layers.rightCols(nodes) * rule_->density;
  }
}

std::vector<double> CrackFaces::places() const {
  std::vector<double> out;
  for (const double share : rule_->point) out.push_back(share * line_.length);
  return out;
}

/// The jumps under the present states.
Eigen::VectorXd CrackFaces::solve(const Eigen::VectorXd& applied, double friction, double fluid) const {
  const Eigen::Index n = rule_->point.size();
  std::vector<Eigen::Index> free;  // unknown jumps
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(2 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const State s = state_[static_cast<std::size_t>(k)];
    if (s == State::open) free.push_back(k);
    if (s == State::stuck) jump[n + k] = before_[n + k];
  }
  for (Eigen::Index k = 0; k < n; ++k)
    if (state_[static_cast<std::size_t>(k)] != State::stuck) free.push_back(n + k);
  if (free.empty()) return jump;
  const Eigen::VectorXd rest = applied - stiffness_ * jump;
  const auto size = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd matrix(size, size);
  Eigen::VectorXd wanted(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Index row = free[static_cast<std::size_t>(i)];
    const State s = state_[static_cast<std::size_t>(row % n)];
    const bool slips = s == State::forward || s == State::backward;
    const double bound = !slips ? 0 : s == State::forward ? friction : -friction;  // τ = bound p
    for (Eigen::Index j = 0; j < size; ++j) {
      const Eigen::Index column = free[static_cast<std::size_t>(j)];
      matrix(i, j) = stiffness_(row, column) + (slips ? bound * stiffness_(row - n, column) : 0);
    }
    wanted[i] = row < n ? rest[row] + fluid : rest[row] + (slips ? bound * (rest[row - n] + fluid) : 0);
  }
  const Eigen::VectorXd found = matrix.partialPivLu().solve(wanted);
  for (Eigen::Index i = 0; i < size; ++i) jump[free[static_cast<std::size_t>(i)]] = found[i];
  return jump;
}

/// Takes points whose conditions do not hold into another state, or one alone; false: there are none.
bool CrackFaces::review(const Eigen::VectorXd& jump, const Eigen::VectorXd& traction, double friction, double fluid,
                        bool one) {
  constexpr double kSmall = 1e-9;
  const Eigen::Index n = rule_->point.size();
  const double far = kSmall * (jump.cwiseAbs().maxCoeff() + 1e-15),
               hard = kSmall * (traction.cwiseAbs().maxCoeff() + 1);
  bool changed = false;
  for (Eigen::Index k = 0; k < n && !(one && changed); ++k) {
    State& s = state_[static_cast<std::size_t>(k)];
    const double pressure = -traction[k] - fluid, shear = traction[n + k], moved = jump[n + k] - before_[n + k];
    State next = s;
    if (s == State::open) {
      if (jump[k] < -far) next = moved > 0 ? State::forward : State::backward;
    } else if (pressure < -hard) {
      next = State::open;
    } else if (s == State::stuck) {
      if (std::abs(shear) > friction * pressure + hard) next = shear > 0 ? State::forward : State::backward;
    } else if ((s == State::forward ? moved : -moved) < -far) {
      next = State::stuck;
    }
    changed = changed || next != s;
    s = next;
  }
  return changed;
}

CrackFaces::Faces CrackFaces::load(const std::vector<LineTraction>& given, double friction, double fluid) {
  constexpr int kTogether = 30, kMost = 400;
  const Eigen::Index n = rule_->point.size();
  Eigen::VectorXd applied(2 * n), jump, traction;
  for (Eigen::Index k = 0; k < n; ++k) {
    applied[k] = given[static_cast<std::size_t>(k)].normal;
    applied[n + k] = given[static_cast<std::size_t>(k)].shear;
  }
  Faces out;
  out.settled = false;
  for (int round = 0; round < kMost && !out.settled; ++round) {
    jump = solve(applied, friction, fluid);
    traction = applied - stiffness_ * jump;
    out.settled = !review(jump, traction, friction, fluid, round >= kTogether);
  }
  before_ = jump;
  const Eigen::VectorXd share = jump / line_.length;
  const double factor = modulus_ / 8 * std::sqrt(2 * std::numbers::pi * line_.length);
  const auto intensity = [&](const Eigen::RowVectorXd& tip) {
    return StressIntensity{factor * tip.dot(share.head(n)), factor * tip.dot(share.tail(n))};
  };
  out.end = intensity(rule_->end);
  if (rule_->start.size() > 0) out.start = intensity(rule_->start);
  // of each point half the way to its neighbours
  for (Eigen::Index k = 0; k < n; ++k) {
    const double from = k + 1 < n ? 0.5 * (rule_->point[k] + rule_->point[k + 1]) : 0,
                 to = k > 0 ? 0.5 * (rule_->point[k] + rule_->point[k - 1]) : 1;
    const State s = state_[static_cast<std::size_t>(k)];
    out.open += s == State::open ? to - from : 0;
    out.slipping += s == State::forward || s == State::backward ? to - from : 0;
    out.volume += jump[k] * (to - from) * line_.length;
  }
  return out;
}

}  // namespace railstrata
