#include "usetab/usetab.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>

#include "bem/rolling_contact.hpp"
#include "core/parallel.hpp"
#include "halfspace/hertz.hpp"

namespace railstrata {
namespace {

constexpr int kParts = 7;
constexpr double kInfinite = 1e-5;  // a scaled creepage of 7/0 is written as 7/1e-5
constexpr double kLargeAspects[] = {200, 130, 90, 65, 45, 32, 22.4, 16, 11.2, 8, 5.6, 4, 2.8, 2, 1.7, 1.4, 1.2, 1};
constexpr double kSmall = 5e-7;  // smaller forces are written as 0

/// 0, 1/7, … 1, then infinite, 7, 7/2, … 1.
std::vector<double> scaled() {
  std::vector<double> out;
  for (int i = 0; i <= kParts; ++i) out.push_back(static_cast<double>(i) / kParts);
  for (int i = 0; i <= kParts; ++i) out.push_back(kParts / std::max(kInfinite, static_cast<double>(i)));
  return out;
}

/// Slender ellipses, g = b/a or a/b small. [Kalker1990 table E.3]
CreepCoefficients across_rolling(double g, double poisson) {
  constexpr double pi = std::numbers::pi;
  return {pi * pi / (4 * (1 - poisson)), pi * pi / 4,
          pi * std::sqrt(g) / (3 * (1 - poisson)) * (1 + poisson * (std::log(16 / g) - 5))};
}
CreepCoefficients along_rolling(double g, double poisson) {
  constexpr double pi = std::numbers::pi;
  const double log = std::log(16 / (g * g)), shape = 3 - std::log(4.0), rest = 1 - poisson;
  const double x = log - 2 * poisson, y = rest * log + 2 * poisson;
  return {2 * pi / (g * x) * (1 + shape / x), 2 * pi / (g * y) * (1 + rest * shape / y),
          2 * pi / (3 * g * std::sqrt(g) * (rest * log - 2 + 4 * poisson))};
}

/// The contact of one ellipse: G = 1, load 1, friction 1, a b = 1.
struct Ellipse {
  Ellipse(double a_over_b, int cells)
      : a(std::sqrt(a_over_b)), b(1 / a), influence(compliance(), cells + 2, cells + 2, 2 * a / cells, 2 * b / cells) {
    grid = {cells + 2, cells + 2, 2 * a / cells, 2 * b / cells, 0, 0};
    grid.x0 = -0.5 * (grid.nx - 1) * grid.dx;
    grid.y0 = -0.5 * (grid.ny - 1) * grid.dy;
    const HertzGap curved = hertz_gap(a, b, contact_modulus(body(), body()), 1);
    contact.gap.resize(grid.size());
    for (int i = 0; i < grid.nx; ++i)
      for (int j = 0; j < grid.ny; ++j)
        contact.gap[grid.index(i, j)] = curved.A * grid.x(i) * grid.x(i) + curved.B * grid.y(j) * grid.y(j);
    contact.target.load = 1;
    contact.friction = 1;
  }
  static HalfSpaceMaterial body() { return {2 * (1 + kUsetabPoisson), kUsetabPoisson}; }
  static SurfaceCompliance compliance() {
    const SurfaceCompliance one = homogeneous_compliance(body());
    return combined_compliance(one, one);
  }
  double a, b;
  PatchGrid grid;
  InfluenceOperator influence;
  RollingContact contact;
};

double written(double force) { return std::abs(force) < kSmall ? 0.0 : force; }

/// Six decimals below a hundred; the comment's width is nine.
std::string nine(double value, int digits) { return fmt::format("{:9.{}f}", value, value < 100 ? 6 : digits); }

}  // namespace

UsetabAxes usetab_axes() {
  UsetabAxes out{{}, scaled(), scaled(), scaled()};
  for (int i = 1; i <= kParts; ++i) out.aspect.push_back(static_cast<double>(i) / kParts);
  out.aspect.insert(out.aspect.end(), std::begin(kLargeAspects), std::end(kLargeAspects));
  for (const double psi : scaled()) out.psi.push_back(0.0 - psi);
  return out;
}

CreepCoefficients usetab_coefficients(double a_over_b, double poisson) {
  constexpr double kSlender = 0.101;
  if (a_over_b < kSlender) return across_rolling(a_over_b, poisson);
  if (1 / a_over_b < kSlender) return along_rolling(1 / a_over_b, poisson);
  return kalker_coefficients_by_inverse(a_over_b, poisson);
}

std::vector<UsetabForce> usetab_forces(double a_over_b, const UsetabAxes& axes, const UsetabOptions& options) {
  const Ellipse ellipse(a_over_b, options.cells);
  const CreepCoefficients c = usetab_coefficients(a_over_b, kUsetabPoisson);
  const RollingSolution pressed = solve_rolling(ellipse.influence, ellipse.grid, ellipse.contact);
  std::vector<UsetabForce> out(axes.xi.size() * axes.eta.size() * axes.psi.size());
  const std::size_t rows = axes.xi.size() * axes.eta.size();
  std::mutex ending;
  std::size_t done = 0;
  std::exception_ptr failure;
  for_each(
      static_cast<std::ptrdiff_t>(rows),
      [&](std::ptrdiff_t row) {
        if (asked_to_stop(options.control)) return;
        try {
          const std::size_t r = static_cast<std::size_t>(row);
          RollingContact contact = ellipse.contact;
          contact.x.creepage = -3 * axes.xi[r / axes.eta.size()] / c.c11;
          contact.y.creepage = -3 * axes.eta[r % axes.eta.size()] / c.c22;
          RollingSolution solution = pressed;
          for (std::size_t k = 0; k < axes.psi.size(); ++k) {
            contact.spin = -axes.psi[k] / c.c23;
            solution = solve_rolling(ellipse.influence, ellipse.grid, contact, {}, &solution);
            const TangentialSolution& t = solution.tangential;
            out[r * axes.psi.size() + k] = {0.0 - t.force_x, 0.0 - t.force_y, 0.0 - t.moment};
          }
        } catch (...) {
          const std::lock_guard lock(ending);
          failure = std::current_exception();
        }
        const std::lock_guard lock(ending);
        ++done;
        if (options.solved) options.solved(static_cast<double>(done) / static_cast<double>(rows));
      },
      true);
  if (failure) std::rethrow_exception(failure);
  return out;
}

std::string usetab_head(const UsetabAxes& axes, int cells, const std::string& program) {
  const std::size_t beyond = axes.aspect.size() - kParts;
  std::string out = fmt::format(
      "! \"tabcon\", table of creep forces of elliptic contacts of steel\n! by {}\n! forces on the wheel over those "
      "scaled by Kalker's coefficients\n \n{:6}{:6}{:6}{:6}{:6}  itab, naob1, imap\n",
      program, kParts, beyond, 10, 0, 0);
  for (std::size_t i = 0; i < beyond; ++i)
    out += fmt::format("{:12.6f}{}", axes.aspect[kParts + i], i + 1 == beyond ? "\n" : i % 5 == 4 ? ",\n" : ",");
  return out + fmt::format("! Fx,Fy,aM computed for aob,xi,eta,psi with G=1,nu={},N=1,c=1,mxeff={:3}.\n \n",
                           kUsetabPoisson, cells);
}

std::string usetab_rows(double a_over_b, const UsetabAxes& axes, const std::vector<UsetabForce>& forces) {
  std::string out;
  auto force = forces.begin();
  for (const double xi : axes.xi)
    for (const double eta : axes.eta) {
      out += fmt::format("! aob={}, xi={}, eta={}\n", nine(a_over_b, 3), nine(xi, 1), nine(eta, 1));
      for (std::size_t k = 0; k < axes.psi.size(); ++k, ++force)
        out +=
            fmt::format("  {:11.6f} {:11.6f} {:11.6f}\n", written(force->x), written(force->y), written(force->moment));
    }
  return out;
}

std::string usetab_end() { return " End of Table\n"; }

}  // namespace railstrata
