#include "contact/contact_field.hpp"

#include "python/core/bind.hpp"

namespace railstrata::python {
namespace {

using Numbers = std::vector<double> ContactField::*;

py::array_t<double> numbers(const py::object& self, Numbers which) {
  const ContactField& f = *self.cast<const PatchHandle&>().field;
  return view((f.*which).data(), {f.stations, f.columns}, self);
}

py::array_t<std::uint8_t> states(const py::object& self) {
  static_assert(sizeof(ContactState) == sizeof(std::uint8_t));
  const ContactField& f = *self.cast<const PatchHandle&>().field;
  return view(reinterpret_cast<const std::uint8_t*>(f.state.data()), {f.stations, f.columns}, self);
}

}  // namespace

void bind_patch(py::module_& m) {
  py::class_<PatchHandle> patch(m, "PatchHandle");
  const std::pair<const char*, Numbers> arrays[] = {
      {"x", &ContactField::x},       {"y", &ContactField::y},           {"z", &ContactField::z},
      {"area", &ContactField::area}, {"p", &ContactField::p},           {"q_x", &ContactField::q_x},
      {"q_y", &ContactField::q_y},   {"slip_x", &ContactField::slip_x}, {"slip_y", &ContactField::slip_y}};
  for (const auto& [name, which] : arrays) {
    const Numbers member = which;
    patch.def_property_readonly(name, [member](const py::object& self) { return numbers(self, member); });
  }
  patch.def_property_readonly("state", &states);
  patch.def_property_readonly("slip_is_distance", [](const PatchHandle& p) { return p.field->slip_is_distance; });
}

}  // namespace railstrata::python
