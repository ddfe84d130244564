#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "bridge/call.hpp"
#include "calibrate/material_fit.hpp"
#include "calibrate/test_curves.hpp"
#include "laboratory/material_run.hpp"
#include "text/text_file.hpp"

namespace railstrata::bridge {
namespace {

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
  std::vector<PathColumn> columns;
};

Given given_of(const Json& argument) {
  Given out{argument.at("file").get<std::string>(), {}};
  for (const Json& one : argument.at("columns")) {
    const std::span<const double> values = array_of(one.at(1)).all();
    out.columns.push_back({one.at(0).get<std::string>(), {values.begin(), values.end()}});
  }
  return out;
}

MaterialPathTable path_of(const Given& given, bool by_stress) {
  const Prescribed absent = by_stress ? Prescribed::stress : Prescribed::strain;
  if (!given.file.empty())
    return read_material_path(read_text_file(given.file, "name a CSV file with a path"), given.file, absent);
  return material_path_of(given.columns, absent);
}

Json law_json(double young, const PlasticParameters<double>& law) {
  Json terms = Json::array();
  for (int k = 0; k < kMostBackstresses; ++k)
    if (law.modulus[k] > 0) terms.push_back(Json::array({law.modulus[k], law.recall[k]}));
  return {{"young", young},   {"yield_strength", law.yield}, {"saturation", law.saturation},
          {"rate", law.rate}, {"backstresses", terms},       {"recall_power", law.power}};
}

/// A view of one member of every state: so many numbers from `first` on; one number: a row of them.
Json member(const std::vector<MaterialState>& states, const double* first, std::size_t numbers) {
  if (numbers == 1) return Call::view(first, {states.size()}, {sizeof(MaterialState)});
  return Call::view(first, {states.size(), numbers}, {sizeof(MaterialState), sizeof(double)});
}

/// strain, stress, plastic strain (n, 6), p and dissipated work (n).
Json states_json(const std::vector<MaterialState>& all) {
  const MaterialState& s = all.front();
  return {{"strain", member(all, s.strain.data(), 6)},
          {"stress", member(all, s.stress.data(), 6)},
          {"plastic_strain", member(all, s.history.data(), 6)},
          {"p", member(all, s.history.data() + 6, 1)},
          {"dissipated", member(all, &s.dissipated, 1)}};
}

/// Net plastic strain (cycles, 6), accumulated (cycles).
void answer_cycles(Call& call, const MaterialRun& run) {
  std::vector<double> net, accumulated;
  for (const MaterialCycle& c : run.cycles) {
    net.insert(net.end(), c.net.begin(), c.net.end());
    accumulated.push_back(c.accumulated);
  }
  call.answer["net"] = call.kept(std::move(net), {run.cycles.size(), 6});
  call.answer["p_of_cycle"] = call.kept(std::move(accumulated), {run.cycles.size()});
}

void drive(Call& call) {
  const auto card = call.made<LoadedCase>("card");
  const ChosenMaterial chosen = choose_material(*card, call.text("of"));
  const bool by_stress = call.flag("by_stress");
  const auto driven = std::make_shared<DrivenMaterial>(
      DrivenMaterial{chosen, law_of(*card, chosen, call.number("depth")), by_stress, {}});
  const MaterialPathTable table = path_of(given_of(call.argument("path")), by_stress);
  driven->run =
      run_material(driven->law.material, table, call.whole("increments"), call.whole("cycles"), &call.control);
  call.answer = {{"name", driven->chosen.name},
                 {"notes", driven->law.notes},
                 {"law", law_json(driven->chosen.spec.young, driven->law.material.plastic)},
                 {"increments", driven->run.increments},
                 {"strain_error", driven->run.strain_error},
                 {"stress_error", driven->run.stress_error},
                 {"largest_plastic_strain", largest_plastic_strain(driven->run)},
                 {"states", states_json(driven->run.states)},
                 {"on_the_way", states_json(driven->run.trace)}};
  answer_cycles(call, driven->run);
  call.make(driven);
}

/// The table that the command writes.
void driven_table(Call& call) {
  const auto driven = call.made<DrivenMaterial>("driven");
  Json& columns = call.answer["columns"] = Json::object();
  for (CsvColumn& c : point_columns(driven->run, driven->by_stress)) {
    const std::size_t n = c.values.size();
    columns[c.name] = call.kept(std::move(c.values), {n});
  }
}

/// Adds the notes of reading to `notes`.
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

std::string name_of(const Given& given, const char* what) {
  return given.file.empty() ? std::string(what) : std::filesystem::path(given.file).filename().string();
}

/// The law, its card and how well it fits.
void calibrate(Call& call) {
  const ChosenMaterial chosen = choose_material(*call.made<LoadedCase>("card"), call.text("of"));
  const double young = chosen.spec.young;
  const Given cyclic = given_of(call.argument("cyclic"));
  std::optional<Given> monotonic;
  if (!call.argument("monotonic").is_null()) monotonic = given_of(call.argument("monotonic"));
  MaterialCurves curves;
  curves.of_loop = call.flag("of_loop");
  curves.backstresses = call.whole("backstresses");
  curves.cyclic_place = cyclic.file.empty() ? (curves.of_loop ? "loop" : "amplitudes") : cyclic.file;
  curves.cyclic = curve_of(cyclic, curves.of_loop ? TestCurve::curve : TestCurve::amplitudes, young, curves.notes);
  if (monotonic) {
    curves.monotonic_place = monotonic->file.empty() ? "monotonic" : monotonic->file;
    curves.monotonic = curve_of(*monotonic, TestCurve::curve, young, curves.notes);
  }
  const char* const of = curves.of_loop ? "a loop" : "amplitudes";
  const MaterialFit fit = fit_curves(std::move(curves));
  const PlasticParameters<double> law = rounded(fit.whole.law);
  const std::vector<std::string> remarks =
      fit_remarks(fit, name_of(cyclic, of), monotonic ? name_of(*monotonic, "a curve") : "");
  call.answer = {{"law", law_json(young, law)},
                 {"card", material_card(chosen.spec, law, remarks)},
                 {"notes", fit.notes},
                 {"error", fit.stabilised.error},
                 {"largest_error", fit.stabilised.largest_error}};
}

}  // namespace

Functions material_functions() {
  return {{"drive_material", drive}, {"driven_table", driven_table}, {"calibrate", calibrate}};
}

}  // namespace railstrata::bridge
