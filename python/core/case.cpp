#include "case/case_file.hpp"

#include "case/case_schema.hpp"
#include "case/units.hpp"
#include "python/core/bind.hpp"

namespace railstrata::python {

namespace {

/// m, of a text such as "0.2 mm"; `what` names it in messages.
double length_of(const std::string& what, const std::string& text) {
  try {
    return parse_quantity(text, dimension::kLength);
  } catch (const UnitError& e) {
    throw CaseError(what + ": " + e.what(), e.remedy);
  }
}

}  // namespace

void bind_case(py::module_& m) {
  py::class_<LoadedCase>(m, "LoadedCase")
      .def_property_readonly("title", [](const LoadedCase& c) { return c.spec.title; })
      .def_property_readonly("file", [](const LoadedCase& c) { return c.file.string(); })
      .def_readonly("overrides", &LoadedCase::overrides)
      .def_readonly("source", &LoadedCase::source_text)
      .def_readonly("toml", &LoadedCase::resolved_toml)
      .def_property_readonly("notes",
                             [](const LoadedCase& c) {
                               std::vector<std::string> all = c.notes;
                               for (const auto* more : {&c.elastic_notes, &c.static_notes})
                                 all.insert(all.end(), more->begin(), more->end());
                               return all;
                             })
      .def_readonly("static_notes", &LoadedCase::static_notes)
      .def_property_readonly("not_in_fem", [](const LoadedCase& c) { return diagnostics(c.not_in_fem); });
  m.def("load_case",
        [](const std::string& file, const std::vector<std::string>& overrides) { return load_case(file, overrides); });
  m.def("parse_case", [](const std::string& text, const std::string& name, const std::vector<std::string>& overrides) {
    return parse_case(text, name, overrides);
  });
  m.def("length_of", &length_of);
  m.def("schema", &case_json_schema);
}

}  // namespace railstrata::python
