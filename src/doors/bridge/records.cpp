#include "bridge/records.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

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

std::vector<Vec3> points_of(const Array& given) {
  if (given.shape.size() != 2 || given.shape[1] != 3)
    throw std::invalid_argument("points: an array of shape (n, 3) is wanted");
  std::vector<Vec3> out;
  for (std::size_t k = 0; k < given.shape[0]; ++k) {
    const double* row = given.data + 3 * k;
    if (!std::isfinite(row[0]) || !std::isfinite(row[1]) || !std::isfinite(row[2]))
      throw std::invalid_argument("points: row " + std::to_string(k) + " is not a number");
    out.push_back({row[0], row[1], row[2]});
  }
  return out;
}

std::array<double, 6> components(const Sym3& s) { return {s.xx, s.yy, s.zz, s.xy, s.yz, s.xz}; }

void answer_stresses(Call& call, const std::vector<Sym3>& stresses) {
  std::vector<double> out;
  for (const Sym3& s : stresses)
    for (const double number : components(s)) out.push_back(number);
  call.answer["stresses"] = call.kept(std::move(out), {stresses.size(), 6});
}

}  // namespace railstrata::bridge
