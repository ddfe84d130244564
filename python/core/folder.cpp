#include <memory>

#include "io/result_folder.hpp"
#include "python/core/bind.hpp"
#include "runs/write_report.hpp"

namespace railstrata::python {

void bind_folder(py::module_& m) {
  py::class_<ResultFolder, std::shared_ptr<ResultFolder>>(m, "ResultFolder")
      .def("summary", [](const ResultFolder& f) { return f.summary.dump(); })
      .def_property_readonly("patches", [](const ResultFolder& f) { return 1 + f.further.size(); })
      .def("patch", [](const py::object& self, std::size_t index) {
        const auto& f = self.cast<const ResultFolder&>();
        return PatchHandle{self, index == 0 ? &f.field : &f.further.at(index - 1)};
      });
  m.def("read_result_folder",
        [](const std::string& folder) { return std::make_shared<ResultFolder>(read_result_folder(folder)); });
  m.def("write_report", [](const std::string& page, const std::vector<std::string>& folders, bool reference) {
    const py::gil_scoped_release release;
    return write_report(page, {folders.begin(), folders.end()}, reference).notes;
  });
}

}  // namespace railstrata::python
