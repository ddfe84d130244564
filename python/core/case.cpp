#include "case/case_file.hpp"

#include "case/case_schema.hpp"
#include "python/core/bind.hpp"

namespace railstrata::python {

void bind_case(py::module_& m) {
  py::class_<LoadedCase>(m, "LoadedCase")
      .def_property_readonly("title", [](const LoadedCase& c) { return c.spec.title; })
      .def_property_readonly("file", [](const LoadedCase& c) { return c.file.string(); })
      .def_readonly("overrides", &LoadedCase::overrides)
      .def_readonly("source", &LoadedCase::source_text)
      .def_readonly("toml", &LoadedCase::resolved_toml)
      .def_readonly("notes", &LoadedCase::notes)
      .def_property_readonly("not_in_fem", [](const LoadedCase& c) { return diagnostics(c.not_in_fem); });
  m.def("load_case",
        [](const std::string& file, const std::vector<std::string>& overrides) { return load_case(file, overrides); });
  m.def("parse_case", [](const std::string& text, const std::string& name, const std::vector<std::string>& overrides) {
    return parse_case(text, name, overrides);
  });
  m.def("schema", &case_json_schema);
}

}  // namespace railstrata::python
