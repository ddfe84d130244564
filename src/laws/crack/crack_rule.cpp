#include "crack/crack_rule.hpp"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <vector>

#include "crack/gauss.hpp"

namespace railstrata {
namespace {

using std::numbers::pi;

/// Legendre's functions of both kinds, orders 0 to n, at -1 < x < 1.
struct Legendre {
  std::vector<double> p, q;
};
Legendre legendre(int n, double x) {
  Legendre f{{1, x}, {std::atanh(x), x * std::atanh(x) - 1}};
  for (int m = 1; m < n; ++m)
    for (std::vector<double>* of : {&f.p, &f.q})
      of->push_back(
          ((2 * m + 1) * x * (*of)[static_cast<std::size_t>(m)] - m * (*of)[static_cast<std::size_t>(m) - 1]) /
          (m + 1));
  return f;
}

/// Where a function of one sign on either side vanishes.
template <class F>
double zero_between(double low, double high, const F& f) {
  const bool rising = f(high) > 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0) == rising ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// r/c of 1 - r/c = w².
constexpr auto share_of = [](double w) { return 1 - w * w; };

/// Panels of 1 - w that halve towards the mouth, to its nearest point.
template <class Values>
void add_panels(const Values& values_at, const Eigen::MatrixXd& density, double nearest, CrackRule& rule) {
  const int panels = 2 + static_cast<int>(std::ceil(-std::log2(nearest)));
  rule.image_node.resize(panels * static_cast<int>(kGauss8.size()));
  rule.image_density.resize(panels * static_cast<int>(kGauss8.size()), density.cols());
  double low = 0.5, high = 1;  // of 1 - w
  for (int i = 0, at = 0; i < panels; ++i) {
    if (i + 1 == panels) low = 0;
    for (const GaussPoint& g : kGauss8) {
      const double place = 1 - (low + (high - low) * g.node);
      rule.image_node[at] = share_of(place);
      rule.image_density.row(at++) = (high - low) * g.weight * values_at(place) * density;
    }
    high = low;
    low *= 0.5;
  }
}

CrackRule mouth_rule(int n) {
  const int order = 2 * n;
  const auto last = static_cast<std::size_t>(order);
  const auto p = [&](double w) { return legendre(order, w).p[last]; };
  const auto q = [&](double w) { return legendre(order, w).q[last]; };
  // zeros of P lie one by one between multiples of pi/(2n + 1/2) of arccos, those of Q between the zeros of P
  Eigen::VectorXd w(n), v(n);
  for (int j = 0; j < n; ++j) {
    const double step = pi / (order + 0.5);
    w[j] = zero_between(std::cos((n - j) * step), std::cos((n - j - 0.5) * step), p);
  }
  for (int j = 0; j < n; ++j) v[j] = zero_between(w[j], j + 1 < n ? w[j + 1] : 1 - 1e-14, q);

  // a density that is an even polynomial in w, by Legendre's: its value at a place from those at the nodes, and its
  // integral from the tip, each polynomial's being the difference of its neighbours
  Eigen::VectorXd weight(n);
  std::vector<Legendre> at_node;
  for (int j = 0; j < n; ++j) {
    const Legendre& at = at_node.emplace_back(legendre(order, w[j]));
    const double slope = order * (at.p[last - 1] - w[j] * at.p[last]) / (1 - w[j] * w[j]);
    weight[j] = 2 / ((1 - w[j] * w[j]) * slope * slope);
  }
  const auto values_at = [&](double place) {
    const Legendre there = legendre(order, place);
    Eigen::RowVectorXd out = Eigen::RowVectorXd::Zero(n);
    for (int j = 0; j < n; ++j)
      for (std::size_t m = 0; m < last; m += 2)
        out[j] +=
            weight[j] * (2.0 * static_cast<double>(m) + 1) * at_node[static_cast<std::size_t>(j)].p[m] * there.p[m];
    return out;
  };
  Eigen::MatrixXd jump(n, n);  // g/c at the points from the density at the nodes
  for (int k = 0; k < n; ++k) {
    const Legendre there = legendre(order, v[k]);
    for (int j = 0; j < n; ++j) {
      double sum = there.p[1];
      for (std::size_t m = 2; m < last; m += 2)
        sum += at_node[static_cast<std::size_t>(j)].p[m] * (there.p[m + 1] - there.p[m - 1]);
      jump(k, j) = weight[j] * sum;
    }
  }
  CrackRule rule;
  rule.node = w.unaryExpr(share_of);
  rule.point = v.unaryExpr(share_of);
  const Eigen::MatrixXd density = jump.inverse();
  rule.density = weight.asDiagonal() * density;
  rule.end = values_at(0) * density;
  add_panels(values_at, density, 1 - v[n - 1], rule);
  return rule;
}

CrackRule inside_rule(int n) {
  CrackRule rule;
  rule.node.resize(n);
  rule.point.resize(n - 1);
  Eigen::MatrixXd waves(n - 1, n - 1);  // amplitudes of sin(m theta) in g/c, from its values
  for (int k = 1; k < n; ++k) {
    rule.point[k - 1] = 0.5 * (1 + std::cos(pi * k / n));
    for (int m = 1; m < n; ++m) waves(m - 1, k - 1) = 2.0 / n * std::sin(pi * m * k / n);
  }
  Eigen::MatrixXd slopes(n, n - 1);
  Eigen::RowVectorXd end(n - 1), start(n - 1);
  for (int m = 1; m < n; ++m) {
    for (int j = 0; j < n; ++j) {
      const double theta = pi * (2 * j + 1) / (2 * n);
      rule.node[j] = 0.5 * (1 + std::cos(theta));
      slopes(j, m - 1) = 2 * m * std::cos(m * theta);
    }
    end[m - 1] = 2 * m;
    start[m - 1] = m % 2 ? 2 * m : -2 * m;
  }
  rule.density = pi / (2 * n) * slopes * waves;
  rule.image_node = rule.node;
  rule.image_density = rule.density;
  rule.end = end * waves;
  rule.start = start * waves;
  return rule;
}

}  // namespace

const CrackRule& crack_rule(CrackKind kind, int n) {
  static std::mutex lock;
  static std::map<std::pair<CrackKind, int>, CrackRule> rules;
  const std::lock_guard hold(lock);
  const auto found = rules.find({kind, n});
  if (found != rules.end()) return found->second;
  return rules.emplace(std::pair{kind, n}, kind == CrackKind::mouth ? mouth_rule(n) : inside_rule(n)).first->second;
}

}  // namespace railstrata
