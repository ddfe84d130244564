#include "fem/rail_at_rest.hpp"

#include <cmath>

#include "body/field_algebra.hpp"
#include "body/traversal.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr int kMostRestSteps = 20, kMostRestIterations = 20000;
constexpr double kRestTolerance = 1e-7;  // of the first residual
constexpr double kRestForcing = 1e-3;    // of the residual, left over by a linear step

class RailAtRest {
 public:
  RailAtRest(const Body& rail, const PlasticHistory& history, bool endless)
      : rail_(rail), history_(history), endless_(endless), elements_(rail), inverse_(rail.layout.field()) {
    stiffness_diagonal(rail_, inverse_);
    rail_.ties.apply_transpose(inverse_);
    for (std::size_t i = 0; i < inverse_.size(); ++i)
      inverse_[i] = rail_.inverse_mass[i] > 0 && inverse_[i] > 0 ? 1 / inverse_[i] : 0;
    make_uniform(inverse_);
  }

  Field solve() {
    Field u = rail_.layout.field();
    double first = 0;
    for (int step = 0; step < kMostRestSteps; ++step) {
      Field r = residual(u);
      const double size = std::sqrt(dot(r, r));
      if (step == 0) first = size;
      if (size <= kRestTolerance * first) return u;
      conjugate_gradients(r, std::max(kRestForcing * size, 0.3 * kRestTolerance * first));
      rail_.ties.apply_homogeneous(r);
      add(u, 1.0, r);
    }
    throw NumericalError("the rail at rest finds no equilibrium with its plastic strains");
  }

 private:
  /// Endless rail: replaces f by its mean along the sweep, the orthogonal projection on uniform fields.
  void make_uniform(Field& f) const {
    if (!endless_) return;
    for_each(static_cast<std::ptrdiff_t>(rail_.lines.size()), [&](std::ptrdiff_t k) {
      const NodeLine& l = rail_.lines[k];
      double sum = 0;
      for (int j = 0; j < l.count; ++j) sum += f[l.first + j];
      for (int j = 0; j < l.count; ++j) f[l.first + j] = sum / l.count;
    });
  }
  Field residual(Field& u) {
    Field f = rail_.layout.field();
    elements_.internal_force(u, 0, f, history_);
    for (double& v : f) v = -v;
    rail_.ties.apply_transpose(f);
    clear_held(rail_, f);
    make_uniform(f);
    return f;
  }
  void stiffness(Field& x, Field& y) {
    free_stiffness(elements_, x, y);
    make_uniform(y);
    clear_held(rail_, x);
  }
  /// Solves for r in place, down to |r| <= wanted.
  void conjugate_gradients(Field& r, double wanted) {
    Field x = rail_.layout.field(), z = x, p = x, q = x;
    double rz = 1;
    for (int iteration = 0; iteration < kMostRestIterations && dot(r, r) > wanted * wanted; ++iteration) {
      for_each(static_cast<std::ptrdiff_t>(z.size()), [&](std::ptrdiff_t i) { z[i] = inverse_[i] * r[i]; });
      const double next = dot(r, z);
      scale_and_add(p, iteration > 0 ? next / rz : 0.0, z);
      rz = next;
      stiffness(p, q);
      const double alpha = rz / dot(p, q);
      add(x, alpha, p);
      add(r, -alpha, q);
    }
    r = std::move(x);
  }

  const Body& rail_;
  const PlasticHistory& history_;
  bool endless_;
  Traversal elements_;
  Field inverse_;
};

}  // namespace

Field rail_at_rest(const RollingSystem& system, const PlasticHistory& history, bool endless) {
  return RailAtRest(system.rail(), history, endless).solve();
}

}  // namespace railstrata
