// Contacts that are solved state by state, over the C interface.
#include <memory>
#include <mutex>

#include "ask/solve_settings.hpp"
#include "bridge/c_interface.hpp"
#include "bridge/functions.hpp"
#include "reader/case_file.hpp"

namespace railstrata::bridge {
namespace {

/// A contact, which one thread may use at a time.
struct Contact {
  explicit Contact(rs_contact* made) : at(made) {}
  Contact(const Contact&) = delete;
  Contact& operator=(const Contact&) = delete;
  ~Contact() { rs_contact_free(at); }
  rs_contact* at;
  std::mutex one_at_a_time;
};

/// The resolved case, whose profile files have whole paths: it needs neither its file nor its overrides.
void open_contact(Call& call) {
  const auto loaded = call.made<LoadedCase>("case");
  rs_error error{};
  const auto contact =
      std::make_shared<Contact>(rs_contact_from_text(loaded->resolved_toml.c_str(), nullptr, 0, &error));
  if (!contact->at || rs_set_cell(contact->at, call.number("cell"), &error) != RS_OK) raise(call, error);
  call.make(contact);
}

struct Member {
  const char* name;
  unsigned bit;
  double rs_state::*value;
};
constexpr Member kMembers[] = {{"load", RS_LOAD, &rs_state::load},
                               {"approach", RS_APPROACH, &rs_state::approach},
                               {"lateral_shift", RS_LATERAL_SHIFT, &rs_state::lateral_shift},
                               {"yaw", RS_YAW, &rs_state::yaw},
                               {"roll", RS_ROLL, &rs_state::roll},
                               {"speed", RS_SPEED, &rs_state::speed},
                               {"friction", RS_FRICTION, &rs_state::friction},
                               {"creepage_x", RS_CREEPAGE_X, &rs_state::creepage_x},
                               {"creepage_y", RS_CREEPAGE_Y, &rs_state::creepage_y},
                               {"spin", RS_SPIN, &rs_state::spin},
                               {"force_x", RS_FORCE_X, &rs_state::force_x},
                               {"force_y", RS_FORCE_Y, &rs_state::force_y}};

rs_state state_of(const Json& given) {
  rs_state out{};
  out.size = sizeof(rs_state);
  for (const Member& m : kMembers)
    if (given.contains(m.name)) {
      out.given |= m.bit;
      out.*m.value = double_of(given.at(m.name));
    }
  return out;
}

Json answer_of(const rs_forces& f) {
  return {{"force", {number(f.force_x), number(f.force_y), number(f.force_z)}},
          {"normal_force", number(f.normal_force)},
          {"lateral_force", number(f.lateral_force)},
          {"spin_moment", number(f.spin_moment)},
          {"creepage_x", number(f.creepage_x)},
          {"creepage_y", number(f.creepage_y)},
          {"spin", number(f.spin)},
          {"approach", number(f.approach)},
          {"contact_angle", number(f.contact_angle)},
          {"p_max", number(f.p_max)},
          {"q_max", number(f.q_max)},
          {"patch_area", number(f.patch_area)},
          {"slip_area", number(f.slip_area)},
          {"dissipation", number(f.dissipation)},
          {"patches", f.patches},
          {"cells", f.cells},
          {"iterations", f.iterations},
          {"ok", f.checks_hold != 0}};
}

void solve(Call& call) {
  const auto contact = call.made<Contact>("contact");
  const std::lock_guard hold(contact->one_at_a_time);
  const rs_state state = state_of(call.argument("state"));
  rs_forces forces{};
  forces.size = sizeof(rs_forces);
  rs_error error{};
  const ThreadsOfCaller threads(call.whole("threads"));
  const StopRequest wish(&call.control.stop);
  if (rs_solve(contact->at, &state, &forces, &error) != RS_OK) raise(call, error);
  call.answer = {{"forces", answer_of(forces)}, {"remarks", rs_remarks(contact->at)}};
}

/// Copies of the arrays of a patch of the last solution.
void patch(Call& call) {
  const auto contact = call.made<Contact>("contact");
  const std::lock_guard hold(contact->one_at_a_time);
  const int wanted = call.whole("patch");
  int nx = 0, ny = 0;
  rs_error error{};
  if (rs_points(contact->at, wanted, &nx, &ny, &error) != RS_OK) raise(call, error);
  const std::vector<std::size_t> shape{static_cast<std::size_t>(nx), static_cast<std::size_t>(ny)};
  const std::pair<const char*, int> fields[] = {{"x", RS_X},
                                                {"y", RS_Y},
                                                {"z", RS_Z},
                                                {"area", RS_AREA},
                                                {"p", RS_PRESSURE},
                                                {"q_x", RS_TRACTION_X},
                                                {"q_y", RS_TRACTION_Y},
                                                {"slip_x", RS_SLIP_X},
                                                {"slip_y", RS_SLIP_Y},
                                                {"state", RS_STATE}};
  for (const auto& [name, field] : fields) {
    std::vector<double> out(shape[0] * shape[1]);
    if (rs_field(contact->at, wanted, field, out.data(), out.size(), &error) != RS_OK) raise(call, error);
    call.answer[name] = call.kept(std::move(out), shape);
  }
}

void patch_forces(Call& call) {
  const auto contact = call.made<Contact>("contact");
  const std::lock_guard hold(contact->one_at_a_time);
  const Array about = call.array("about");
  if (about.shape != std::vector<std::size_t>{3}) throw std::invalid_argument("about: three numbers are wanted");
  rs_patch p{};
  p.size = sizeof(rs_patch);
  rs_error error{};
  if (rs_patch_forces(contact->at, call.whole("patch"), about.data, &p, &error) != RS_OK) raise(call, error);
  call.answer = {{"force", array_of(p.force)},
                 {"moment", array_of(p.moment)},
                 {"normal_force", number(p.normal_force)},
                 {"lateral_force", number(p.lateral_force)},
                 {"spin_moment", number(p.spin_moment)},
                 {"approach", number(p.approach)},
                 {"point", array_of(p.point)},
                 {"on_wheel", array_of(p.on_wheel)},
                 {"on_rail", array_of(p.on_rail)},
                 {"contact_angle", number(p.contact_angle)},
                 {"rolling_radius", number(p.rolling_radius)},
                 {"p_max", number(p.p_max)},
                 {"patch_area", number(p.patch_area)},
                 {"dissipation", number(p.dissipation)},
                 {"cells", p.cells}};
}

void stress(Call& call) {
  const auto contact = call.made<Contact>("contact");
  const std::lock_guard hold(contact->one_at_a_time);
  const Array points = call.array("points");
  if (points.shape.size() != 2 || points.shape[1] != 3)
    throw std::invalid_argument("points: an array of shape (n, 3) is wanted");
  std::vector<double> out(6 * points.shape[0]);
  rs_error error{};
  const StopRequest wish(&call.control.stop);
  const int body = call.text("body") == "rail" ? RS_RAIL : RS_WHEEL;
  if (rs_stress(contact->at, body, points.data, points.shape[0], out.data(), &error) != RS_OK) raise(call, error);
  call.answer["stresses"] = call.kept(std::move(out), {points.shape[0], 6});
}

void forget(Call& call) {
  const auto contact = call.made<Contact>("contact");
  const std::lock_guard hold(contact->one_at_a_time);
  rs_forget(contact->at);
}

}  // namespace

Functions contact_functions() {
  return {{"open_contact", open_contact},    {"solve_contact", solve},      {"patch_of_contact", patch},
          {"forces_of_patch", patch_forces}, {"stress_of_contact", stress}, {"forget_contact", forget}};
}

}  // namespace railstrata::bridge
