#include "ask/wheelset_slopes.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "capi/guarded.hpp"
#include "capi/handles.hpp"

using namespace railstrata;
using capi::guarded;
using capi::require;
using capi::wheelset_of;

namespace {

WheelsetState state_of(const rs_wheelset_state& callers) {
  const rs_wheelset_state given = capi::taken(callers, "rs_wheelset_state");
  WheelsetState out;
  capi::Reader read{reinterpret_cast<const char*>(&given) + offsetof(rs_wheelset_state, y), given.given};
  for (const auto& row : kWheelsetState) with_member(row, out, read);
  if (given.given & ~(read.bit - 1))
    throw CaseError(fmt::format("rs_wheelset_state.given = {} has bits that have no meaning", given.given),
                    "use RS_WHEELSET_Z, RS_WHEELSET_ROLL and RS_WHEELSET_LOAD");
  return out;
}

rs_wheelset_forces in_c(const WheelsetForces& found) {
  rs_wheelset_forces out{};
  const std::size_t last = kWheelsetForces.size() - 2;  // after the wheels
  capi::fill(std::span(kWheelsetForces).first(last), found, out, offsetof(rs_wheelset_forces, z));
  for (std::size_t side : {kLeft, kRight})
    capi::fill(kWheelForces, found.wheels[side], out.wheel[side], offsetof(rs_wheel, force));
  out.solutions = found.solutions;
  out.beyond = found.beyond;
  return out;
}

WheelsetInput input_of(int number) {
  if (number < 0) throw CaseError(fmt::format("there is no input {}", number), "give RS_BY_Y and so on");
  const auto given = static_cast<std::size_t>(number);
  return {given % RS_OF_RIGHT, given / RS_OF_RIGHT};
}

rs_wheelset_derivatives in_c(const WheelsetSlopes& found) {
  rs_wheelset_derivatives out{};
  capi::Writer write{reinterpret_cast<char*>(&out.z)};
  for (const auto& row : kWheelsetSlopes) with_member(row, found, write);
  for (const Wrench& wheel : found.wheels) {
    write(wheel.force);
    write(wheel.moment);
  }
  return out;
}

/// read: a case of its overrides.
template <class Read>
rs_wheelset* new_wheelset(const char* const* overrides, int count, const char* const* right, int right_count,
                          rs_error* error, Read&& read) {
  return capi::made(error, [&] {
    std::vector<std::string> texts = capi::overrides_of(overrides, count);
    const LoadedCase left = read(texts);
    const auto of_right = capi::overrides_of(right, right_count);
    texts.insert(texts.end(), of_right.begin(), of_right.end());
    return capi::handle_of(new Wheelset(left, read(texts)));
  });
}

}  // namespace

extern "C" {

rs_wheelset* rs_wheelset_new(const char* case_file, const char* const* overrides, int count, const char* const* right,
                             int right_count, rs_error* error) {
  return new_wheelset(overrides, count, right, right_count, error, [&](const std::vector<std::string>& texts) {
    require(case_file, "case_file", "give its path");
    return load_case(case_file, texts);
  });
}

rs_wheelset* rs_wheelset_from_text(const char* toml, const char* const* overrides, int count, const char* const* right,
                                   int right_count, rs_error* error) {
  return new_wheelset(overrides, count, right, right_count, error, [&](const std::vector<std::string>& texts) {
    require(toml, "toml", "give the text of a case");
    return parse_case(toml, "case.toml", texts);
  });
}

rs_wheelset* rs_wheelset_copy(const rs_wheelset* wheelset, rs_error* error) {
  return capi::made(error, [&] { return capi::handle_of(new Wheelset(wheelset_of(wheelset))); });
}

void rs_wheelset_free(rs_wheelset* wheelset) {
  if (wheelset) delete &wheelset_of(wheelset);
}

int rs_wheelset_solve(rs_wheelset* wheelset, const rs_wheelset_state* state, rs_wheelset_forces* forces,
                      rs_error* error) {
  return guarded(error, [&] {
    Wheelset& asked = wheelset_of(wheelset);
    drop_solution(asked);
    require(state, "state", "give an rs_wheelset_state with its size set");
    require(forces, "forces", "give an rs_wheelset_forces with its size set");
    capi::require_size(*forces, "rs_wheelset_forces");
    WheelsetState wanted = state_of(*state);
    wanted.extrapolate = capi::shows_beyond(*forces);
    capi::give(in_c(solve(asked, wanted)), *forces);
  });
}

int rs_wheelset_jacobian(rs_wheelset* wheelset, const int* inputs, int count, rs_wheelset_derivatives* out,
                         rs_error* error) {
  return guarded(error, [&] {
    Wheelset& asked = wheelset_of(wheelset);
    if (count < 0 || (count > 0 && (!inputs || !out)))
      throw CaseError("inputs or out is missing", "give arrays of `count`");
    const auto n = static_cast<std::size_t>(count);
    capi::require_sizes(out, n, "rs_wheelset_derivatives");
    std::vector<WheelsetInput> wanted;
    for (std::size_t k = 0; k < n; ++k) wanted.push_back(input_of(inputs[k]));
    const std::vector<WheelsetSlopes> found = slopes(asked, wanted);
    for (std::size_t k = 0; k < n; ++k) capi::give(in_c(found[k]), capi::element(out, k));
  });
}

int rs_wheelset_patch(const rs_wheelset* wheelset, int side, int patch, const double* about, rs_patch* out,
                      rs_error* error) {
  return guarded(error, [&] {
    const Wheelset& asked = wheelset_of(wheelset);
    require(out, "out", "give an rs_patch with its size set");
    capi::require_size(*out, "rs_patch");
    capi::give(capi::in_c(patch_forces(asked, side, patch, capi::point_of(about))), *out);
  });
}

const char* rs_wheelset_remarks(const rs_wheelset* wheelset) {
  return wheelset ? wheelset_of(wheelset).remarks.c_str() : "";
}

void rs_wheelset_keep(rs_wheelset* wheelset) {
  if (wheelset) keep(wheelset_of(wheelset));
}

void rs_wheelset_reset(rs_wheelset* wheelset) {
  if (wheelset) reset(wheelset_of(wheelset));
}

void rs_wheelset_forget(rs_wheelset* wheelset) {
  if (wheelset) forget(wheelset_of(wheelset));
}

rs_contact* rs_wheelset_contact(rs_wheelset* wheelset, int side) {
  if (!wheelset || side < RS_LEFT || side > RS_RIGHT) return nullptr;
  return capi::handle_of(&wheelset_of(wheelset).wheels[static_cast<std::size_t>(side)].contact);
}

}  // extern "C"
