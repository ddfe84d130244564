#include "export/contact_files.hpp"

#include <cmath>

#include "bem/case_patch.hpp"
#include "bem/profile_gap.hpp"
#include "export/deck_text.hpp"
#include "material/elastic.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

constexpr int kFormat = 2410, kColumns = 11;

/// A row of the table, filled up with zeros to the full number of columns.
void add_row(std::string& out, std::initializer_list<double> values, double last = 0) {
  int column = 0;
  for (const double v : values) {
    add(out, "{:15.7g}", v);
    ++column;
  }
  for (; column < kColumns; ++column) add(out, "{:15.7g}", column + 1 == kColumns ? last : 0.0);
  out += '\n';
}

/// Cells in CONTACT's order: visit(number from 1, place in planes of the grid, place in the field).
template <class Visit>
void each_cell(const PatchGrid& g, Visit&& visit) {
  for (int j = g.ny - 1, row = 0; j >= 0; --j, ++row)
    for (int i = 0; i < g.nx; ++i) visit(1 + i + row * g.nx, g.index(i, j));
}

struct Corner {
  double x, y;
};
/// mm, of the grid in CONTACT's frame: smallest x and y.
Corner low_corner(const PatchGrid& g) {
  return {kToMilli * (g.x0 - 0.5 * g.dx), -kToMilli * (g.y(g.ny - 1) + 0.5 * g.dy)};
}

bool rolls(const CaseSpec& spec) { return spec.run.rolling && spec.drive.friction_coefficient > 0; }

double shear_modulus(const MaterialSpec& m) { return 0.5 * kToMega * m.young / (1 + m.poisson); }

void add_heading(std::string& out, const CaseSpec& spec, const PatchGrid& g) {
  const double mx = g.nx, my = g.ny, friction = rolls(spec) ? spec.drive.friction_coefficient : 0;
  const Corner low = low_corner(g);
  const MaterialSpec &rail = spec.rail_material, &wheel = spec.wheel_material;
  const double radius = kToMilli * spec.geometry.wheel_radius;
  add_row(out, {0, 0, 0, 0, 0, 0, 0}, kFormat);
  add_row(out, {0, 0, 0, 0, 0, radius});
  add_row(out, {0, 0, 0, 0, 0, 0, 0, 1, 1});
  add_row(out, {mx, my, low.x, low.y, kToMilli * g.dx, kToMilli * g.dy, 0, kToMilli * g.dx});
  add_row(out, {rolls(spec) ? 3.0 : 0.0, 0, shear_modulus(rail), shear_modulus(wheel), rail.poisson, wheel.poisson});
  add_row(out, {0, 0, kToMilli * spec.drive.speed, friction, friction});
}

/// Rigid slip of a cell beyond creepages and spin about the patch's middle, in CONTACT's signs: the variation of the
/// rolling radius across the patch and the local angle of spin. Empty: none.
PlanePair extra_rigid_slip(const CaseSpec& spec, const Placement& placement, const BemPatch& patch) {
  Placement own = placement;
  own.contact = patch.contact;
  const PatchGrid& g = patch.grid;
  const CasePatch on = case_patch_on(g, spec, own, {}, {.load = patch.force.normal, .approach = {}});
  const RollingContact& problem = on.contact;
  PlanePair out{Plane(g.size()), Plane(g.size())};
  const auto further = [](const Plane& plane, std::size_t k) {
    return k < plane.size() && std::isfinite(plane[k]) ? plane[k] : 0.0;
  };
  bool any = false;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const std::size_t k = g.index(i, j);
      if (!(on.profile.gap[k] < ProfileGap::kNoSurface)) continue;
      out.x[k] = -further(problem.extra_slip.x, k);
      out.y[k] = further(problem.extra_slip.y, k) + further(problem.local_spin, static_cast<std::size_t>(j)) * g.x(i);
      any = any || out.x[k] != 0 || out.y[k] != 0;
    }
  return any ? out : PlanePair{};
}

}  // namespace

std::string contact_mat(const CaseSpec& spec, const Placement& placement, const BemPatch& patch) {
  const PatchGrid& g = patch.grid;
  const ContactField& f = patch.field;
  const Plane gap = profile_gap(placement.wheel, placement.rail, placement.track, patch.contact, g).gap;
  const double friction = rolls(spec) ? spec.drive.friction_coefficient : 0;
  std::string out;
  add_heading(out, spec, g);
  each_cell(g, [&](int number, std::size_t k) {
    if (f.state[k] == ContactState::separated) return;
    const double slip = rolls(spec) ? std::hypot(f.slip_x[k], f.slip_y[k]) / spec.drive.speed : 0;
    add_row(out,
            {static_cast<double>(number), static_cast<double>(f.state[k]), kToMilli * gap[k], friction,
             kToMega * f.p[k], kToMega * f.q_x[k], -kToMega * f.q_y[k], 0, 0, 0, slip},
            slip);
  });
  return out;
}

std::string contact_input(const CaseSpec& spec, const Placement& placement, const BemPatch& patch) {
  require_support(uses::kContactInput, spec);
  const PatchGrid& g = patch.grid;
  const Corner low = low_corner(g);
  const bool rolling = rolls(spec);
  const RigidSlip slip = rolling ? patch.rigid_slip : RigidSlip{};
  const double friction = rolling ? spec.drive.friction_coefficient : 1;
  const MaterialSpec &rail = spec.rail_material, &wheel = spec.wheel_material;
  const PlanePair extra = rolling ? extra_rigid_slip(spec, placement, patch) : PlanePair{};
  std::string out;
  add(out, "% {}\n% written by RailStrata; body 1 is the rail, y to the right, z down; mm, N, rad\n",
      one_line(spec.title));
  add(out, " 3  MODULE\n 20{}100     P-B-T-N-F-S        PVTIME, BOUND , TANG  , NORM , FORCE, STRESS\n",
      rolling ? 3 : 0);
  add(out, " 02202{}     L-D-C-M-Z-E        FRCLAW, DISCNS, INFLCF, MATER, RZNORM, EXRHS\n", extra.x.empty() ? 0 : 9);
  add(out, " 0001341    H-G-I-A-O-W-R      HEAT, GAUSEI, IESTIM, MATFIL, OUTPUT, FLOW, RETURN\n");
  add(out, " 999  100  30  1  1e-6         MAXGS , MAXIN , MAXNR , MAXOUT, EPS\n");
  add(out, " {:.9g} {:.9g} {:.9g} {:.9g}   FN, CKSI, CETA, CPHI\n", patch.force.normal, -slip.x, slip.y,
      slip.spin / kToMilli);
  add(out, " {:.6g} {:.6g}   FSTAT, FKIN\n", friction, friction);
  if (rolling) add(out, " 0.0 {:.6g} {:.9g}   CHI, DQ, VELOC\n", kToMilli * g.dx, kToMilli * spec.drive.speed);
  add(out, " {:.6g} {:.6g} {:.9g} {:.9g}   POISS 1,2, GG 1,2\n", rail.poisson, wheel.poisson, shear_modulus(rail),
      shear_modulus(wheel));
  add(out, " 1   IPOTCN\n {} {} {:.9g} {:.9g} {:.9g} {:.9g}   MX,MY,XL,YL,DX,DY\n", g.nx, g.ny, low.x, low.y,
      kToMilli * g.dx, kToMilli * g.dy);
  add(out, " 9 1   IBASE, IPLAN\n");
  const Plane gap = profile_gap(placement.wheel, placement.rail, placement.track, patch.contact, g).gap;
  each_cell(g, [&](int number, std::size_t k) {
    add(out, " {:.9g}{}", kToMilli * gap[k], number % g.nx == 0 || number % 8 == 0 ? "\n" : "");
  });
  if (!extra.x.empty()) {
    add(out, "% EXRHS(I,2), EXRHS(I,3): variation of the rolling radius, local angle of spin\n");
    each_cell(g, [&](int, std::size_t k) { add(out, " {:.9g} {:.9g}\n", extra.x[k], extra.y[k]); });
  }
  out += " 0  MODULE\n";
  return out;
}

std::string contact_stresses(const LayeredHalfSpace& rail, const BemPatch& patch) {
  constexpr int kDepths = 16;
  const PatchGrid& g = patch.grid;
  const Subsurface interior = rail_interior(rail, patch);
  const double deepest = 0.5 * g.nx * g.dx;
  std::string out;
  add(out, "{:13}{:13}{:13}", g.nx, g.ny, kDepths);
  for (int c = 3; c < 14; ++c) add(out, "{:13}", 0);
  out += '\n';
  for (int n = 0; n < kDepths; ++n) {
    const double depth = deepest * n / (kDepths - 1);
    const StatePlane plane = interior.plane(depth);
    const DisplacementPlane u = interior.displacement(depth);
    for (int j = g.ny - 1; j >= 0; --j)
      for (int i = 0; i < g.nx; ++i) {
        const std::size_t k = g.index(i, j);
        const Sym3 s = kToMega * interior.stress(plane, k);
        for (const double v :
             {kToMilli * g.x(i), -kToMilli * g.y(j), kToMilli * depth, kToMilli * u.u_x[k], -kToMilli * u.u_y[k],
              kToMilli * u.u_z[k], (s.xx + s.yy + s.zz) / 3, von_mises(s), s.xx, -s.xy, s.xz, s.yy, -s.yz, s.zz})
          add(out, "{:13.5g}", v);
        out += '\n';
      }
  }
  return out;
}

}  // namespace railstrata
