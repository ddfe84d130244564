#include "bridge/patches.hpp"

namespace railstrata::bridge {

Json patch_of(const ContactField& f) {
  const std::vector<std::size_t> shape{static_cast<std::size_t>(f.stations), static_cast<std::size_t>(f.columns)};
  const std::pair<const char*, const std::vector<double>*> arrays[] = {
      {"x", &f.x},     {"y", &f.y},     {"z", &f.z},           {"area", &f.area},    {"p", &f.p},
      {"q_x", &f.q_x}, {"q_y", &f.q_y}, {"slip_x", &f.slip_x}, {"slip_y", &f.slip_y}};
  Json out;
  for (const auto& [name, values] : arrays) out[name] = Call::view(values->data(), shape);
  static_assert(sizeof(ContactState) == 1);
  out["state"] = Call::view(reinterpret_cast<const unsigned char*>(f.state.data()), shape);
  out["slip_is_distance"] = f.slip_is_distance;
  return out;
}

}  // namespace railstrata::bridge
