#pragma once
// Cubic B-splines on a line with the conditions that the potentials of a residual stress have at its ends.
#include <vector>

namespace railstrata {

enum class SplineEnd {
  open,     ///< as many splines as there are
  mirrored  ///< the line goes on as its mirror image; three simple knots beside it
};

/// A spline that does not vanish at a point: value, first and second derivative.
struct SplineTerm {
  int unknown = 0;
  double value = 0, slope = 0, curvature = 0;
};
using SplineTerms = std::vector<SplineTerm>;

/// Knots ascending; one that stands twice lets the second derivative jump there, three times the first.
class SplineBasis {
 public:
  SplineBasis(const std::vector<double>& knots, SplineEnd left, SplineEnd right);

  /// An unknown per spline (mirror images are one, at a mirrored end even, or odd, functions): of those that an open
  /// end's conditions leave. `order`: how many of the value and the derivatives vanish at an open end (0, 1, 2).
  struct Unknowns {
    int count = 0;
    std::vector<int> of;       ///< per spline, -1: none
    std::vector<double> sign;  ///< per spline
  };
  Unknowns unknowns(bool odd, int order_left, int order_right) const;

  /// The splines at t, at a multiple knot on its right or left side; ascending unknowns, each once.
  SplineTerms at(double t, bool right_side, const Unknowns& unknowns) const;

 private:
  int splines() const { return static_cast<int>(knots_.size()) - 4; }
  /// The mirror image of a spline, or itself; -1: it does not reach over a mirrored end.
  int partner(int spline) const;
  std::vector<double> knots_;
  SplineEnd left_, right_;
};

}  // namespace railstrata
