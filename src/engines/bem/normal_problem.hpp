#pragma once
// The frictionless (normal) contact problem on a grid of cells.
//
//   gap(x, y) - approach + u_n(p) >= 0,  p >= 0,  one of them zero in every cell,
// u_n the normal elastic displacement of both bodies together (influence_operator.hpp), positive where it opens the
// gap, for a given load F = ∑ p dA or a given approach. Solved by an active-set iteration whose linear problems are
// projected conjugate gradients with an FFT preconditioner. [PolonskyKeer1999, Vollebregt2014]
#include <optional>

#include "bem/gmres.hpp"
#include "bem/influence_operator.hpp"
#include "bem/patch_grid.hpp"
#include "bem/plane_algebra.hpp"

namespace railstrata {

struct NormalTarget {
  std::optional<double> load{};      ///< N
  std::optional<double> approach{};  ///< m; exactly one of the two
};

struct NormalOptions {
  double tolerance =
      1e-7;  ///< largest violation of the contact conditions, relative to the range of the gap over the patch
  double share_of_first = 1;  ///< from a start, what may be left of the violation that it has in this problem, 0 to 1:
                              ///< below 1 small changes of a problem are followed too; as far as round-off allows
  int max_outer = 200;
  static constexpr double kRoundOff = 1e-11;  ///< of both problems' tolerances
};

struct NormalSolution {
  Plane pressure;             ///< Pa
  Plane gap;                  ///< m, deformed: gap + u_n - approach, 0 in the patch
  double approach = 0;        ///< m
  double load = 0;            ///< N
  int iterations = 0;         ///< products with the influence operator
  bool touches_edge = false;  ///< a cell of the outermost ring carries pressure: the grid is too small
};

/// turn: of each row's normal against the approach and the load, rad, [j]; empty: none. With it the gap is along the
/// normals, a rigid approach is delta cos(turn) there, and the load ∑ p cos(turn) dA.
/// gap: undeformed distance of the bodies in each cell [m], any origin; the caller adds to it the normal elastic
/// displacement by a tangential traction (dissimilar bodies). start: pressure of a similar problem, or empty. Throws
/// NumericalError when the iteration does not end.
NormalSolution solve_normal(const InfluenceOperator& influence, const PatchGrid& grid, const Plane& gap,
                            NormalTarget target, const NormalOptions& options = {}, const Plane& start = {},
                            const Plane& turn = {});

/// The pressure in cells in contact that makes a displacement there; each is cheaper than those before.
class NormalInverse {
 public:
  /// pressure: > 0 in contact. influence is kept by reference.
  NormalInverse(const InfluenceOperator& influence, const Plane& pressure);
  /// To what is left of the displacement [m], the root of its squares; zero elsewhere.
  Plane of(const Plane& displacement, double left);

 private:
  const InfluenceOperator& influence_;
  Mask active_;
  RecycledKrylov searched_;
};

}  // namespace railstrata
