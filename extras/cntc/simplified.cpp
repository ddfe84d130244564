#include "cntc/simplified.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "friction/falling_friction.hpp"
#include "halfspace/creep_theories.hpp"

namespace railstrata::cntc {
namespace {

using std::numbers::pi;

struct Ellipse {
  double a = 0, b = 0;
};

/// Of the area of the elements that carry pressure, and as long for its width as they are.
Ellipse ellipse_of_elements(const PatchGrid& g, const Plane& pressure) {
  int count = 0, low_i = g.nx, high_i = 0, low_j = g.ny, high_j = 0;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      if (!(pressure[g.index(i, j)] > 0)) continue;
      ++count;
      low_i = std::min(low_i, i);
      high_i = std::max(high_i, i);
      low_j = std::min(low_j, j);
      high_j = std::max(high_j, j);
    }
  const double length = g.dx * (high_i - low_i + 1), width = g.dy * (high_j - low_j + 1);
  const double mean = std::sqrt(count * g.cell_area() / pi), stretch = std::sqrt(length / width);
  return {mean * stretch, mean / stretch};
}

CreepCoefficients creep_coefficients(Ellipse e, double poisson) {
  constexpr double kWidest = 9.9;  // CONTACT's table ends here
  const double ratio = e.a / e.b;
  if (!(ratio >= 1 / kWidest && ratio <= kWidest))
    throw Refused(kOther, fmt::format("M = 3 and 5 have creep coefficients for a/b from {:.3g} to {:g}, not {:.3g}",
                                      1 / kWidest, kWidest, ratio));
  return kalker_coefficients_by_inverse(ratio, poisson);
}

/// L1, L2, L3 of small creepages [Kalker1982], m/Pa, and with creepage on to the one that makes the same work of all
/// three, which is reached at three times the creepage of saturation [VollebregtVoltr2023]. bound: f F_n, N.
std::array<double, 3> flexibilities(Ellipse e, const PairModuli& m, double bound, const Creepage& c) {
  const CreepCoefficients k = creep_coefficients(e, m.poisson);
  const double G = m.shear;
  std::array<double, 3> L{8 * e.a / (3 * k.c11 * G), 8 * e.a / (3 * k.c22 * G),
                          pi * e.a * std::sqrt(e.a / e.b) / (4 * k.c23 * G)};
  const double spin = c.spin * 3 * pi * e.a / 32;
  const double all = c.x * c.x + c.y * c.y + spin * spin;
  if (all == 0) return L;
  const double one = all / (c.x * c.x / L[0] + c.y * c.y / L[1] + spin * spin / L[2]);
  const double saturated = bound / (e.a * e.b * G) * std::hypot(1 / k.c11, 1 / k.c22);
  const double weight = std::min(1.0, std::hypot(c.x, c.y) / saturated / 3);
  for (double& l : L) l += weight * (one - l);
  return L;
}

class Rows {
 public:
  Rows(const Materials& materials, const Hertz& hertz, const PatchGrid& g, const NormalSolution& normal,
       const RollingContact& c)
      : g_(g),
        pressure_(normal.pressure),
        c_(c),
        theory_(*materials.simplified),
        moduli_(pair_moduli(materials)),
        elements_(ellipse_of_elements(g, normal.pressure)),
        load_(normal.load),
        creepage_{c.x.creepage, c.y.creepage, c.spin} {
    L_ = flexibilities(hertz.a > 0 ? Ellipse{hertz.a, hertz.b} : elements_, moduli_, c.friction * load_, creepage_);
    spin_x_ = L_[0] / L_[2] * c.spin;
    spin_y_ = L_[1] / L_[2] * c.spin;
    reduce();
    blank();
  }

  SimplifiedSolution solve() {
    for (int j = 0; j < g_.ny; ++j) {
      row(j);
      if (theory_.strips) strip(j);
    }
    add_up();
    return std::move(out_);
  }

 private:
  /// k = k0 (alpha + (1 - alpha) / (1 + beta eps)), eps the slope of the linear theory over that of saturation; the
  /// coefficient of friction is that of the whole creepage. [SpiryaginPolachCole2013]
  void reduce() {
    const double turned = creepage_.y + creepage_.spin * elements_.a;
    const double side = std::abs(turned) < std::abs(creepage_.y) ? creepage_.y : turned;
    const double slip = c_.speed * std::hypot(creepage_.x, creepage_.y);
    // FaStrip has the coefficient at rest in its rows.
    const double falls = friction_share(c_.falling, slip).value;
    out_.friction = c_.friction * (theory_.strips ? 1 : falls);
    const double c11 = creep_coefficients(elements_, moduli_.poisson).c11;
    const double eps = moduli_.shear * pi * elements_.a * elements_.b * theory_.k0 * c11 *
                       std::hypot(creepage_.x, side) / (4 * c_.friction * falls * load_);
    out_.reduction = theory_.k0 * (theory_.alpha + (1 - theory_.alpha) / (1 + theory_.beta * eps));
    out_.flexibility = {L_[0] / out_.reduction, L_[1] / out_.reduction};
  }

  void blank() {
    TangentialSolution& t = out_.tangential;
    for (Plane* plane : {&t.q_x, &t.q_y, &t.slip.x, &t.slip.y}) plane->assign(g_.size(), 0.0);
    t.state.assign(g_.size(), ContactState::separated);
    t.bound = pressure_;
    for (double& value : t.bound) value *= out_.friction;
    t.creepage_x = creepage_.x;
    t.creepage_y = creepage_.y;
  }

  /// The spin at a sixth of an element ahead of the middle, as in the full theory.
  double rigid_x(int j, std::size_t k) const {
    return creepage_.x - spin_x_ * g_.y(j) + (c_.extra_slip.x.empty() ? 0 : c_.extra_slip.x[k]);
  }
  double rigid_y(int i, std::size_t k) const {
    return creepage_.y + spin_y_ * (g_.x(i) + g_.dx / 6) + (c_.extra_slip.y.empty() ? 0 : c_.extra_slip.y[k]);
  }

  void row(int j) {
    TangentialSolution& t = out_.tangential;
    const auto [by_x, by_y] = out_.flexibility;
    double u_x = 0, u_y = 0;
    for (int i = g_.nx - 1; i >= 0; --i) {
      const std::size_t k = g_.index(i, j);
      if (!(pressure_[k] > 0)) {
        u_x = u_y = 0;
        continue;
      }
      u_x += g_.dx * rigid_x(j, k);
      u_y += g_.dx * rigid_y(i, k);
      t.q_x[k] = u_x / by_x;
      t.q_y[k] = u_y / by_y;
      t.state[k] = ContactState::stick;
      if (!(std::hypot(t.q_x[k], t.q_y[k]) > t.bound[k])) continue;
      cut(k);
      t.slip.x[k] = (u_x - by_x * t.q_x[k]) / g_.dx;
      t.slip.y[k] = (u_y - by_y * t.q_y[k]) / g_.dx;
      u_x = by_x * t.q_x[k];
      u_y = by_y * t.q_y[k];
    }
  }

  /// What slips carries its bound.
  void cut(std::size_t k) {
    TangentialSolution& t = out_.tangential;
    const double size = std::hypot(t.q_x[k], t.q_y[k]), part = size > 0 ? t.bound[k] / size : 0;
    t.q_x[k] *= part;
    t.q_y[k] *= part;
    t.state[k] = ContactState::slip;
  }

  /// The traction of strip theory where it sticks, in units of f p0: (kappa, lambda) of the whole strip less (kappa,
  /// lambda - spin) of its sticking part, which ends at its leading edge and is 2 d shorter. [SichaniEnblomBerg2016]
  struct Strip {
    double half = 0, middle = 0, d = 0;  ///< m
    double kappa = 0, lambda = 0, spin = 0;
    bool sticks(double x) const { return x > 2 * d - half; }
  };

  Strip strip_of(int j, Strip s) const {
    const auto [a, b] = elements_;
    const double f_p0 = c_.friction * 1.5 * load_ / (pi * a * b), nu = moduli_.poisson;
    const double unit = moduli_.shear / (2 * f_p0 * pi);
    const CreepCoefficients c = creep_coefficients(elements_, nu);
    s.spin = unit * 3 * std::sqrt(a * b) * c.c23 * creepage_.spin;
    const double along = unit * 4 * (1 - nu) / pi * c.c11 * creepage_.x - s.spin * g_.y(j) / a;
    const double across = unit * 4 * (1 - nu) / pi * c.c22 * creepage_.y;
    const double left = 1 - s.spin * s.spin, root = across * across + left * along * along;
    s.d = s.half + a;  // slips everywhere
    constexpr double kNear = 1e-6;
    if (std::abs(left) > kNear && root >= 0) {
      const double d = (std::sqrt(root) + across * s.spin) / left * a / (1 - nu);
      if (d >= 0) s.d = d;
    }
    const double sideways = across + s.spin * s.d / a, size = std::hypot(along, sideways);
    s.kappa = size > 0 ? along / size : 0;
    s.lambda = size > 0 ? sideways / size : 0;
    return s;
  }

  std::array<double, 2> traction(const Strip& s, double x) const {
    const double a = elements_.a, inner = s.half - s.d;
    const double whole = std::sqrt(std::max(0.0, s.half * s.half - x * x)) / a;
    const double part = std::sqrt(std::max(0.0, inner * inner - (x - s.d) * (x - s.d))) / a;
    return {s.kappa * (whole - part), s.lambda * whole - (s.lambda - s.spin) * part};
  }

  /// Strip theory where it sticks, the direction of FASTSIM where it slips. A strip whose sticking part would carry
  /// more than f p0 is left to FASTSIM.
  void strip(int j) {
    int first = g_.nx, last = -1;
    for (int i = 0; i < g_.nx; ++i)
      if (pressure_[g_.index(i, j)] > 0) {
        first = std::min(first, i);
        last = i;
      }
    if (last < 0) return;
    const double half = 0.5 * g_.dx * (last - first + 1), middle = 0.5 * (g_.x(first) + g_.x(last));
    const Strip s = strip_of(j, {half, middle, 0, 0, 0, 0});
    for (int i = first; i <= last; ++i) {
      const double x = g_.x(i) - middle;
      const auto [x_part, y_part] = traction(s, x);
      if (s.sticks(x) && std::hypot(x_part, y_part) > 1) return;
    }
    for (int i = first; i <= last; ++i)
      if (pressure_[g_.index(i, j)] > 0) of_strip(s, i, j);
  }

  void of_strip(const Strip& s, int i, int j) {
    TangentialSolution& t = out_.tangential;
    const std::size_t k = g_.index(i, j);
    const double x = g_.x(i) - s.middle;
    if (!s.sticks(x)) {
      cut(k);
      return;
    }
    const auto [along, across] = traction(s, x);
    const double f_p0 = c_.friction * 1.5 * load_ / (pi * elements_.a * elements_.b);
    t.q_x[k] = f_p0 * along;
    t.q_y[k] = f_p0 * across;
    t.slip.x[k] = t.slip.y[k] = 0;
    t.state[k] = ContactState::stick;
  }

  void add_up() {
    TangentialSolution& t = out_.tangential;
    t.cell_slip = t.slip;
    for (int i = 0; i < g_.nx; ++i)
      for (int j = 0; j < g_.ny; ++j) {
        const std::size_t k = g_.index(i, j);
        const double area = g_.cell_area();
        t.force_x += area * t.q_x[k];
        t.force_y += area * t.q_y[k];
        t.moment += area * (g_.x(i) * t.q_y[k] - g_.y(j) * t.q_x[k]);
        t.dissipation += area * (t.q_x[k] * t.slip.x[k] + t.q_y[k] * t.slip.y[k]);
        (t.state[k] == ContactState::slip ? t.slip_area : t.stick_area) += pressure_[k] > 0 ? area : 0;
      }
  }

  const PatchGrid& g_;
  const Plane& pressure_;
  const RollingContact& c_;
  SimplifiedTheory theory_;
  PairModuli moduli_;
  Ellipse elements_;
  double load_;
  Creepage creepage_;
  std::array<double, 3> L_{0, 0, 0};
  double spin_x_ = 0, spin_y_ = 0;
  SimplifiedSolution out_;
};

}  // namespace

PairModuli pair_moduli(const Materials& m) {
  const double soft_1 = 1 / m.body[0].shear(), soft_2 = 1 / m.body[1].shear(), shear = 2 / (soft_1 + soft_2);
  return {shear, shear * (m.body[0].poisson * soft_1 + m.body[1].poisson * soft_2) / 2};
}

NormalSolution assumed_pressure(const Discretisation& on, const PatchGrid& g, bool parabolic) {
  const Hertz& h = on.hertz;
  const double mean = h.load / (pi * h.a * h.b);
  NormalSolution out;
  out.pressure.assign(g.size(), 0.0);
  out.gap.assign(g.size(), 0.0);
  out.approach = h.approach;
  out.load = h.load;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const double x = g.x(i) / h.a, y = g.y(j) / h.b, inside = std::max(0.0, 1 - x * x - y * y);
      out.pressure[g.index(i, j)] = mean * (parabolic ? 2 * inside : 1.5 * std::sqrt(inside));
    }
  return out;
}

SimplifiedSolution solve_simplified(const Materials& materials, const Hertz& ellipse, const PatchGrid& grid,
                                    const NormalSolution& normal, const RollingContact& contact) {
  return Rows(materials, ellipse, grid, normal, contact).solve();
}

}  // namespace railstrata::cntc
