#include <atomic>
#include <memory>
#include <optional>
#include <utility>

#include "case/text_file.hpp"
#include "python/core/bind.hpp"
#include "runs/material_fit.hpp"
#include "runs/material_run.hpp"

namespace railstrata::python {
namespace {

using Columns = std::vector<std::pair<std::string, std::vector<double>>>;

/// A driven path with the law that was driven.
struct DrivenMaterial {
  ChosenMaterial chosen;
  ChosenLaw law;
  bool by_stress = false;
  MaterialRun run;
};

/// How a path or a test is given: a file, else numbers by the names of their columns.
struct Given {
  std::string file;
  Columns columns;
};

MaterialPathTable path_of(const Given& given, bool by_stress) {
  const Prescribed absent = by_stress ? Prescribed::stress : Prescribed::strain;
  if (!given.file.empty())
    return read_material_path(read_text_file(given.file, "name a CSV file with a path"), given.file, absent);
  std::vector<PathColumn> columns;
  for (const auto& [name, values] : given.columns) columns.push_back({name, values});
  return material_path_of(columns, absent);
}

std::shared_ptr<DrivenMaterial> drive(const LoadedCase& card, const std::string& of, double depth, const Given& given,
                                      bool by_stress, int increments, int cycles) {
  const ChosenMaterial chosen = choose_material(card, of);
  auto out = std::make_shared<DrivenMaterial>(DrivenMaterial{chosen, law_of(card, chosen, depth), by_stress, {}});
  const MaterialPathTable table = path_of(given, by_stress);
  std::atomic<bool> stop{false};
  in_background([&] { out->run = run_material(out->law.material, table, increments, cycles, &stop); }, [] {},
                [&] { stop = true; });
  return out;
}

py::dict law_dict(double young, const PlasticParameters<double>& law) {
  py::dict out;
  out["young"] = young;
  out["yield_strength"] = law.yield;
  out["saturation"] = law.saturation;
  out["rate"] = law.rate;
  py::list terms;
  for (int k = 0; k < kMostBackstresses; ++k)
    if (law.modulus[k] > 0) terms.append(py::make_tuple(law.modulus[k], law.recall[k]));
  out["backstresses"] = terms;
  return out;
}

/// A view of one member of every state: so many numbers from `first` on; one number: a row of them.
py::array_t<double> member(const std::vector<MaterialState>& states, const double* first, int numbers,
                           const py::object& owner) {
  const auto n = static_cast<py::ssize_t>(states.size()), step = static_cast<py::ssize_t>(sizeof(MaterialState));
  const auto one = static_cast<py::ssize_t>(sizeof(double));
  py::array_t<double> out = numbers == 1 ? py::array_t<double>({n}, {step}, first, owner)
                                         : py::array_t<double>({n, py::ssize_t{numbers}}, {step, one}, first, owner);
  out.attr("setflags")(py::arg("write") = false);
  return out;
}

/// strain, stress, plastic strain (n, 6), p and dissipated work (n) of the points, or of the states on the way.
py::dict states(const py::object& self, bool on_the_way) {
  const auto& driven = self.cast<const DrivenMaterial&>();
  const std::vector<MaterialState>& all = on_the_way ? driven.run.trace : driven.run.states;
  const MaterialState& s = all.front();
  py::dict out;
  out["strain"] = member(all, s.strain.data(), 6, self);
  out["stress"] = member(all, s.stress.data(), 6, self);
  out["plastic_strain"] = member(all, s.history.data(), 6, self);
  out["p"] = member(all, s.history.data() + 6, 1, self);
  out["dissipated"] = member(all, &s.dissipated, 1, self);
  return out;
}

/// (net plastic strain (cycles, 6), accumulated (cycles)).
py::tuple cycles(const DrivenMaterial& driven) {
  std::vector<double> net, accumulated;
  for (const MaterialCycle& c : driven.run.cycles) {
    net.insert(net.end(), c.net.begin(), c.net.end());
    accumulated.push_back(c.accumulated);
  }
  const auto n = static_cast<py::ssize_t>(driven.run.cycles.size());
  return py::make_tuple(owned(std::move(net), {n, 6}), owned(std::move(accumulated), {n}));
}

/// The table that the command writes: (name, values) a column.
py::list table(const DrivenMaterial& driven) {
  py::list out;
  for (CsvColumn& c : point_columns(driven.run, driven.by_stress)) {
    const auto n = static_cast<py::ssize_t>(c.values.size());
    out.append(py::make_tuple(c.name, owned(std::move(c.values), {n})));
  }
  return out;
}

/// Adds to `notes` what reading says.
std::vector<CurvePoint> curve_of(const Given& given, TestCurve kind, double young, std::vector<std::string>& notes) {
  if (!given.file.empty()) {
    std::vector<std::string> more;
    std::vector<CurvePoint> out =
        read_test_curve(read_text_file(given.file, "name a CSV file of a test"), given.file, kind, young, &more);
    notes.insert(notes.end(), more.begin(), more.end());
    return out;
  }
  std::vector<double> strain, stress;
  bool plastic = false;
  for (const auto& [name, values] : given.columns) {
    if (name == "stress") {
      stress = values;
    } else {
      strain = values;
      plastic = name == "plastic_strain";
    }
  }
  return test_curve_of(strain, stress, plastic, kind, young);
}

/// The law, its card and how well it fits.
py::dict calibrate(const LoadedCase& card, const std::string& of, const Given& cyclic, bool of_loop,
                   const std::optional<Given>& monotonic, int backstresses) {
  const ChosenMaterial chosen = choose_material(card, of);
  const double young = chosen.spec.young;
  const auto name = [](const Given& g, const char* what) {
    return g.file.empty() ? std::string(what) : std::filesystem::path(g.file).filename().string();
  };
  MaterialCurves curves;
  curves.of_loop = of_loop;
  curves.backstresses = backstresses;
  curves.cyclic_place = cyclic.file.empty() ? (of_loop ? "loop" : "amplitudes") : cyclic.file;
  curves.cyclic = curve_of(cyclic, of_loop ? TestCurve::curve : TestCurve::amplitudes, young, curves.notes);
  if (monotonic) {
    curves.monotonic_place = monotonic->file.empty() ? "monotonic" : monotonic->file;
    curves.monotonic = curve_of(*monotonic, TestCurve::curve, young, curves.notes);
  }
  MaterialFit fit;
  in_background([&] { fit = fit_curves(std::move(curves)); }, [] {}, [] {});
  const PlasticParameters<double> law = rounded(fit.whole.law);
  py::dict out;
  out["law"] = law_dict(young, law);
  out["card"] = material_card(
      chosen.spec, law,
      fit_remarks(fit, name(cyclic, of_loop ? "a loop" : "amplitudes"), monotonic ? name(*monotonic, "a curve") : ""));
  out["notes"] = fit.notes;
  out["error"] = fit.stabilised.error;
  out["largest_error"] = fit.stabilised.largest_error;
  return out;
}

Given given_of(const std::string& file, const Columns& columns) { return {file, columns}; }

}  // namespace

void bind_material(py::module_& m) {
  py::class_<Given>(m, "Given").def(py::init(&given_of));
  py::class_<DrivenMaterial, std::shared_ptr<DrivenMaterial>>(m, "DrivenMaterial")
      .def_property_readonly("name", [](const DrivenMaterial& d) { return d.chosen.name; })
      .def_property_readonly("notes", [](const DrivenMaterial& d) { return d.law.notes; })
      .def_property_readonly(
          "law", [](const DrivenMaterial& d) { return law_dict(d.chosen.spec.young, d.law.material.plastic); })
      .def_property_readonly("largest_plastic_strain",
                             [](const DrivenMaterial& d) { return largest_plastic_strain(d.run); })
      .def("states", &states)
      .def("cycles", &cycles)
      .def("table", &table);
  m.def("drive_material", &drive);
  m.def("calibrate", &calibrate);
}

}  // namespace railstrata::python
