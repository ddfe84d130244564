#include "damage/enclosing_ball.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace railstrata {
namespace {

using Matrix5 = std::array<Vec5, 5>;

/// Points moved to the first one, free coordinates in front; the fixed ones are in `fixed`.
struct Lifted {
  int dimensions = 0;
  std::array<int, 5> axis{};
  Vec5 origin{};
  std::vector<Vec5> free;
  std::vector<double> fixed;  ///< squared distance that no centre changes
};

Lifted lifted(std::span<const Vec5> points, FreeDirections free) {
  assert(!points.empty());
  Lifted l;
  for (int d = 0; d < 5; ++d)
    if (free >> d & 1U) l.axis[l.dimensions++] = d;
  for (int a = 0; a < l.dimensions; ++a) l.origin[a] = points[0][l.axis[a]];
  l.free.resize(points.size());
  l.fixed.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int d = 0; d < 5; ++d)
      if (!(free >> d & 1U)) l.fixed[i] += points[i][d] * points[i][d];
    for (int a = 0; a < l.dimensions; ++a) l.free[i][a] = points[i][l.axis[a]] - l.origin[a];
  }
  return l;
}

/// The points on the sphere so far, affinely independent, with their weights; the centre is their weighted mean.
class ActiveSet {
 public:
  explicit ActiveSet(const Lifted& points) : points_(points) {}
  void start(int first) {
    count_ = 1;
    index_[0] = first;
    weight_[0] = 1;
    centre_ = points_.free[first];
  }
  double squared_distance(int i) const {
    double sum = points_.fixed[i];
    for (int a = 0; a < points_.dimensions; ++a) {
      const double d = points_.free[i][a] - centre_[a];
      sum += d * d;
    }
    return sum;
  }
  double squared_radius() const {
    double largest = 0;
    for (int s = 0; s < count_; ++s) largest = std::max(largest, squared_distance(index_[s]));
    return largest;
  }
  bool holds(int i) const { return std::find(index_.begin(), index_.begin() + count_, i) != index_.begin() + count_; }

  /// Takes point q, which lies outside, onto the sphere. Those of the set whose weights vanish on the way drop out.
  void add(int q) {
    double weight_q = 0;
    while (true) {
      const Step step = towards(q);
      double length = step.full;
      int drops = -1;
      for (int s = 0; s < count_; ++s)
        if (step.share[s] > 0 && weight_[s] <= length * step.share[s]) {
          length = weight_[s] / step.share[s];
          drops = s;
        }
      for (int s = 0; s < count_; ++s) weight_[s] = std::max(0., weight_[s] - length * step.share[s]);
      weight_q += length;
      for (int a = 0; a < points_.dimensions; ++a) centre_[a] += length * step.direction[a];
      if (drops < 0) break;
      erase(drops);
      if (count_ == 0) return start(q);
    }
    index_[count_] = q;
    weight_[count_] = weight_q;
    ++count_;
  }

  EnclosingBall ball(double squared_radius) const {
    EnclosingBall b;
    for (int a = 0; a < points_.dimensions; ++a) b.centre[points_.axis[a]] = centre_[a] + points_.origin[a];
    b.radius = std::sqrt(squared_radius);
    for (int s = 0; s < count_; ++s) {
      if (!(weight_[s] > 0)) continue;
      b.support[b.support_count] = index_[s];
      b.weight[b.support_count++] = weight_[s];
    }
    return b;
  }

 private:
  struct Step {
    std::array<double, 6> share{};  ///< weights that fall as q's rises
    Vec5 direction{};               ///< of the centre
    double full = 0;                ///< weight at which q is on the sphere
  };

  /// The centre moves perpendicular to the flat of the set, towards q.
  Step towards(int q) const {
    const int n = points_.dimensions, m = count_ - 1;
    const Vec5& base = points_.free[index_[0]];
    Matrix5 basis{};  // orthonormal, of the flat's directions, with the triangle that leads back to the points
    Matrix5 triangle{};
    const auto project = [&](Vec5 v, int columns, Vec5& parts) {
      for (int round = 0; round < 2; ++round)
        for (int c = 0; c < columns; ++c) {
          double part = 0;
          for (int a = 0; a < n; ++a) part += basis[c][a] * v[a];
          for (int a = 0; a < n; ++a) v[a] -= part * basis[c][a];
          parts[c] += part;
        }
      return v;
    };
    for (int c = 0; c < m; ++c) {
      Vec5 v{};
      for (int a = 0; a < n; ++a) v[a] = points_.free[index_[c + 1]][a] - base[a];
      v = project(v, c, triangle[c]);
      const double length = std::sqrt(norm_squared(v));
      triangle[c][c] = length;
      for (int a = 0; a < n; ++a) basis[c][a] = length > 0 ? v[a] / length : 0;
    }
    Vec5 to_q{}, parts{};
    for (int a = 0; a < n; ++a) to_q[a] = points_.free[q][a] - base[a];
    Step step;
    step.direction = project(to_q, m, parts);
    double others = 0;
    for (int c = m - 1; c >= 0; --c) {
      double sum = parts[c];
      for (int d = c + 1; d < m; ++d) sum -= step.share[d + 1] * triangle[d][c];
      step.share[c + 1] = triangle[c][c] > 0 ? sum / triangle[c][c] : 0;
      others += step.share[c + 1];
    }
    step.share[0] = 1 - others;
    const double height = norm_squared(step.direction);
    if (m == n || height <= 1e-26 * norm_squared(to_q)) {  // q lies in the flat: weights move, the centre stays
      step.direction = {};
      step.full = std::numeric_limits<double>::infinity();
    } else {
      step.full = std::max(0., squared_distance(q) - squared_distance(index_[0])) / (2 * height);
    }
    return step;
  }

  void erase(int s) {
    for (int t = s; t + 1 < count_; ++t) {
      index_[t] = index_[t + 1];
      weight_[t] = weight_[t + 1];
    }
    --count_;
  }

  const Lifted& points_;
  int count_ = 0;
  std::array<int, 7> index_{};
  std::array<double, 7> weight_{};
  Vec5 centre_{};
};

}  // namespace

int EnclosingBall::heaviest() const {
  return static_cast<int>(std::max_element(weight.begin(), weight.begin() + support_count) - weight.begin());
}

EnclosingBall enclosing_ball(std::span<const Vec5> points, FreeDirections free) {
  if (points.empty()) return {};
  const Lifted all = lifted(points, free);
  const int n = static_cast<int>(points.size());
  ActiveSet set(all);
  set.start(0);
  double radius = set.squared_radius(), last = -1, distance = 0;
  while (true) {
    int farthest = 0;
    distance = -1;
    for (int i = 0; i < n; ++i)
      if (const double d = set.squared_distance(i); d > distance) {
        distance = d;
        farthest = i;
      }
    // The radius rises with every point that is taken in, but for rounding, which ends it.
    if (!(distance > radius * (1 + 4e-15)) || set.holds(farthest) || !(radius > last)) break;
    last = radius;
    set.add(farthest);
    radius = set.squared_radius();
  }
  return set.ball(distance);
}

}  // namespace railstrata
