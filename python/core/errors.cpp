#include "core/faults.hpp"

#include "python/core/bind.hpp"

namespace railstrata::python {
namespace {

py::object error_class(const char* name) { return py::module_::import("railstrata.errors").attr(name); }

void raise(const char* name, const py::object& error) { PyErr_SetObject(error_class(name).ptr(), error.ptr()); }

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const CaseError& e) {
    raise("CaseError", error_class("CaseError")(e.what(), diagnostics(e.diagnostics)));
  } catch (const NumericalError& e) {
    raise("NumericalError", error_class("NumericalError")(e.what()));
  } catch (const EnvironmentError& e) {
    raise("MachineError", error_class("MachineError")(e.what(), e.remedy));
  } catch (const Interrupted& e) {
    PyErr_SetString(PyExc_KeyboardInterrupt, e.what());
  }
}

}  // namespace

py::list diagnostics(const std::vector<Diagnostic>& all) {
  py::list out;
  const py::object one = error_class("Diagnostic");
  for (const Diagnostic& d : all) out.append(one(d.message, d.remedy, d.where));
  return out;
}

void register_errors() { py::register_exception_translator(&translate); }

}  // namespace railstrata::python
