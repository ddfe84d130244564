#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "ask/case_number.hpp"
#include "ask/contact.hpp"
#include "ask/patch_forces.hpp"
#include "capi/guarded.hpp"
#include "capi/handles.hpp"
#include "io/provenance.hpp"

using namespace railstrata;
using capi::contact_of;
using capi::guarded;
using capi::require;

namespace {

constexpr unsigned kAllBits = (1u << kState.size()) - 1;

State state_of(const rs_state* given) {
  State out;
  if (!given) return out;
  const rs_state state = capi::taken(*given, "rs_state");
  if (state.given & ~kAllBits)
    throw CaseError(fmt::format("rs_state.given = {} has bits that have no meaning", state.given),
                    "use RS_LOAD, RS_APPROACH and so on");
  std::array<double, kState.size()> numbers;
  static_assert(offsetof(rs_state, load) + sizeof numbers == sizeof(rs_state));
  std::memcpy(numbers.data(), reinterpret_cast<const char*>(&state) + offsetof(rs_state, load), sizeof numbers);
  for (const StateMember& member : kState)
    if (state.given & member.bit) out.*member.at = numbers[static_cast<std::size_t>(std::countr_zero(member.bit))];
  return out;
}

const StateMember* input_of(unsigned bit) {
  const auto found = std::find_if(kState.begin(), kState.end(), [&](const StateMember& m) { return m.bit == bit; });
  if (found == kState.end())
    throw CaseError(fmt::format("{} is no input of rs_state", bit), "give RS_LOAD, RS_YAW and so on, one bit each");
  return found;
}

BodyId body_of(int body) {
  if (body != RS_RAIL && body != RS_WHEEL)
    throw CaseError(fmt::format("there is no body {}", body), "give RS_RAIL or RS_WHEEL");
  return body == RS_RAIL ? BodyId::rail : BodyId::wheel;
}

void copy_field(const ContactField& f, int field, double* out, std::size_t n) {
  const std::vector<double>* const fields[] = {&f.x, &f.y, &f.z, &f.area, &f.p, &f.q_x, &f.q_y, &f.slip_x, &f.slip_y};
  if (n != f.p.size() || !out)
    throw CaseError(fmt::format("out has {} numbers, the patch has {} points", n, f.p.size()),
                    "ask rs_points for nx and ny");
  if (field < RS_X || field > RS_STATE)
    throw CaseError(fmt::format("there is no field {}", field), "give RS_X to RS_STATE");
  if (field == RS_STATE)
    std::transform(f.state.begin(), f.state.end(), out, [](ContactState s) { return static_cast<double>(s); });
  else
    std::copy_n(fields[field]->data(), n, out);
}

void copy_stresses(const std::vector<Sym3>& stresses, double* out) {
  for (const Sym3& s : stresses)
    for (const double number : {s.xx, s.yy, s.zz, s.xy, s.yz, s.xz}) *out++ = number;
}

}  // namespace

std::vector<std::string> railstrata::capi::overrides_of(const char* const* overrides, int count) {
  if (count < 0 || (count > 0 && !overrides)) throw CaseError("the list of overrides is missing", "give count = 0");
  for (int k = 0; k < count; ++k)
    if (!overrides[k]) throw CaseError(fmt::format("override {} is NULL", k), "give a text \"key=value\"");
  return {overrides, overrides + count};
}

extern "C" {

int rs_version(void) {
  int major = 0, minor = 0, patch = 0;
  std::sscanf(build_info().version.c_str(), "%d.%d.%d", &major, &minor, &patch);
  return 10000 * major + 100 * minor + patch;
}

rs_contact* rs_contact_new(const char* case_file, const char* const* overrides, int count, rs_error* error) {
  return capi::made(error, [&] {
    require(case_file, "case_file", "give its path");
    return capi::handle_of(new Contact(load_case(case_file, capi::overrides_of(overrides, count))));
  });
}

rs_contact* rs_contact_from_text(const char* toml, const char* const* overrides, int count, rs_error* error) {
  return capi::made(error, [&] {
    require(toml, "toml", "give the text of a case");
    return capi::handle_of(new Contact(parse_case(toml, "case.toml", capi::overrides_of(overrides, count))));
  });
}

rs_contact* rs_contact_copy(const rs_contact* contact, rs_error* error) {
  return capi::made(error, [&] {
    auto copy = std::make_unique<Contact>(contact_of(contact));
    copy->of_wheelset = false;
    return capi::handle_of(copy.release());
  });
}

void rs_contact_free(rs_contact* contact) {
  if (contact && !contact_of(contact).of_wheelset) delete &contact_of(contact);
}

int rs_set_cell(rs_contact* contact, double cell, rs_error* error) {
  return guarded(error, [&] { contact_of(contact).set_cell(cell); });
}

int rs_set_tolerance(rs_contact* contact, double tolerance, rs_error* error) {
  return guarded(error, [&] { contact_of(contact).set_tolerance(tolerance); });
}

int rs_solve(rs_contact* contact, const rs_state* state, rs_forces* forces, rs_error* error) {
  return guarded(error, [&] {
    Contact& asked = contact_of(contact);
    require(forces, "forces", "give an rs_forces with its size set");
    capi::require_size(*forces, "rs_forces");
    asked.drop_solution();
    rs_forces found{};
    State wanted = state_of(state);
    wanted.extrapolate = capi::shows_beyond(*forces);
    capi::fill(kForces, asked.solve(wanted), found, offsetof(rs_forces, force_x));
    capi::give(found, *forces);
  });
}

int rs_jacobian(rs_contact* contact, const unsigned* inputs, int count, rs_derivatives* out, rs_error* error) {
  return guarded(error, [&] {
    Contact& asked = contact_of(contact);
    if (count < 0 || (count > 0 && (!inputs || !out)))
      throw CaseError("inputs or out is missing", "give arrays of `count`");
    std::vector<const StateMember*> members;
    capi::require_sizes<rs_derivatives>(out, static_cast<std::size_t>(count), "rs_derivatives");
    for (int k = 0; k < count; ++k) members.push_back(input_of(inputs[k]));
    const std::vector<Slopes> slopes = asked.slopes(members);
    static_assert(offsetof(rs_derivatives, force_x) + sizeof(Slopes) == sizeof(rs_derivatives));
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      rs_derivatives found{};
      std::memcpy(&found.force_x, slopes[k].data(), sizeof slopes[k]);
      capi::give(found, capi::element(out, k));
    }
  });
}

int rs_set_profile(rs_contact* contact, int body, const double* yz, size_t n, rs_error* error) {
  return guarded(error, [&] {
    Contact& asked = contact_of(contact);
    const BodyId wanted = body_of(body);
    require(yz, "yz", "give 2 n numbers: y and z of the points in m");
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < n; ++k) points.push_back({yz[2 * k], yz[2 * k + 1]});
    asked.set_profile(wanted, std::move(points));
  });
}

void rs_forget(rs_contact* contact) {
  if (contact) contact_of(contact).start = {};
}

int rs_contact_number(const rs_contact* contact, const char* key, double* out, rs_error* error) {
  return guarded(error, [&] {
    const Contact& asked = contact_of(contact);
    require(key, "key", "give a key of the case, as \"material.rail.young\"");
    require(out, "out", "give the address of a number");
    *out = number_of_case(asked.spec(), key);
  });
}

const char* rs_remarks(rs_contact* contact) { return contact ? contact_of(contact).remarks().c_str() : ""; }

int rs_points(const rs_contact* contact, int patch, int* nx, int* ny, rs_error* error) {
  return guarded(error, [&] {
    const ContactField& f = contact_of(contact).patch(patch).field;
    if (nx) *nx = f.stations;
    if (ny) *ny = f.columns;
  });
}

int rs_field(const rs_contact* contact, int patch, int field, double* out, size_t n, rs_error* error) {
  return guarded(error, [&] { copy_field(contact_of(contact).patch(patch).field, field, out, n); });
}

int rs_patch_forces(const rs_contact* contact, int patch, const double* about, rs_patch* out, rs_error* error) {
  return guarded(error, [&] {
    require(out, "out", "give an rs_patch with its size set");
    capi::require_size(*out, "rs_patch");
    const Vec3 point = capi::point_of(about).value_or(Vec3{});
    capi::give(capi::in_c(patch_forces(contact_of(contact), patch, point)), *out);
  });
}

int rs_stress(const rs_contact* contact, int body, const double* xyz, size_t n, double* out, rs_error* error) {
  return guarded(error, [&] {
    const BodyId wanted = body_of(body);
    if (n > 0 && (!xyz || !out)) throw CaseError("xyz or out is missing", "give arrays of 3 n and 6 n numbers");
    std::vector<Vec3> points;
    for (std::size_t k = 0; k < n; ++k, xyz += 3) points.push_back({xyz[0], xyz[1], xyz[2]});
    copy_stresses(contact_of(contact).stress(wanted, points), out);
  });
}

}  // extern "C"
