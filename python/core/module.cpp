#include "python/core/bind.hpp"

#include "core/parallel.hpp"
#include "io/provenance.hpp"

// The module `railstrata._core`.
PYBIND11_MODULE(_core, m) {
  using namespace railstrata;
  python::register_errors();
  python::bind_case(m);
  python::bind_patch(m);
  python::bind_half_space(m);
  python::bind_folder(m);
  python::bind_run(m);
  python::bind_sweep(m);
  python::bind_damage(m);
  python::bind_material(m);
  python::bind_passes(m);
  m.def("version", [] { return build_info().version; });
  m.def("version_text", &version_text);
  m.def("threads", &max_threads);
  m.def("set_threads", &set_threads);
}
