#include "fem/preload.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

constexpr double kPenetration = 1e-4;  // of the Hertzian approach
constexpr double kPenaltyScale = 16.0;  // of a surface element's stiffness

// A vector of the static problem: free displacements of both bodies and the axle's height.
struct StaticVector {
  Field rail, wheel;
  double axle = 0;
};

double dot(const Field& a, const Field& b) {
  return ordered_sum(static_cast<std::ptrdiff_t>(a.size()), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double sum = 0;
    for (std::ptrdiff_t i = begin; i < end; ++i) sum += a[i] * b[i];
    return sum;
  });
}
double dot(const StaticVector& a, const StaticVector& b) { return dot(a.rail, b.rail) + dot(a.wheel, b.wheel) + a.axle * b.axle; }

void add(Field& y, double s, const Field& x) {
  for_each(static_cast<std::ptrdiff_t>(y.size()), [&](std::ptrdiff_t i) { y[i] += s * x[i]; });
}
void add(StaticVector& y, double s, const StaticVector& x) {
  add(y.rail, s, x.rail);
  add(y.wheel, s, x.wheel);
  y.axle += s * x.axle;
}

class Preload {
 public:
  explicit Preload(const RollingSystem& system)
      : sys_(system), contact_(system.rail_surface, system.wheel_surface), tractions_(system.rail_surface.columns, system.rail_surface.stations.nodes()) {
    u_ = zero();
    // a few times the stiffness of a surface element: few multiplier updates without spoiling the conditioning
    const auto& depth = sys_.model.rail.contact.depth;
    penalty_ = kPenaltyScale * young(sys_.model.rail_materials.back()) / std::max(depth[1] - depth[0], 0.5e-3);
    diagonal();
  }

  PreloadResult solve(double tolerance, const PreloadProgress& progress, const std::atomic<bool>* stop) {
    const auto start = std::chrono::steady_clock::now();
    start_from_hertz();
    PreloadResult out;
    const double load = load_norm();
    // Outer: multipliers; inner: Newton steps on the exact residual at fixed multipliers (a convex, piecewise quadratic problem).
    double wanted = 1e-2;
    for (int step = 1;; ++step) {
      update_contact();
      StaticVector r = residual();
      out.residual = std::sqrt(dot(r, r)) / load;
      out.newton_steps = step;
      if (progress) progress(out.residual, tolerance, out.cg_iterations);
      if (!std::isfinite(out.residual)) throw NumericalError("static preload: the residual is not a number");
      if (out.residual < wanted) {
        out.penetration = penetration();
        if (out.residual < tolerance && out.penetration < kPenetration * sys_.model.hertz.approach) break;
        wanted = std::max(0.1 * wanted, 0.5 * tolerance);
        augment();
        continue;
      }
      if (step > 80) throw NumericalError(fmt::format("static preload: no equilibrium after {} steps, residual {:.2e} (wanted {:.1e})", step, out.residual, tolerance));
      if (stop && *stop) throw NumericalError("static preload: stopped");
      out.cg_iterations += conjugate_gradients(r, std::clamp(0.1 * wanted / out.residual, 1e-4, 1e-2));
      add(u_, 1.0, r);
      sys_.apply_constraints(u_.rail, u_.wheel, {0, u_.axle, 0});
    }
    out.u_rail = u_.rail;
    out.u_wheel = u_.wheel;
    out.axle_z = u_.axle;
    for (std::size_t k = 0; k < rows_->rows.size(); ++k) {
      const ContactRow& row = rows_->rows[k];
      tractions_.at(row.column, row.station) = {pressure_[k], 0, 0, 0, 0};
      out.contact_force_z += row.area * pressure_[k] * row.normal.z;
    }
    out.tractions = tractions_;
    out.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return out;
  }

 private:
  StaticVector zero() const { return {sys_.rail.solid.layout().field(), sys_.wheel.solid.layout().field(), 0.0}; }

  void start_from_hertz() {
    u_.axle = -sys_.model.hertz.approach;
    for (const DeformableBody::Line& l : sys_.wheel.lines)
      if (l.component == 2) std::fill_n(u_.wheel.begin() + l.first, l.count, u_.axle);
    sys_.apply_constraints(u_.rail, u_.wheel, {0, u_.axle, 0});
  }

  // Weight of everything on its nodes and on the axle; centrifugal forces of a wheel that rolls.
  StaticVector loads() const {
    StaticVector f = zero();
    const double g = sys_.gravity;
    auto weigh = [g](const DeformableBody& body, Field& out) {
      for (const DeformableBody::Line& l : body.lines)
        if (l.component == 2)
          for (int j = 0; j < l.count; ++j) out[l.first + j] = -g * body.mass[l.first + j];
    };
    weigh(sys_.rail, f.rail);
    weigh(sys_.wheel, f.wheel);
    const double spin = sys_.start_spin, spin2 = spin * spin;
    for (const DeformableBody::Line& l : sys_.wheel.lines) {
      if (l.component == 1) continue;
      const Block& block = sys_.model.wheel.blocks[l.block];
      const double z = block.section.nodes[l.node].z;
      for (int j = 0; j < l.count; ++j) {
        const double t = block.stations.at[j];
        f.wheel[l.first + j] += spin2 * sys_.wheel.mass[l.first + j] * (l.component == 0 ? -z * std::sin(t) : z * std::cos(t));
      }
    }
    f.axle = -g * (sys_.axle.mass_z + sys_.model.spec.vehicle.sprung_mass);
    return f;
  }
  double load_norm() const {
    const StaticVector f = loads();
    return std::sqrt(dot(f, f));
  }

  void update_contact() {
    const AxlePose pose{0, u_.axle, 0};
    const double h = sys_.model.spec.mesh.element_size;
    contact_.search(u_.rail, u_.wheel, pose, 2 * sys_.model.hertz.a + 4 * h, 0.3 * sys_.model.hertz.approach);
    rows_ = &contact_.rows(u_.rail, u_.wheel, pose);
    pressure_.clear();
    active_.clear();
    for (const ContactRow& row : rows_->rows) {
      const double p = tractions_.at(row.column, row.station).p - penalty_ * row.gap;
      active_.push_back(p > 0);
      pressure_.push_back(std::max(0.0, p));
    }
  }
  void augment() {
    for (NodeTraction& t : tractions_.all()) t = {};
    for (std::size_t k = 0; k < rows_->rows.size(); ++k) tractions_.at(rows_->rows[k].column, rows_->rows[k].station).p = pressure_[k];
  }
  double penetration() const {
    double worst = 0;
    for (std::size_t k = 0; k < rows_->rows.size(); ++k)
      if (active_[k]) worst = std::max(worst, std::abs(rows_->rows[k].gap));
    return worst;
  }

  // Adds scale * a_A p_A on both surfaces: pushes the rail down and the wheel up.
  void push(std::size_t k, double p, Field& rail, Field& wheel) const {
    const ContactRow& row = rows_->rows[k];
    const double n[3] = {row.normal.x, row.normal.y, row.normal.z};
    for (int i = 0; i < 3; ++i) {
      const double force = row.area * p * n[i];
      rail[row.rail + i * sys_.rail_surface.stride] -= force;
      for (int w = row.first; w < row.first + row.count; ++w) wheel[rows_->weights[w].wheel + i * sys_.wheel_surface.stride] += rows_->weights[w].m * force;
    }
  }

  // Forces on constrained nodes go to what carries them.
  void reduce(StaticVector& f) const {
    sys_.rail.ties.collect(f.rail);
    sys_.wheel.ties.collect(f.wheel);
    for (const BoreNode& n : sys_.axle.bore) f.axle += f.wheel[n.index + 2 * n.stride];
    mask(sys_.rail, f.rail);
    mask(sys_.wheel, f.wheel);
  }
  static void mask(const DeformableBody& body, Field& f) {
    for_each(static_cast<std::ptrdiff_t>(f.size()), [&](std::ptrdiff_t i) {
      if (body.inverse_mass[i] == 0) f[i] = 0;
    });
  }

  StaticVector residual() {
    StaticVector r = zero();
    sys_.rail.solid.internal_force(u_.rail, 0, r.rail);
    sys_.wheel.solid.internal_force(u_.wheel, 0, r.wheel);
    for (double& v : r.rail) v = -v;
    for (double& v : r.wheel) v = -v;
    for (std::size_t k = 0; k < rows_->rows.size(); ++k)
      if (pressure_[k] > 0) push(k, pressure_[k], r.rail, r.wheel);
    reduce(r);
    add(r, 1.0, loads());
    return r;
  }

  // y = (K + eps G^T a G) x on the free degrees of freedom; x keeps its constrained values consistent.
  void apply(StaticVector& x, StaticVector& y) {
    for (const BoreNode& n : sys_.axle.bore) {
      x.wheel[n.index] = x.wheel[n.index + n.stride] = 0;
      x.wheel[n.index + 2 * n.stride] = x.axle;
    }
    sys_.rail.ties.spread(x.rail, 0, true);
    sys_.wheel.ties.spread(x.wheel, 0, true);
    sys_.rail.solid.linear_force(x.rail, y.rail);
    sys_.wheel.solid.linear_force(x.wheel, y.wheel);
    y.axle = 0;
    for (std::size_t k = 0; k < rows_->rows.size(); ++k)
      if (active_[k]) push(k, penalty_ * gap_change(k, x), y.rail, y.wheel);
    reduce(y);
    // constrained entries of x are not unknowns
    mask(sys_.rail, x.rail);
    mask(sys_.wheel, x.wheel);
  }
  double gap_change(std::size_t k, const StaticVector& x) const {
    const ContactRow& row = rows_->rows[k];
    const double n[3] = {row.normal.x, row.normal.y, row.normal.z};
    double g = 0;
    for (int i = 0; i < 3; ++i) {
      double w = -x.rail[row.rail + i * sys_.rail_surface.stride];
      for (int j = row.first; j < row.first + row.count; ++j) w += rows_->weights[j].m * x.wheel[rows_->weights[j].wheel + i * sys_.wheel_surface.stride];
      g += n[i] * w;
    }
    return g;
  }

  void diagonal() {
    preconditioner_ = zero();
    sys_.rail.solid.stiffness_diagonal(preconditioner_.rail);
    sys_.wheel.solid.stiffness_diagonal(preconditioner_.wheel);
    StaticVector d = preconditioner_;
    sys_.rail.ties.collect(d.rail);
    sys_.wheel.ties.collect(d.wheel);
    double axle = 0;
    for (const BoreNode& n : sys_.axle.bore) axle += d.wheel[n.index + 2 * n.stride];
    auto invert = [](const DeformableBody& body, Field& f) {
      for (std::size_t i = 0; i < f.size(); ++i) f[i] = body.inverse_mass[i] > 0 && f[i] > 0 ? 1 / f[i] : 0;
    };
    invert(sys_.rail, d.rail);
    invert(sys_.wheel, d.wheel);
    d.axle = 1 / axle;
    preconditioner_ = std::move(d);
  }
  // The contact's share of the diagonal, for the present active set.
  StaticVector with_contact() const {
    StaticVector d = preconditioner_;
    auto stiffen = [&](Field& f, std::ptrdiff_t i, double k) {
      if (f[i] > 0) f[i] = 1 / (1 / f[i] + k);
    };
    for (std::size_t k = 0; k < rows_->rows.size(); ++k) {
      if (!active_[k]) continue;
      const ContactRow& row = rows_->rows[k];
      const double n2[3] = {row.normal.x * row.normal.x, row.normal.y * row.normal.y, row.normal.z * row.normal.z};
      for (int i = 0; i < 3; ++i) {
        stiffen(d.rail, row.rail + i * sys_.rail_surface.stride, penalty_ * row.area * n2[i]);
        for (int w = row.first; w < row.first + row.count; ++w)
          stiffen(d.wheel, rows_->weights[w].wheel + i * sys_.wheel_surface.stride, penalty_ * row.area * n2[i] * rows_->weights[w].m * rows_->weights[w].m);
      }
    }
    return d;
  }
  static void precondition(const StaticVector& inverse, const StaticVector& r, StaticVector& z) {
    for_each(static_cast<std::ptrdiff_t>(r.rail.size()), [&](std::ptrdiff_t i) { z.rail[i] = inverse.rail[i] * r.rail[i]; });
    for_each(static_cast<std::ptrdiff_t>(r.wheel.size()), [&](std::ptrdiff_t i) { z.wheel[i] = inverse.wheel[i] * r.wheel[i]; });
    z.axle = inverse.axle * r.axle;
  }

  // Solves for r in place; returns the number of iterations.
  int conjugate_gradients(StaticVector& r, double tolerance) {
    const StaticVector inverse = with_contact();
    StaticVector x = zero(), z = zero(), p, q = zero();
    precondition(inverse, r, z);
    p = z;
    double rz = dot(r, z);
    const double wanted = tolerance * tolerance * rz;
    int iteration = 0;
    for (; iteration < 5000 && rz > wanted; ++iteration) {
      apply(p, q);
      const double alpha = rz / dot(p, q);
      add(x, alpha, p);
      add(r, -alpha, q);
      precondition(inverse, r, z);
      const double next = dot(r, z), beta = next / rz;
      rz = next;
      for_each(static_cast<std::ptrdiff_t>(p.rail.size()), [&](std::ptrdiff_t i) { p.rail[i] = z.rail[i] + beta * p.rail[i]; });
      for_each(static_cast<std::ptrdiff_t>(p.wheel.size()), [&](std::ptrdiff_t i) { p.wheel[i] = z.wheel[i] + beta * p.wheel[i]; });
      p.axle = z.axle + beta * p.axle;
    }
    r = std::move(x);
    return iteration;
  }

  const RollingSystem& sys_;
  MortarContact contact_;
  TractionMemory tractions_;
  StaticVector u_, preconditioner_;
  double penalty_ = 0;
  const MortarRows* rows_ = nullptr;
  std::vector<double> pressure_;
  std::vector<char> active_;
};

}  // namespace

PreloadResult solve_preload(const RollingSystem& system, double tolerance, const PreloadProgress& progress, const std::atomic<bool>* stop) {
  return Preload(system).solve(tolerance, progress, stop);
}

}  // namespace railstrata
