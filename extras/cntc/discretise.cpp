#include "cntc/discretise.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "halfspace/hertz.hpp"

namespace railstrata::cntc {
namespace {

/// The load of the Hertzian contact: given, or that of the given approach.
double hertz_load(const Settings& s, double modulus, double a, double b, const HertzGap* curvatures) {
  if (flag(s, kNorm) == 1) {
    if (!(s.load > 0)) throw Refused(kOther, "no normal force: call cntc_setnormalforce");
    return s.load;
  }
  if (!(s.approach > 0))
    throw Refused(kOther, "an ellipse of Hertz needs an approach above 0: call cntc_setpenetration");
  if (curvatures) return std::pow(s.approach / hertz_contact(curvatures->A, curvatures->B, modulus, 1).approach, 1.5);
  // With given semi-axes, curvatures and approach are proportional to the load.
  const HertzGap of_one = hertz_gap(a, b, modulus, 1);
  return s.approach / hertz_contact(of_one.A, of_one.B, modulus, 1).approach;
}

Hertz hertz_of(const Settings& s) {
  const Materials& m = s.materials;
  const double modulus = contact_modulus(m.body[0], m.body[1]);
  const Parameters& g = s.grid;
  Hertz out;
  out.scale = g.value[2];
  if (g.number == -3) {
    const double load = hertz_load(s, modulus, g.value[0], g.value[1], nullptr);
    const HertzGap gap = hertz_gap(g.value[0], g.value[1], modulus, load);
    out.A = gap.A;
    out.B = gap.B;
  } else {
    const HertzGap of_ratio = hertz_gap(g.number == -2 ? g.value[1] : 1, 1, modulus, 1);
    out.A = g.value[0];
    out.B = g.number == -1 ? g.value[1] : g.value[0] * of_ratio.B / of_ratio.A;
  }
  const HertzGap gap{out.A, out.B};
  const HertzContact hertz = hertz_contact(out.A, out.B, modulus, hertz_load(s, modulus, 0, 0, &gap));
  out.a = hertz.a;
  out.b = hertz.b;
  out.approach = hertz.approach;
  out.load = hertz.load;
  return out;
}

PatchGrid grid_of(const Parameters& g, const Hertz& hertz) {
  PatchGrid out;
  out.nx = g.mx;
  out.ny = g.my;
  const auto& v = g.value;
  if (g.number < 0) {
    const double x = hertz.a * hertz.scale, y = hertz.b * hertz.scale;
    out.dx = 2 * x / g.mx;
    out.dy = 2 * y / g.my;
    out.x0 = -x + 0.5 * out.dx;
    out.y0 = -y + 0.5 * out.dy;
    return out;
  }
  const int intervals = g.number == 4 ? 1 : 0;
  const bool steps = g.number == 1 || g.number == 3, corner = g.number <= 2;
  out.dx = steps ? v[2] : (v[2] - v[0]) / (g.mx - intervals);
  out.dy = steps ? v[3] : (v[3] - v[1]) / (g.my - intervals);
  out.x0 = v[0] + (corner ? 0.5 * out.dx : 0.0);
  out.y0 = v[1] + (corner ? 0.5 * out.dy : 0.0);
  return out;
}

/// IBASE = 2: heights at equal distances, linear between and beyond them.
double height(const std::vector<double>& v, double y) {
  const double y1 = v[2], dy = v[3];
  const auto count = static_cast<int>(v.size()) - 4;
  const int k = std::clamp(static_cast<int>(std::floor((y - y1) / dy)), 0, count - 2);
  const double share = (y - y1) / dy - k;
  const auto at = static_cast<std::size_t>(4 + k);
  return (1 - share) * v[at] + share * v[at + 1];
}

double distance(const Parameters& gap, double x, double y) {
  const auto& b = gap.value;
  if (gap.number == 1) return b[0] * x * x + b[1] * x * y + b[2] * y * y + b[3] * x + b[4] * y + b[5];
  if (gap.number == 2) return height(b, y) + (x - b[0]) * (x - b[0]) / (2 * b[1]);
  return b[0] * std::sin(b[1] * (x - b[2])) - b[3] * std::sin(b[4] * (x - b[5])) + x * x / b[6] + y * y / b[7];
}

Plane gap_of(const Settings& s, const PatchGrid& g, const Hertz& hertz) {
  Parameters gap = s.gap;
  if (s.grid.number < 0) gap = {1, 0, 0, {hertz.A, 0, hertz.B, 0, 0, 0}};
  if (gap.number == 0) throw Refused(kOther, "no undeformed distance: call cntc_setundeformeddistc");
  if (gap.number == 9 && gap.value.size() != g.size())
    throw Refused(kGrid, fmt::format("IBASE = 9 has {} distances, the potential contact area {} elements",
                                     gap.value.size(), g.size()));
  Plane out(g.size());
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j)
      out[g.index(i, j)] =
          gap.number == 9 ? gap.value[static_cast<std::size_t>(i + g.nx * j)] : distance(gap, g.x(i), g.y(j));
  return out;
}

}  // namespace

Discretisation discretise(const Settings& s) {
  if (!s.has_materials) throw Refused(kOther, "no materials: call cntc_setmaterialparameters");
  if (s.grid.number == 0)
    throw Refused(kGrid, "no potential contact area: call cntc_sethertzcontact or cntc_setpotcontact");
  Discretisation out;
  if (s.grid.number < 0) out.hertz = hertz_of(s);
  out.grid = grid_of(s.grid, out.hertz);
  out.gap = gap_of(s, out.grid, out.hertz);
  return out;
}

}  // namespace railstrata::cntc
