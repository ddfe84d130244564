#pragma once
// What the parts of the module `railstrata._core` share. It holds handles and views; names, defaults and conveniences
// stand in the Python files beside it.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <vector>

#include "contact/contact_field.hpp"
#include "core/faults.hpp"

namespace railstrata::python {

namespace py = pybind11;

/// A read-only view of numbers that `owner` holds: no copy, and the owner lives as long as the view.
template <class T>
py::array_t<T> view(const T* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array_t<T> out(std::move(shape), data, owner);
  out.attr("setflags")(py::arg("write") = false);
  return out;
}

/// An array that owns what was computed for it; read-only, as all arrays of the package.
template <class T>
py::array_t<T> owned(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return view(kept->data(), std::move(shape), owner);
}

/// One patch of a result. `keep` is the Python object that holds the field.
struct PatchHandle {
  py::object keep;
  const ContactField* field = nullptr;
};

/// Runs `work` on a thread of its own without the interpreter's lock. Meanwhile this thread asks every 20 ms whether
/// Ctrl-C was pressed and calls `look`; if either raises, `stop` is called, the work is waited for and the exception
/// goes on. What the work throws is thrown here.
void in_background(const std::function<void()>& work, const std::function<void()>& look,
                   const std::function<void()>& stop);

/// Faults of the core become the exceptions of railstrata.errors.
void register_errors();
/// A list of railstrata.errors.Diagnostic.
py::list diagnostics(const std::vector<Diagnostic>& all);

void bind_case(py::module_& m);
void bind_patch(py::module_& m);
void bind_half_space(py::module_& m);
void bind_folder(py::module_& m);
void bind_run(py::module_& m);
void bind_sweep(py::module_& m);
void bind_damage(py::module_& m);
void bind_material(py::module_& m);
void bind_passes(py::module_& m);

}  // namespace railstrata::python
