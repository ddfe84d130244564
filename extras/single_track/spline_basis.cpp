#include "single_track/spline_basis.hpp"

#include <algorithm>
#include <array>

namespace railstrata {
namespace {

/// Cubic B-splines span - 3 .. span of knots at t with two derivatives, by the recurrence of de Boor and Cox.
std::array<SplineTerm, 4> cubics(const std::vector<double>& knots, int span, double t) {
  // Values of degree d: n[d][j] belongs to spline span - d + j.
  std::array<std::array<double, 4>, 4> n{};
  n[0][0] = 1;
  for (int d = 1; d < 4; ++d)
    for (int j = 0; j <= d; ++j) {
      const int i = span - d + j;
      double v = 0;
      if (j > 0) v += n[d - 1][j - 1] * (t - knots[i]) / (knots[i + d] - knots[i]);
      if (j < d) v += n[d - 1][j] * (knots[i + d + 1] - t) / (knots[i + d + 1] - knots[i + 1]);
      n[d][j] = v;
    }
  // N' of degree d = d (N_i / (t_{i+d} - t_i) - N_{i+1} / (t_{i+d+1} - t_{i+1})) of degree d - 1.
  const auto derivative = [&](int d, int j, const auto& lower) {
    const int i = span - d + j;
    double v = 0;
    if (j > 0) v += lower(j - 1) / (knots[i + d] - knots[i]);
    if (j < d) v -= lower(j) / (knots[i + d + 1] - knots[i + 1]);
    return d * v;
  };
  std::array<SplineTerm, 4> out{};
  for (int j = 0; j < 4; ++j) {
    out[j].unknown = span - 3 + j;
    out[j].value = n[3][j];
    out[j].slope = derivative(3, j, [&](int l) { return n[2][l]; });
    out[j].curvature = derivative(3, j, [&](int l) { return derivative(2, l, [&](int m) { return n[1][m]; }); });
  }
  return out;
}

}  // namespace

SplineBasis::SplineBasis(const std::vector<double>& knots, SplineEnd left, SplineEnd right)
    : left_(left), right_(right) {
  const double from = knots.front(), to = knots.back();
  const std::size_t n = knots.size();
  for (std::size_t k = 3; k >= 1; --k) knots_.push_back(left == SplineEnd::open ? from : 2 * from - knots[k]);
  knots_.insert(knots_.end(), knots.begin(), knots.end());
  for (std::size_t k = 1; k <= 3; ++k) knots_.push_back(right == SplineEnd::open ? to : 2 * to - knots[n - 1 - k]);
}

int SplineBasis::partner(int spline) const {
  const int last = static_cast<int>(knots_.size());
  if (left_ == SplineEnd::mirrored && spline <= 2) return 2 - spline;
  if (right_ == SplineEnd::mirrored && spline >= last - 7) return 2 * last - 12 - spline;
  return -1;
}

SplineBasis::Unknowns SplineBasis::unknowns(bool odd, int order_left, int order_right) const {
  Unknowns u;
  const int n = splines();
  u.of.assign(static_cast<std::size_t>(n), -1);
  u.sign.assign(static_cast<std::size_t>(n), 1);
  const int first = left_ == SplineEnd::mirrored ? 1 : order_left,
            end = right_ == SplineEnd::mirrored ? n - 1 : n - order_right;
  for (int s = first; s < end; ++s)
    if (!(odd && partner(s) == s)) u.of[s] = u.count++;
  for (const int s : {0, n - 1})
    if (const int p = partner(s); p >= 0) {
      u.of[s] = u.of[p];
      u.sign[s] = odd ? -1 : 1;
    }
  return u;
}

SplineTerms SplineBasis::at(double t, bool right_side, const Unknowns& unknowns) const {
  const auto begin = knots_.begin() + 3, end = knots_.end() - 3;
  const auto next = right_side ? std::upper_bound(begin, end, t) : std::lower_bound(begin, end, t);
  int span = static_cast<int>(next - knots_.begin()) - 1;
  span = std::clamp(span, 3, splines() - 1);
  SplineTerms terms;
  for (const SplineTerm& c : cubics(knots_, span, t)) {
    const int unknown = unknowns.of[c.unknown];
    if (unknown < 0) continue;
    const double sign = unknowns.sign[c.unknown];
    const auto same =
        std::find_if(terms.begin(), terms.end(), [&](const SplineTerm& k) { return k.unknown == unknown; });
    SplineTerm& term = same == terms.end() ? terms.emplace_back(SplineTerm{.unknown = unknown}) : *same;
    term.value += sign * c.value;
    term.slope += sign * c.slope;
    term.curvature += sign * c.curvature;
  }
  return terms;
}

}  // namespace railstrata
