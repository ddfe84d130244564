#include "judge/bem_summary.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bem/interface_slip.hpp"
#include "core/rotation.hpp"
#include "judge/cell_errors.hpp"
#include "judge/check_limits.hpp"
#include "judge/plausibility.hpp"
#include "result/patch.hpp"

namespace railstrata {
namespace {

StressMaximum maximum(const StressPeak& p) { return {p.value, p.x, p.y, p.depth, p.at_rim >= p.value, kNotApplicable}; }
StressPair pair(const ZonePeaks& z) { return {maximum(z.von_mises), maximum(z.sigma1)}; }

std::optional<StressPair> largest(const std::vector<const std::vector<ZonePeaks>*>& groups) {
  std::optional<StressPair> best;
  for (const auto* group : groups)
    for (const ZonePeaks& z : *group) {
      const StressPair p = pair(z);
      if (!best) best = p;
      if (p.von_mises.value > best->von_mises.value) best->von_mises = p.von_mises;
      if (p.sigma1.value > best->sigma1.value) best->sigma1 = p.sigma1;
    }
  return best;
}

StressSummary stress_summary(const SubsurfacePeaks& p) {
  StressSummary s;
  s.surface = pair(p.surface);
  s.subsurface = pair(p.subsurface);
  if (p.layers.empty()) return s;
  s.layer = largest({&p.layers});
  s.interface = largest({&p.above_interface, &p.below_interface});
  s.matrix = pair(p.matrix);
  return s;
}

bool reaches_edge(const ContactField& f) {
  for (int s = 0; s < f.stations; ++s)
    for (int c = 0; c < f.columns; ++c)
      if ((s == 0 || s + 1 == f.stations || (f.line_length == 0 && (c == 0 || c + 1 == f.columns))) &&
          f.p[c + f.columns * s] > 0)
        return true;
  return false;
}

Check bem_check(std::string_view name, double value) { return at_most(name, value, check_row(name).bem_limit); }

std::vector<Check> checks(const CaseSpec& spec, const BemResult& r) {
  const bool load_given = !spec.vehicle.approach;
  const double load = load_given ? spec.vehicle.load() : -force_on_rail(r).z;
  double force_x = 0, force_y = 0, reached = 0, cut_off = 0, film = 0;
  for (const BemPatch* p : patches_of(r)) {
    const PatchMeasures m = measure_patch(p->field);
    force_x += m.force_x;
    force_y += m.force_y;
    if (reaches_edge(p->field)) reached = 1;
    if (p->surroundings.cut_off) cut_off = 1;
    film = std::max(film, film_shear(spec, m));
  }
  std::vector<Check> out;
  if (load_given) out.push_back(bem_check("F_z_relative_to_weight", std::abs(-force_on_rail(r).z / load - 1)));
  const bool friction = spec.drive.friction_coefficient > 0;
  if (const double wanted = spec.drive.traction().value_or(0); friction && wanted != 0)
    out.push_back(bem_check("traction_coefficient_reached", std::abs(force_x / load / wanted - 1)));
  if (const double wanted = spec.drive.lateral_traction_coefficient.value_or(0); friction && wanted != 0)
    out.push_back(bem_check("lateral_traction_reached", std::abs(force_y / load / wanted - 1)));
  out.push_back(bem_check("patch_reaches_edge_of_grid", reached));
  out.push_back(bem_check("patch_cut_off", cut_off));
  out.push_back(bem_check("cell_of_patch", cell_of_patch(r)));
  if (spec.third_body.thickness) out.push_back(bem_check("film_of_patch", film));
  return out;
}

ContactSummary patch_numbers(const CaseSpec& spec, const BemPatch& r) {
  ContactSummary c;
  c.patch = measure_patch(r.field);
  c.patch.q_max = shear_at_front_of_slip(r.field);
  c.F_x = 0.0 - r.force.x;
  c.F_y = 0.0 - r.force.y;
  c.F_z = 0.0 - r.force.z;
  turn_into_contact_plane(c, r.contact.angle);
  c.contact_angle = r.place.angle;
  c.spin_moment = 0.0 - r.force.moment;
  c.approach = r.approach;
  c.bending_stretch = r.bending_stretch;
  if (spec.drive.friction_coefficient > 0) {
    c.creepage_x = r.rigid_slip.x;
    c.creepage_y = r.rigid_slip.y;
    c.spin_per_m = r.rigid_slip.spin;
    c.motion_power = r.motion_power;
  } else {
    c.patch.slip_area_fraction = kNotApplicable;
  }
  return c;
}

/// The worse of two warnings of one name.
void add_warning(Warning warning, std::vector<Warning>& out) {
  const auto same = std::find_if(out.begin(), out.end(), [&](const Warning& w) { return w.name == warning.name; });
  if (same == out.end())
    out.push_back(std::move(warning));
  else if (warning.value > same->value)
    *same = std::move(warning);
}

/// From the rail's own axes (y along the common tangent, z down) to the model frame.
Sym3 in_model_frame(const Sym3& s, double angle) {
  return roll(rotation_by(angle), Sym3{s.xx, s.yy, s.zz, s.xy, -s.yz, -s.xz});
}

int cell(double at, double first, double size, int count) {
  return std::clamp(static_cast<int>(std::lround((at - first) / size)), 0, count - 1);
}

SlidingSummary interface_summary(const InterfaceSlip& slip) {
  const InterfacePassage &last = slip.passages.back(), &first = slip.passages.front();
  return {static_cast<double>(slip.passages.size()),
          last.largest,
          first.largest,
          last.left,
          first.left,
          last.area,
          last.work,
          first.work,
          last.shear};
}

}  // namespace

SearchDepths depths_of_interest(const LayeredHalfSpace& body, const ContactSummary& contact) {
  const std::vector<LayerExtent> layers = layer_extents(body);
  const double bottom = layers.empty() ? 0.0 : layers.back().bottom,
               first = layers.empty() ? HUGE_VAL : layers.front().bottom;
  return {subsurface_begin(contact.patch, first), bottom + longer_axis(contact.patch)};
}

/// A cell over the patch, along rolling or across.
double cell_of(const BemPatch& p) {
  const PatchMeasures m = measure_patch(p.field);
  return p.grid.line ? p.grid.dx / shorter_axis(m) : std::max(p.grid.dx / m.length, p.grid.dy / m.width);
}

double cell_of_patch(const BemResult& r) {
  double cells = 0, force = 0;
  for (const BemPatch* p : patches_of(r)) {
    const double of_patch = -p->force.z;
    cells += of_patch * cell_of(*p);
    force += of_patch;
  }
  return cells / force;
}

std::vector<Warning> bem_warnings(const Summary& summary, const CaseSpec& spec, const BemResult& r, double coarsest) {
  const double cell = std::max(cell_of(r), coarsest) * shorter_axis(summary.contact.patch);
  std::vector<Warning> out = implausible(summary, spec, r.surroundings, cell);
  for (std::size_t k = 0; k < r.further.size(); ++k) {
    Summary of_patch;
    of_patch.run.engine = summary.run.engine;
    of_patch.contact = summary.patches.at(k + 1).contact;
    const double further = cell_of(r.further[k]) * shorter_axis(of_patch.contact.patch);
    for (Warning& w : implausible(of_patch, spec, r.further[k].surroundings, further)) add_warning(std::move(w), out);
  }
  return out;
}

void judge_coarsest_state(double coarsest, Summary& summary) {
  for (Check& c : summary.checks)
    if (c.name == "cell_of_patch" && coarsest > c.value) c = bem_check(c.name, coarsest);
}

Summary bem_contact_summary(const CaseSpec& spec, const BemResult& r) {
  Summary s;
  s.title = spec.title;
  s.position = spec.run.rolling && !spec.run.positions.empty() ? spec.run.positions.back() : 0.0;
  s.contact = patch_numbers(spec, r);
  s.contact.error = cell_errors(spec, r, s.contact);
  if (!r.further.empty()) {
    for (const BemPatch* p : patches_of(r))
      s.patches.push_back({p->place.point.y, p->surroundings.rail_y, p->surroundings.wheel_y, patch_numbers(spec, *p)});
  }
  if (!r.further.empty() || !r.others.empty()) {
    const Vec3 all = force_on_rail(r);
    s.contact.F_x = 0.0 - all.x;
    s.contact.F_y = 0.0 - all.y;
    s.contact.F_z = 0.0 - all.z;
  }
  if (r.interface_slip) s.interface_slip = interface_summary(*r.interface_slip);
  s.run.engine = spec.bem.bodies == ContactBodies::sections ? Engine::sections : Engine::bem;
  s.run.wall_s = r.effort.wall_s;
  for (const BemPatch* p : patches_of(r)) s.run.elements += static_cast<long>(p->grid.size());
  s.checks = checks(spec, r);
  s.warnings = bem_warnings(s, spec, r);
  return s;
}

StressSummary bem_stress(const BemResult& r, BodyId body, const ContactSummary& contact) {
  const bool rail = body == BodyId::rail;
  const Subsurface interior = rail ? rail_interior(r) : wheel_interior(r);
  StressSummary out = stress_summary(interior.peaks(depths_of_interest(rail ? r.rail : r.wheel, contact)));
  add_stress_errors(r, contact, out);
  return out;
}

StressSection rail_depth_line(const BemResult& r, double x, double y, double deepest) {
  const Subsurface interior = rail_interior(r);
  const PatchGrid& g = r.grid;
  const int i = cell(x, g.x0, g.dx, g.nx), j = cell(y, g.y0, g.dy, g.ny);
  StressSection line{g.y(j), {g.x(i)}, {}, {}, {}, {}};
  const auto add = [&](const StatePlane& plane, bool below, int material) {
    line.depth.push_back(plane.depth);
    line.stress.push_back(in_model_frame(interior.stress(plane, g.index(i, j), below), r.contact.angle));
    line.material.push_back(material);
  };
  const auto zone = [&](double top, double bottom, int material) {
    const int pieces = std::clamp(static_cast<int>(std::ceil((bottom - top) / g.finest())), 2, 60);
    for (int k = 0; k <= pieces; ++k)
      add(interior.plane(k == pieces ? bottom : top + (bottom - top) * k / pieces), k == 0, material);
  };
  double top = 0;
  int material = 0;
  for (const LayerExtent& layer : layer_extents(r.rail)) {
    zone(layer.top, layer.bottom, ++material);
    top = layer.bottom;
  }
  zone(top, std::max(deepest, top + 4 * g.finest()), 0);
  return line;
}

}  // namespace railstrata
