#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <memory>

#include <nlohmann/json.hpp>

#include "app/common_options.hpp"
#include "app/progress.hpp"
#include "app/shipped_files.hpp"
#include "calibrate/material_fit.hpp"
#include "core/faults.hpp"
#include "laboratory/material_run.hpp"
#include "material/strain_claim.hpp"
#include "record/escaped_text.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"
#include "text/text_file.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

struct MaterialOptions {
  fs::path strain, stress;                      ///< --strain, --stress: a path
  fs::path calibrate, cyclic_curve, monotonic;  ///< --calibrate, --cyclic-curve, --monotonic: tests
  fs::path shear_yield;                         ///< --shear-yield: points of strained steel
  int increments = 100;                         ///< --increments
  int cycles = 1;                               ///< --cycles
  int backstresses = 0;                         ///< --backstresses; 0: as many as lower the error
  std::string of = "rail";                      ///< --of
  std::string depth;                            ///< --depth: a length; empty: the top
};
constexpr std::size_t kShownCycles = 5;

double depth_of(const std::string& text) {
  if (text.empty()) return 0;
  try {
    const double depth = parse_quantity(text, dimension::kLength);
    if (depth >= 0 && std::isfinite(depth)) return depth;
  } catch (const UnitError& e) {
    throw CaseError(fmt::format("--depth {}: {}", text, e.what()), e.remedy);
  }
  throw CaseError(fmt::format("--depth {}: must be at least 0 mm", text), "write for example --depth \"2 mm\"");
}

/// Only a table of this command or an empty file is overwritten.
bool replaceable(const fs::path& file, const std::string& first_line) {
  std::error_code error;
  if (!fs::exists(file, error) || fs::file_size(file, error) == 0) return true;
  try {
    return read_text_file(file, "").starts_with(first_line);
  } catch (const CaseError&) {
    return false;
  }
}

fs::path output_of(const CommandOptions& options, const std::string& preset, const char* ending,
                   const std::string& first_line) {
  const fs::path out = options.out.empty() ? fs::path("results") / (preset + ending) : options.out;
  if (out.extension() != ending)
    throw CaseError(
        fmt::format("--out {}: the file's name must end in {}", out.string(), ending),
        fmt::format("write for example --out {}", shell_word(fs::path(out).replace_extension(ending).string())));
  if (!options.force && !replaceable(out, first_line))
    throw CaseError(fmt::format("--out {}: there is a file of this name", out.string()),
                    "choose another name, or replace it with --force");
  if (out.has_parent_path()) make_folder(out.parent_path());
  return out;
}

std::string law_text(const PlasticMaterial& m) {
  const PlasticParameters<double>& p = m.plastic;
  std::string out = fmt::format("yields at {:.1f} MPa", kToMega * p.yield);
  if (p.saturation != 0) out += fmt::format(", Q = {:.1f} MPa with b = {:g}", kToMega * p.saturation, p.rate);
  for (int k = 0; k < kMostBackstresses; ++k)
    if (p.modulus[k] > 0)
      out += fmt::format(", C{0} = {1:.0f} MPa with gamma{0} = {2:g}", k + 1, kToMega * p.modulus[k], p.recall[k]);
  if (p.power > 0) out += fmt::format(", recall_power = {}", p.power);
  return out;
}

std::string cycles_text(const MaterialRun& run) {
  std::string out = fmt::format("\n  {:>6} {:>14} {:>14}\n", "cycle", "net plastic", "accumulated");
  const std::size_t n = run.cycles.size();
  for (std::size_t i = 0; i < n; ++i)
    if (i < kShownCycles || i + 1 == n)
      out += fmt::format("{}  {:>6} {:>13.6f}% {:>13.6f}%\n", i + 1 == n && n > kShownCycles + 1 ? "  ...\n" : "",
                         i + 1, kToPercent * run.cycles[i].largest_net(), kToPercent * run.cycles[i].accumulated);
  return out;
}

void warn_of_large_strain(const MaterialRun& run) {
  if (const std::string words = strain_warning(largest_plastic_strain(run)); !words.empty()) spdlog::warn("{}", words);
}

nlohmann::ordered_json as_json(const MaterialRun& run, const fs::path& out, const std::vector<std::string>& notes) {
  nlohmann::ordered_json json{{"table", out.generic_string()}};
  for (const CsvColumn& c : point_columns(run, true)) json["points"][c.name] = c.values;
  for (const CsvColumn& c : cycle_columns(run)) json["cycles"][c.name] = c.values;
  json["dissipated_J_m3"] = run.states.back().dissipated;
  json["increments"] = run.increments;
  json["strain_error"] = run.strain_error;
  json["stress_error_Pa"] = run.stress_error;
  json["notes"] = notes;
  return json;
}

ExitCode drive(const MaterialOptions& o, const CommandOptions& options, const LoadedCase& loaded) {
  const ChosenMaterial which = choose_material(loaded, o.of);
  const ChosenLaw law = law_of(loaded, which, depth_of(o.depth));
  const PlasticMaterial& material = law.material;
  const bool by_stress = !o.stress.empty();
  const fs::path file = shipped_unless_there(by_stress ? o.stress : o.strain);
  const MaterialPathTable table =
      read_material_path(read_text_file(file, "name a CSV file with a path; cases/material has examples"), file,
                         by_stress ? Prescribed::stress : Prescribed::strain);
  const fs::path out = output_of(options, loaded.file.stem().string() + "-" + file.stem().string(), ".csv",
                                 by_stress ? "e_xx,e_yy," : "s_xx_MPa,");
  answer_interrupt_with("\nstopped: nothing was written\n");
  const MaterialRun run = [&] {
    const Waiting waiting("driving the material");
    return run_material(material, table, o.increments, o.cycles);
  }();
  write_csv(out, {}, point_columns(run, by_stress));
  if (run.cycles.size() > 1) write_csv(fs::path(out).replace_extension(".cycles.csv"), {}, cycle_columns(run));
  std::vector<std::string> remarks{law_text(material)};
  remarks.insert(remarks.end(), law.notes.begin(), law.notes.end());
  write_whole_file(
      fs::path(out).replace_extension(".svg"),
      path_picture(fmt::format("{} of {}, along {}", which.name, loaded.file.string(), file.string()), run, remarks));
  for (const std::string& note : law.notes) spdlog::info("{}", note);
  warn_of_large_strain(run);
  if (options.json) {
    fmt::print("{}\n", json_text(as_json(run, out, law.notes), 2));
  } else {
    fmt::print("{}: {}\n{} points, {}; accumulated plastic strain {:.6f} %, dissipated {:.6g} MJ/m3\n{}", which.name,
               law_text(material), run.states.size(), increments_text(run), kToPercent * run.states.back().history[6],
               kToMega * run.states.back().dissipated, run.cycles.size() > 1 ? cycles_text(run) : "");
  }
  spdlog::info("the table is {}, its picture in the same folder", out.string());
  return ExitCode::ok;
}

ExitCode calibrate(const MaterialOptions& o, const CommandOptions& options, const LoadedCase& loaded) {
  const ChosenMaterial which = choose_material(loaded, o.of);
  MaterialTests tests{o.calibrate, o.cyclic_curve, o.monotonic, o.shear_yield, o.backstresses};
  for (fs::path* file : {&tests.loop, &tests.amplitudes, &tests.monotonic, &tests.shear_yield})
    if (!file->empty()) *file = shipped_unless_there(*file);
  const fs::path source = !tests.shear_yield.empty() ? tests.shear_yield
                          : tests.loop.empty()       ? tests.amplitudes
                                                     : tests.loop;
  const std::string head = "# Fitted by RailStrata";
  const fs::path out = output_of(options, source.stem().string() + "-fit", ".toml", head);
  answer_interrupt_with("\nstopped: nothing was written\n");
  const MaterialFit fit = fit_material(tests, which.spec.young);
  const std::vector<std::string> remarks =
      fit_remarks(fit, source.filename().string(), tests.monotonic.filename().string());
  const PlasticParameters<double> law = rounded(fit.whole.law);
  const std::string card = material_card(which.spec, law, remarks);
  write_whole_file(out, card);
  write_whole_file(fs::path(out).replace_extension(".svg"),
                   fit_picture(fmt::format("fit to {}", source.string()), fit, remarks));
  for (const std::string& note : fit.notes) spdlog::warn("{}", note);
  if (options.json) {
    nlohmann::ordered_json json{{"card", out.generic_string()},
                                {"young_Pa", which.spec.young},
                                {"yield_strength_Pa", law.yield},
                                {"saturation_Pa", law.saturation},
                                {"rate", law.rate},
                                {"error", fit.stabilised.error},
                                {"largest_error", fit.stabilised.largest_error},
                                {"notes", fit.notes}};
    for (int k = 0; k < kMostBackstresses; ++k)
      if (law.modulus[k] > 0)
        json["backstresses"].push_back({{"modulus_Pa", law.modulus[k]}, {"recall", law.recall[k]}});
    fmt::print("{}\n", json_text(json, 2));
  } else {
    fmt::print("{}", card);
  }
  spdlog::info("the card is {}, the picture of the fit in the same folder", out.string());
  return ExitCode::ok;
}

ExitCode command_material(const MaterialOptions& o, const CommandOptions& options) {
  const bool path = !o.strain.empty() || !o.stress.empty(),
             fit = !o.calibrate.empty() || !o.cyclic_curve.empty() || !o.shear_yield.empty();
  if (path == fit)
    throw CaseError(
        path ? "a path to drive and a test to fit are given"
        : o.monotonic.empty()
            ? "neither a path nor a test is given"
            : "a tensile test alone does not distinguish hardening that turns round with the load (C, gamma) "
              "from hardening that stays (Q, b): both pull the same curve",
        "give one of --strain PATH.csv, --stress PATH.csv, --calibrate LOOP.csv, --cyclic-curve CURVE.csv and "
        "--shear-yield POINTS.csv");
  if ((path || !o.shear_yield.empty()) && !o.monotonic.empty())
    throw CaseError("--monotonic belongs to a fit to cycles",
                    "give --calibrate LOOP.csv or --cyclic-curve CURVE.csv with it");
  // A case's notes concern its contact, which is not computed here.
  const LoadedCase loaded = load_case(shipped_unless_there(options.case_file, "case.toml"), options.overrides);
  return path ? drive(o, options, loaded) : calibrate(o, options, loaded);
}

CommandWork declare_material(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<MaterialOptions>();
  MaterialOptions& m = *own;
  sub.add_option("card", options.case_file, "Case file with the material, e.g. one with [material.rail] alone")
      ->required();
  add_set(sub, options, "Override a key of the card; once for each key");
  auto* strain = sub.add_option("--strain", m.strain, "A path of strains: CSV with e_xx, e_yy, e_zz, e_xy, e_yz, e_xz");
  sub.add_option("--stress", m.stress,
                 "A path of stresses: CSV with s_xx_MPa, …; what has no column is free of stress, e_xx prescribes a "
                 "strain instead")
      ->excludes(strain);
  sub.add_option("--increments", m.increments,
                 "Equal steps from row to row to begin with (default: 100); they are doubled, and the states "
                 "extrapolated, until "
                 "these change by less than a thousandth")
      ->check(CLI::Range(1, 10000000));
  sub.add_option("--cycles", m.cycles, "Times through the rows (default: 1)")->check(CLI::Range(1, 1000000));
  auto* loop = sub.add_option("--calibrate", m.calibrate,
                              "Fit the law to a stabilised loop: CSV with strain, stress_MPa, once around");
  sub.add_option("--cyclic-curve", m.cyclic_curve,
                 "Fit it to amplitudes of stabilised cycles: CSV with strain_amplitude, stress_amplitude_MPa")
      ->excludes(loop);
  sub.add_option("--shear-yield", m.shear_yield,
                 "Fit isotropic hardening to yield stresses of sheared steel: CSV with pss (plastic shear strain), "
                 "sys_MPa (shear yield stress)")
      ->excludes(loop)
      ->excludes("--cyclic-curve");
  sub.add_option("--monotonic", m.monotonic,
                 "With a fit: a tensile curve, for the isotropic part: CSV with strain, stress_MPa");
  sub.add_option("--backstresses", m.backstresses,
                 "Of a fit (default: one more as long as it lowers the error by a quarter)")
      ->check(CLI::Range(1, 4));
  sub.add_option("--of", m.of, "The material: rail (default), wheel or a layer's name");
  sub.add_option("--depth", m.depth, "Of a material graded with depth: where (default: its top)");
  add_out(sub, options, "The table to write, NAME.csv, or the card of a fit, NAME.toml; the picture is NAME.svg");
  sub.add_flag("--force", options.force, "Replace a file that this command has not written");
  return [own, &options] { return command_material(*own, options); };
}

}  // namespace

extern const Command kMaterialCommand{
    "material", "A material law along a path of strain or stress, or fitted to a test: tables, a ready card, a picture",
    "Examples:\n  railstrata material cases/material/r260.toml --strain cases/material/strain_path.csv --increments "
    "200 --out loops.csv\n  railstrata material cases/material/r260.toml --stress cases/material/ratchetting.csv "
    "--cycles 50 --out ratchetting.csv\n  railstrata material cases/material/r260.toml --calibrate "
    "cases/material/loop.csv --monotonic cases/material/tension.csv --out fitted.toml\n\nCtrl-C: nothing is "
    "written.\n",
    declare_material};

}  // namespace railstrata
