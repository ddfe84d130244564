#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "bem/bem_options.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "io/output_folder.hpp"
#include "io/summary_json.hpp"
#include "model/model.hpp"
#include "python/core/bind.hpp"
#include "runs/half_space_need.hpp"
#include "runs/solve_half_space.hpp"
#include "runs/solve_settings.hpp"
#include "runs/write_half_space_result.hpp"
#include "runs/write_transient.hpp"

namespace railstrata::python {
namespace {

/// A solution with what its stresses and files need.
struct HalfSpaceRun {
  LoadedCase loaded;
  Placement placement;
  HalfSpaceSolution solution;
  const BemPatch& patch(std::size_t index) const {
    return index == 0 ? solution.result : solution.result.further.at(index - 1);
  }
  std::size_t patches() const { return 1 + solution.result.further.size(); }
};
using RunPointer = std::shared_ptr<HalfSpaceRun>;

/// What a caller wants of a solution.
struct Wanted {
  double cell = 0.25e-3;
  int threads = 0;
  bool stresses = true, single_track = false, maps = false;
};

BemOptions options_of(const Wanted& wanted) {
  require_cell(wanted.cell);
  if (wanted.threads < 0) throw CaseError("threads is negative", "give 0 for as many as OpenMP has");
  BemOptions options;
  options.cell = wanted.cell;
  return options;
}

HalfSpaceSolution solved(const HalfSpaceRun& run, const Wanted& wanted, const TransientObserver& observer) {
  const BemOptions options = options_of(wanted);
  require_memory(half_space_need(run.loaded.spec, run.placement, wanted.cell), wanted.cell);
  if (!wanted.stresses) return solve_half_space_contact(run.loaded.spec, run.placement, options, observer);
  HalfSpaceSolution solution = solve_half_space(run.loaded.spec, run.placement, options, observer);
  if (wanted.single_track || wanted.maps) complete_shakedown(run.loaded.spec, solution, wanted.maps);
  return solution;
}

RunPointer solve(const LoadedCase& loaded, const Wanted& wanted, const py::object& progress) {
  auto run = std::make_shared<HalfSpaceRun>(HalfSpaceRun{loaded, place(loaded.spec, loaded.folder()), {}});
  std::atomic<bool> stop{false};
  std::atomic<double> fraction{0};
  const TransientObserver observer = [&](const TransientState& state) {
    fraction = static_cast<double>(state.step) / state.steps;
    return !stop.load();
  };
  const auto work = [&] {
    const ThreadsOfCaller threads(wanted.threads);
    try {
      run->solution = solved(*run, wanted, observer);
    } catch (const CaseError& e) {
      throw in_case_file(loaded, e);
    }
  };
  const auto look = [&] {
    if (!progress.is_none()) progress(fraction.load());
  };
  if (loaded.spec.transient.kind == TransientKind::none) {
    const py::gil_scoped_release release;
    work();
  } else {
    in_background(work, look, [&] { stop = true; });
  }
  return run;
}

Subsurface interior(const HalfSpaceRun& run, const std::string& body, std::size_t patch) {
  if (body == "rail") return rail_interior(run.solution.result.rail, run.patch(patch));
  return wheel_interior(run.solution.result.wheel, run.patch(patch));
}

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

void put(const Sym3& s, double* out) {
  const double numbers[6] = {s.xx, s.yy, s.zz, s.xy, s.yz, s.xz};
  std::copy(numbers, numbers + 6, out);
}

/// (n, 6) stresses at (n, 3) points.
py::array_t<double> stresses_at(const HalfSpaceRun& run, const std::string& body, std::size_t patch,
                                const Points& points, bool below_interface) {
  if (points.ndim() != 2 || points.shape(1) != 3) throw py::value_error("points: an array of shape (n, 3) is wanted");
  const auto n = static_cast<std::size_t>(points.shape(0));
  std::vector<Vec3> at;
  for (std::size_t k = 0; k < n; ++k) {
    const double* row = points.data() + 3 * k;
    if (!std::isfinite(row[0]) || !std::isfinite(row[1]) || !std::isfinite(row[2]))
      throw py::value_error("points: row " + std::to_string(k) + " is not a number");
    at.push_back({row[0], row[1], row[2]});
  }
  std::vector<double> out(6 * n);
  {
    const py::gil_scoped_release release;
    const std::vector<InteriorPoint> found = interior(run, body, patch).at(at, below_interface);
    for (std::size_t k = 0; k < n; ++k) put(found[k].stress, &out[6 * k]);
  }
  return owned(std::move(out), {static_cast<py::ssize_t>(n), 6});
}

/// (6, nx, ny) stresses in the cells of the patch's grid at a depth.
py::array_t<double> stress_plane(const HalfSpaceRun& run, const std::string& body, std::size_t patch, double depth,
                                 bool below_interface) {
  if (!(depth >= 0 && std::isfinite(depth))) throw py::value_error("depth: a length of 0 or more is wanted");
  const PatchGrid& grid = run.patch(patch).grid;
  std::vector<double> out(6 * grid.size());
  {
    const py::gil_scoped_release release;
    const Subsurface inside = interior(run, body, patch);
    const StatePlane plane = inside.plane(depth);
    for (std::size_t k = 0; k < grid.size(); ++k) {
      double numbers[6];
      put(inside.stress(plane, k, below_interface), numbers);
      for (std::size_t c = 0; c < 6; ++c) out[c * grid.size() + k] = numbers[c];
    }
  }
  return owned(std::move(out), {6, grid.nx, grid.ny});
}

py::tuple grid_axes(const HalfSpaceRun& run, std::size_t patch) {
  const PatchGrid& grid = run.patch(patch).grid;
  std::vector<double> x, y;
  for (int i = 0; i < grid.nx; ++i) x.push_back(grid.x(i));
  for (int j = 0; j < grid.ny; ++j) y.push_back(grid.y(j));
  return py::make_tuple(owned(std::move(x), {grid.nx}), owned(std::move(y), {grid.ny}));
}

void write(const HalfSpaceRun& run, const std::string& folder, bool force) {
  const py::gil_scoped_release release;
  require_apart(folder, run.loaded);
  const FolderHold hold = prepare_output_folder(folder, force);
  clear_old_results(folder);
  write_origin(folder, run.loaded, {"railstrata.bem (Python)"}, max_threads());
  write_half_space_result(folder, table_origin(run.loaded), run.loaded.spec, run.placement, run.solution);
}

}  // namespace

void bind_half_space(py::module_& m) {
  py::class_<HalfSpaceRun, RunPointer>(m, "HalfSpaceRun")
      .def("summary", [](const HalfSpaceRun& run) { return summary_json(run.solution.summary).dump(); })
      .def_property_readonly("notes", [](const HalfSpaceRun& run) { return run.solution.result.notes; })
      .def_property_readonly("patches", &HalfSpaceRun::patches)
      .def("patch",
           [](const py::object& self, std::size_t index) {
             return PatchHandle{self, &self.cast<const HalfSpaceRun&>().patch(index).field};
           })
      .def("grid", &grid_axes)
      .def("stresses_at", &stresses_at)
      .def("stress_plane", &stress_plane)
      .def("write", &write);
  m.def("solve_half_space", [](const LoadedCase& loaded, double cell, int threads, bool stresses, bool single_track,
                               bool maps, const py::object& progress) {
    return solve(loaded, {cell, threads, stresses, single_track, maps}, progress);
  });
}

}  // namespace railstrata::python
