// Wheelsets that are solved state by state, over the C interface.
#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ask/solve_settings.hpp"
#include "bridge/c_interface.hpp"
#include "bridge/functions.hpp"
#include "bridge/values.hpp"
#include "reader/case_file.hpp"

namespace railstrata::bridge {
namespace {

/// A wheelset, which one thread may use at a time.
struct Wheelset {
  explicit Wheelset(rs_wheelset* made) : at(made) {}
  Wheelset(const Wheelset&) = delete;
  Wheelset& operator=(const Wheelset&) = delete;
  ~Wheelset() { rs_wheelset_free(at); }
  rs_wheelset* at;
  std::mutex one_at_a_time;
};

/// The resolved case, as contacts take it.
void open_wheelset(Call& call) {
  const auto loaded = call.made<LoadedCase>("case");
  const std::vector<std::string> right = overrides_of(call.argument("right"));
  std::vector<const char*> texts;
  for (const std::string& text : right) texts.push_back(text.c_str());
  rs_error error{};
  const auto set = std::make_shared<Wheelset>(rs_wheelset_from_text(
      loaded->resolved_toml.c_str(), nullptr, 0, texts.data(), static_cast<int>(texts.size()), &error));
  if (!set->at) raise(call, error);
  for (int side : {RS_LEFT, RS_RIGHT})
    if (rs_set_cell(rs_wheelset_contact(set->at, side), call.number("cell"), &error) != RS_OK) raise(call, error);
  call.make(set);
}

struct Motion {
  const char* name;
  double rs_wheelset_state::*value;
  unsigned bit;  ///< 0: always read
};
constexpr Motion kMotions[] = {{"y", &rs_wheelset_state::y, 0},
                               {"z", &rs_wheelset_state::z, RS_WHEELSET_Z},
                               {"yaw", &rs_wheelset_state::yaw, 0},
                               {"roll", &rs_wheelset_state::roll, RS_WHEELSET_ROLL},
                               {"speed", &rs_wheelset_state::speed, 0},
                               {"y_rate", &rs_wheelset_state::y_rate, 0},
                               {"z_rate", &rs_wheelset_state::z_rate, 0},
                               {"yaw_rate", &rs_wheelset_state::yaw_rate, 0},
                               {"roll_rate", &rs_wheelset_state::roll_rate, 0},
                               {"pitch_rate", &rs_wheelset_state::pitch_rate, 0},
                               {"load", &rs_wheelset_state::load, RS_WHEELSET_LOAD},
                               {"roll_moment", &rs_wheelset_state::roll_moment, 0}};
struct OfRails {
  const char* name;
  double (rs_wheelset_state::*values)[2];
};
constexpr OfRails kOfRails[] = {{"rail_y", &rs_wheelset_state::rail_y},
                                {"rail_z", &rs_wheelset_state::rail_z},
                                {"rail_roll", &rs_wheelset_state::rail_roll},
                                {"rail_y_rate", &rs_wheelset_state::rail_y_rate},
                                {"rail_z_rate", &rs_wheelset_state::rail_z_rate}};

rs_wheelset_state motion_of(const Json& given) {
  rs_wheelset_state out{};
  out.size = sizeof(rs_wheelset_state);
  for (const Motion& m : kMotions)
    if (given.contains(m.name)) {
      out.given |= m.bit;
      out.*m.value = double_of(given.at(m.name));
    }
  for (const OfRails& m : kOfRails)
    if (given.contains(m.name))
      for (std::size_t side : {0, 1}) (out.*m.values)[side] = double_of(given.at(m.name).at(side));
  return out;
}

Json answer_of(const rs_wheel& w) {
  return {{"force", array_of(w.force)},
          {"moment", array_of(w.moment)},
          {"normal_force", number(w.normal_force)},
          {"lateral_force", number(w.lateral_force)},
          {"spin_moment", number(w.spin_moment)},
          {"creepage_x", number(w.creepage_x)},
          {"creepage_y", number(w.creepage_y)},
          {"spin", number(w.spin)},
          {"approach", number(w.approach)},
          {"point", array_of(w.point)},
          {"on_wheel", array_of(w.on_wheel)},
          {"on_rail", array_of(w.on_rail)},
          {"contact_angle", number(w.contact_angle)},
          {"rolling_radius", number(w.rolling_radius)},
          {"p_max", number(w.p_max)},
          {"patch_area", number(w.patch_area)},
          {"dissipation", number(w.dissipation)},
          {"patches", w.patches},
          {"cells", w.cells},
          {"ok", w.checks_hold != 0}};
}

void solve_wheelset(Call& call) {
  const auto set = call.made<Wheelset>("wheelset");
  const std::lock_guard hold(set->one_at_a_time);
  const rs_wheelset_state state = motion_of(call.argument("state"));
  rs_wheelset_forces forces{};
  forces.size = sizeof(forces);
  rs_error error{};
  const ThreadsOfCaller threads(call.whole("threads"));
  const StopRequest wish(&call.control.stop);
  if (rs_wheelset_solve(set->at, &state, &forces, &error) != RS_OK) raise(call, error);
  call.answer = {{"z", number(forces.z)},
                 {"roll", number(forces.roll)},
                 {"force", array_of(forces.force)},
                 {"moment", array_of(forces.moment)},
                 {"left", answer_of(forces.wheel[RS_LEFT])},
                 {"right", answer_of(forces.wheel[RS_RIGHT])},
                 {"solutions", forces.solutions}};
}

template <auto kStart>
void start(Call& call) {
  const auto set = call.made<Wheelset>("wheelset");
  const std::lock_guard hold(set->one_at_a_time);
  kStart(set->at);
}

}  // namespace

Functions wheelset_functions() {
  return {{"open_wheelset", open_wheelset},
          {"solve_wheelset", solve_wheelset},
          {"keep_wheelset", start<rs_wheelset_keep>},
          {"reset_wheelset", start<rs_wheelset_reset>},
          {"forget_wheelset", start<rs_wheelset_forget>}};
}

}  // namespace railstrata::bridge
