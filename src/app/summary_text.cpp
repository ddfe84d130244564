#include "app/summary_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>

#include "io/summary_json.hpp"

namespace railstrata {
namespace {

std::string in_mm(double metres) { return fmt::format("{:.2f} mm", 1e3 * metres); }

std::string place(const StressMaximum& m) {
  return fmt::format("{:7.1f} MPa at x {:+.2f}, y {:+.2f}, depth {:.2f} mm", 1e-6 * m.value, 1e3 * m.x, 1e3 * m.y,
                     1e3 * m.depth);
}

std::string contact_text(const ContactSummary& c) {
  std::string out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "  p_max            {:8.1f} MPa\n", 1e-6 * c.p_max);
  fmt::format_to(to, "  q_max            {:8.1f} MPa\n", 1e-6 * c.q_max);
  fmt::format_to(to, "  patch            {} long, {} wide, {:.1f} mm²\n", in_mm(c.patch_length), in_mm(c.patch_width),
                 1e6 * c.patch_area);
  if (std::isfinite(c.slip_area_fraction))
    fmt::format_to(to, "  slip area        {:8.1f} % of the patch\n", 100 * c.slip_area_fraction);
  fmt::format_to(to, "  forces on wheel  F_x {:.2f}, F_y {:.2f}, F_z {:.2f} kN, F_x/F_z {:.4f}\n", 1e-3 * c.F_x,
                 1e-3 * c.F_y, 1e-3 * c.F_z, c.F_x / c.F_z);
  fmt::format_to(to, "  in contact plane normal {:.2f}, lateral {:.2f} kN, at {:+.2f} degrees\n", 1e-3 * c.normal_force,
                 1e-3 * c.lateral_force, c.contact_angle * 180 / std::numbers::pi);
  if (std::isfinite(c.creepage_x))
    fmt::format_to(to, "  creepage         {:8.3f} e-3 longitudinal (negative: driving)\n", 1e3 * c.creepage_x);
  if (std::isfinite(c.penetration_max))
    fmt::format_to(to, "  penetration      {:8.4f} um of {:.1f} um approach\n", 1e6 * c.penetration_max,
                   1e6 * c.approach);
  else
    fmt::format_to(to, "  approach         {:8.1f} um\n", 1e6 * c.approach);
  return out;
}

}  // namespace

std::string summary_text(const Summary& s) {
  std::string out =
      fmt::format("\n{}{}\n", s.title, std::isfinite(s.position) ? ", wheel at " + in_mm(s.position) : "") +
      contact_text(s.contact);
  auto to = std::back_inserter(out);
  auto maximum = [&](const char* what, const std::optional<StressPair>& pair) {
    if (pair)
      fmt::format_to(to, "  rail {:<11} von Mises {}; sigma_1 {}\n", what, place(pair->von_mises), place(pair->sigma1));
  };
  maximum("surface", s.rail.surface);
  maximum("subsurface", s.rail.subsurface);
  maximum("layer", s.rail.layer);
  maximum("interface", s.rail.interface);
  maximum("matrix", s.rail.matrix);
  if (s.run.added_mass > 0)
    fmt::format_to(
        to,
        "  mass scaling     {:.3f} kg against stretching of thin rows: stable step {:.1f} ns instead of {:.1f} ns\n",
        s.run.added_mass, 1e9 * s.run.stable_step, 1e9 * s.run.unscaled_step);
  if (s.run.fine_elements > 0)
    fmt::format_to(
        to, "  local steps      {:.0f} stages a step in {:.0f} elements: stable step {:.1f} ns instead of {:.1f} ns\n",
        s.run.local_stages, s.run.fine_elements, 1e9 * s.run.stable_step, 1e9 * s.run.unscaled_step);
  fmt::format_to(to, "  checks\n");
  for (const Check& k : s.checks)
    fmt::format_to(to, "    {:<6} {:<34} {:10.3g}  (limit {:.3g})\n", k.ok ? "ok" : "FAILED", k.name, k.value, k.limit);
  for (const Warning& w : s.warnings)
    fmt::format_to(to, "    warn   {:<34} {:10.3g}  (above {:.3g}): {}\n", w.name, w.value, w.limit, w.text);
  return out;
}

void print_summary(const Summary& s, bool json) {
  std::fputs((json ? summary_json(s).dump(2) + "\n" : summary_text(s)).c_str(), stdout);
}

bool all_checks_hold(const Summary& s) {
  return std::all_of(s.checks.begin(), s.checks.end(), [](const Check& k) { return k.ok; });
}

}  // namespace railstrata
