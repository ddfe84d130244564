#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "ask/answer.hpp"
#include "ask/solve_settings.hpp"
#include "capi/contact.hpp"
#include "capi/guarded.hpp"
#include "capi/state_of_case.hpp"
#include "geometry/read_profile.hpp"
#include "io/provenance.hpp"
#include "judge/bem_summary.hpp"
#include "model/drive_at_contact.hpp"

using namespace railstrata;

namespace railstrata::capi {

int cells_with_pressure(const ContactField& field) {
  int count = 0;
  for (const double p : field.p) count += p > 0;
  return count;
}

rs_forces forces_of(const BemResult& result, const Summary& summary) {
  const ContactSummary& c = summary.contact;
  rs_forces out{};
  out.size = sizeof(rs_forces);
  out.force_x = c.F_x;
  out.force_y = c.F_y;
  out.force_z = c.F_z;
  out.normal_force = c.normal_force;
  out.lateral_force = c.lateral_force;
  out.spin_moment = c.spin_moment;
  out.creepage_x = c.creepage_x;
  out.creepage_y = c.creepage_y;
  out.spin = c.spin_per_m;
  out.approach = c.approach;
  out.contact_angle = c.contact_angle;
  out.p_max = c.patch.p_max;
  out.q_max = c.patch.q_max;
  out.patch_area = c.patch.area;
  out.slip_area = c.patch.slip_area_fraction * c.patch.area;
  out.dissipation = dissipation(result);
  out.patches = static_cast<int>(1 + result.further.size());
  out.cells = cells_with_pressure(result.field);
  out.iterations = result.effort.iterations;
  out.checks_hold = 1;
  for (const Check& check : summary.checks) out.checks_hold &= check.ok ? 1 : 0;
  return out;
}

void set_tolerance(BemOptions& options, double t) {
  options.rolling.tangential.tolerance = options.rolling.coupling_tolerance = options.balance = t;
  options.rolling.normal.tolerance = 0.01 * t;
}

void require(const rs_contact* contact) {
  if (!contact) throw CaseError("the contact is NULL", "make one with rs_contact_new");
}

bool same_place(const GeometrySpec& a, const GeometrySpec& b) {
  return a.lateral_shift == b.lateral_shift && a.yaw == b.yaw && a.roll == b.roll;
}

Placement placed(const rs_contact& contact, const CaseSpec& spec) {
  const GeometrySpec& now = spec.geometry;
  if (same_place(now, contact.loaded.spec.geometry)) return contact.placement;
  Placement out = contact.placement;
  out.track.lateral_shift = now.lateral_shift;
  out.track.yaw = now.yaw;
  out.track.roll = now.roll;
  answer([&] { out.contact = place_wheel(out.wheel, out.rail, out.track); });
  return out;
}

const BemPatch& patch_of(const rs_contact* contact, int patch) {
  if (!contact || !contact->last)
    throw CaseError("there is no solution",
                    contact && contact->state ? "the wheel of the last state is lifted" : "call rs_solve first");
  const BemResult& result = *contact->last;
  const int count = static_cast<int>(1 + result.further.size());
  if (patch < 0 || patch >= count)
    throw CaseError(fmt::format("there is no patch {}", patch), fmt::format("give 0 to {}", count - 1));
  return patch == 0 ? result : result.further[static_cast<std::size_t>(patch - 1)];
}

}  // namespace railstrata::capi

namespace {

using capi::patch_of;
using capi::require;

rs_contact* new_contact(LoadedCase loaded) {
  CaseSpec spec = half_space_case(loaded.spec);
  if (spec.drive.creepage_of == CreepageOf::wheel && (spec.drive.creepage || spec.drive.lateral_creepage))
    throw CaseError("the C interface takes creepages of the contact, not of the wheel",
                    "take out drive.creepage and drive.lateral_creepage, and give them with each state",
                    "drive.creepage_of");
  spec.drive.creepage_of = CreepageOf::contact;
  if (spec.transient.kind != TransientKind::none)
    throw CaseError("a history in time (transient) is not offered by the C interface", "use the program or Python",
                    loaded.file.string());
  Placement placement = place(spec, loaded.folder());
  loaded.spec = spec;
  return new rs_contact{std::move(loaded), std::move(placement), {}, {}, {}, {}, {}, {}};
}

std::vector<std::string> texts(const char* const* overrides, int count) {
  if (count < 0 || (count > 0 && !overrides)) throw CaseError("the list of overrides is missing", "give count = 0");
  for (int k = 0; k < count; ++k)
    if (!overrides[k]) throw CaseError(fmt::format("override {} is NULL", k), "give a text \"key=value\"");
  return {overrides, overrides + count};
}

std::string remarks_of(const BemResult& result, const Summary& summary) {
  std::string out;
  for (const Check& check : summary.checks)
    if (!check.ok) out += fmt::format("check {} fails: {:g}, limit {:g}\n", check.name, check.value, check.limit);
  for (const std::string& note : result.notes) out += note + "\n";
  if (!out.empty()) out.pop_back();
  return out;
}

/// A wheel that is lifted, and what its state has besides.
bool lifted(const rs_state& state) {
  if ((state.given & RS_APPROACH) && (state.given & RS_LOAD)) return false;
  return ((state.given & RS_APPROACH) && std::isfinite(state.approach) && state.approach <= 0) ||
         ((state.given & RS_LOAD) && state.load == 0);
}

void fill_lifted(const rs_contact& contact, rs_state state, rs_forces& out) {
  const double approach = state.given & RS_APPROACH ? state.approach : 0.0;
  state.given &= ~(RS_APPROACH | RS_LOAD);
  const CaseSpec spec = capi::with_state(contact.loaded.spec, state);
  const RigidContact& there = capi::placed(contact, spec).contact;
  out = {};
  out.size = sizeof(rs_forces);
  out.creepage_x = spec.drive.creepage.value_or(0);
  out.creepage_y = spec.drive.lateral_creepage.value_or(yaw_creepage(there));
  out.spin = spin_at(spec, there);
  out.approach = approach;
  out.contact_angle = there.angle;
  out.checks_hold = 1;
}

void require_size(std::size_t size) {
  if (size != sizeof(rs_forces))
    throw CaseError(fmt::format("rs_forces.size = {} is of another version of the library", size),
                    "set size = sizeof(rs_forces), and compile with this version's railstrata.h");
}

void solve(rs_contact& contact, const rs_state* given, rs_forces& forces) {
  require_size(forces.size);
  contact.last.reset();
  contact.state.reset();
  contact.remarks.clear();
  rs_state state = given ? *given : rs_state{};
  if (!given) state.size = sizeof(rs_state);
  if (lifted(state)) {
    fill_lifted(contact, state, forces);
    contact.state = state;
    return;
  }
  const CaseSpec spec = capi::with_state(contact.loaded.spec, state);
  BemOptions options = contact.options;
  options.cache = &contact.cache;
  BemNeighbour neighbour = contact.start.of(spec);
  options.neighbour = &neighbour;
  constexpr double kFollowed = 1e-2;  // of a start's violation: the smallest change of a state counts
  if (!neighbour.empty()) options.rolling.normal.share_of_first = options.rolling.tangential.share_of_first = kFollowed;
  capi::answer([&] { contact.last = solve_bem(spec, capi::placed(contact, spec), options); });
  contact.start.add(spec, std::move(neighbour));
  const Summary summary = bem_contact_summary(spec, *contact.last);
  forces = capi::forces_of(*contact.last, summary);
  contact.state = state;
  contact.remarks = remarks_of(*contact.last, summary);
}

void copy_field(const ContactField& f, int field, double* out, std::size_t n) {
  const std::vector<double>* const fields[] = {&f.x, &f.y, &f.z, &f.area, &f.p, &f.q_x, &f.q_y, &f.slip_x, &f.slip_y};
  if (n != f.p.size() || !out)
    throw CaseError(fmt::format("out has {} numbers, the patch has {} points", n, f.p.size()),
                    "ask rs_points for nx and ny");
  if (field < RS_X || field > RS_STATE)
    throw CaseError(fmt::format("there is no field {}", field), "give RS_X to RS_STATE");
  if (field == RS_STATE)
    for (std::size_t k = 0; k < n; ++k) out[k] = static_cast<double>(f.state[k]);
  else
    std::copy_n(fields[field]->data(), n, out);
}

std::vector<Vec3> points_of(const double* xyz, std::size_t n) {
  std::vector<Vec3> out;
  for (std::size_t k = 0; k < n; ++k) {
    const double *x = xyz + 3 * k, depth = x[2];
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !(depth >= 0) || !std::isfinite(depth))
      throw CaseError(fmt::format("point {} is ({:g}, {:g}, {:g})", k, x[0], x[1], depth),
                      "give finite numbers, and a depth of 0 or more");
    out.push_back({x[0], x[1], depth});
  }
  return out;
}

void require_body(int body) {
  if (body != RS_RAIL && body != RS_WHEEL)
    throw CaseError(fmt::format("there is no body {}", body), "give RS_RAIL or RS_WHEEL");
}

void set_profile(rs_contact& contact, int body, const double* yz, std::size_t n) {
  require_body(body);
  if (!yz) throw CaseError("yz is NULL", "give 2 n numbers: y and z of the points in m");
  const bool wheel = body == RS_WHEEL;
  std::string rows;
  for (std::size_t k = 0; k < n; ++k) rows += fmt::format("{} {}\n", yz[2 * k], yz[2 * k + 1]);
  Placement placement = contact.placement;
  (wheel ? placement.wheel : placement.rail) =
      parse_profile(wheel ? ProfileKind::wheel : ProfileKind::rail, rows, wheel ? "wheel" : "rail", &placement.notes);
  placement.contact = place_wheel(placement.wheel, placement.rail, placement.track);
  contact.placement = std::move(placement);
  contact.last.reset();
  contact.state.reset();
}

void stress(const rs_contact* contact, int body, const double* xyz, std::size_t n, double* out) {
  patch_of(contact, 0);
  require_body(body);
  if (n > 0 && (!xyz || !out)) throw CaseError("xyz or out is missing", "give arrays of 3 n and 6 n numbers");
  const BemResult& result = *contact->last;
  const Subsurface inside = body == RS_RAIL ? rail_interior(result) : wheel_interior(result);
  const std::vector<InteriorPoint> found = [&] {
    try {
      return inside.at(points_of(xyz, n));
    } catch (const std::out_of_range& e) {
      throw CaseError(e.what(), "give points near the contact, in metres");
    }
  }();
  for (std::size_t k = 0; k < n; ++k) {
    const Sym3& s = found[k].stress;
    const double numbers[] = {s.xx, s.yy, s.zz, s.xy, s.yz, s.xz};
    std::copy_n(numbers, 6, out + 6 * k);
  }
}

}  // namespace

extern "C" {

int rs_version(void) {
  int major = 0, minor = 0, patch = 0;
  std::sscanf(build_info().version.c_str(), "%d.%d.%d", &major, &minor, &patch);
  return 10000 * major + 100 * minor + patch;
}

rs_contact* rs_contact_new(const char* case_file, const char* const* overrides, int count, rs_error* error) {
  rs_contact* out = nullptr;
  capi::guarded(error, [&] {
    if (!case_file) throw CaseError("no case file was named", "give its path");
    out = new_contact(load_case(case_file, texts(overrides, count)));
  });
  return out;
}

rs_contact* rs_contact_from_text(const char* toml, const char* const* overrides, int count, rs_error* error) {
  rs_contact* out = nullptr;
  capi::guarded(error, [&] {
    if (!toml) throw CaseError("no case was given", "give its text");
    out = new_contact(parse_case(toml, "case.toml", texts(overrides, count)));
  });
  return out;
}

void rs_contact_free(rs_contact* contact) { delete contact; }

int rs_set_cell(rs_contact* contact, double cell, rs_error* error) {
  return capi::guarded(error, [&] {
    require(contact);
    require_cell(cell);
    contact->options.cell = cell;
  });
}

int rs_set_tolerance(rs_contact* contact, double tolerance, rs_error* error) {
  return capi::guarded(error, [&] {
    require(contact);
    constexpr double kSharpest = 1e-12, kRoughest = 1e-3;
    if (!(tolerance >= kSharpest && tolerance <= kRoughest))
      throw CaseError(fmt::format("a tolerance of {:g} is out of range", tolerance),
                      fmt::format("give a number from {:g} to {:g}", kSharpest, kRoughest));
    capi::set_tolerance(contact->options, tolerance);
  });
}

int rs_solve(rs_contact* contact, const rs_state* state, rs_forces* forces, rs_error* error) {
  return capi::guarded(error, [&] {
    require(contact);
    if (!forces) throw CaseError("forces is NULL", "give an rs_forces with its size set");
    solve(*contact, state, *forces);
  });
}

int rs_set_profile(rs_contact* contact, int body, const double* yz, size_t n, rs_error* error) {
  return capi::guarded(error, [&] {
    require(contact);
    set_profile(*contact, body, yz, n);
  });
}

void rs_forget(rs_contact* contact) {
  if (contact) contact->start = {};
}

const char* rs_remarks(rs_contact* contact) { return contact ? contact->remarks.c_str() : ""; }

int rs_points(const rs_contact* contact, int patch, int* nx, int* ny, rs_error* error) {
  return capi::guarded(error, [&] {
    const ContactField& f = patch_of(contact, patch).field;
    if (nx) *nx = f.stations;
    if (ny) *ny = f.columns;
  });
}

int rs_field(const rs_contact* contact, int patch, int field, double* out, size_t n, rs_error* error) {
  return capi::guarded(error, [&] { copy_field(patch_of(contact, patch).field, field, out, n); });
}

int rs_stress(const rs_contact* contact, int body, const double* xyz, size_t n, double* out, rs_error* error) {
  return capi::guarded(error, [&] { stress(contact, body, xyz, n, out); });
}

}  // extern "C"
