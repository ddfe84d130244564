#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <map>
#include <memory>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/common_options.hpp"
#include "ask/answer.hpp"
#include "export/abaqus_deck.hpp"
#include "export/contact_files.hpp"
#include "export/dyna_deck.hpp"
#include "export/export_readme.hpp"
#include "io/output_folder.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

const std::map<std::string, ExportTarget> kTargets{{"calculix", ExportTarget::calculix},
                                                   {"abaqus", ExportTarget::abaqus},
                                                   {"lsdyna", ExportTarget::lsdyna},
                                                   {"contact", ExportTarget::contact}};

struct ExportOptions {
  std::string to;         ///< --to: the word of a program
  bool friction = false;  ///< --friction: in the deck's contact
};

/// Names of files with their contents, and what each is.
struct Files {
  std::vector<std::pair<std::string, std::string>> contents;
  std::vector<std::string> lines;
  std::string comparison;  ///< of the readme
  void add(const std::string& name, const std::string& what, std::string content) {
    contents.emplace_back(name, std::move(content));
    lines.push_back(fmt::format("{:<18} {}", name, what));
  }
};

Files deck(const LoadedCase& loaded, ExportTarget target, bool friction) {
  const SolidModel model = solid_model(build_model(loaded.spec, loaded.folder()));
  Files out;
  out.comparison = deck_comparison(model, target);
  if (target == ExportTarget::lsdyna) {
    out.add("preload.k", "the deck", dyna_deck(model, friction));
    return out;
  }
  const DeckFlavour flavour = target == ExportTarget::abaqus ? DeckFlavour::abaqus : DeckFlavour::calculix;
  out.add("preload.inp", "the deck", abaqus_deck(model, {flavour, friction}));
  return out;
}

/// Options of the other kind of program.
void require_used(const ExportOptions& wanted, const CommandOptions& options, ExportTarget target) {
  if (target == ExportTarget::contact && wanted.friction)
    throw CaseError("--friction: CONTACT's files have the friction of the half-space solution", "leave it out");
  if (target != ExportTarget::contact && !options.cell.empty())
    throw CaseError(fmt::format("--cell: the meshes for {} have no cells", wanted.to),
                    "leave it out; the meshes' fineness is mesh.element_size");
}

/// Several patches are CONTACT's cases 1, 2, …
Files contact_result(const LoadedCase& loaded, const std::string& cell) {
  const Placement placement = place(loaded.spec, loaded.folder());
  BemOptions bem;
  bem.cell = cell_size(cell);
  bem.apart = false;
  const CaseSpec spec = half_space_case(loaded.spec);
  const BemResult result = solve_contact(loaded.spec, placement, {.bem = bem}).result;
  const std::vector<const BemPatch*> patches = patches_of(result);
  Files out;
  out.comparison = contact_comparison();
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const std::string name = fmt::format("rail.{:04}", k + 1);
    out.add(name + ".mat", "the contact, for loadcase.m", contact_mat(spec, placement, *patches[k]));
    out.add(name + ".subs", "stresses in the rail, for loadstrs.m", contact_stresses(result.rail, *patches[k]));
    const std::string input = k == 0 ? "rail.inp" : fmt::format("rail_{}.inp", k + 1);
    if (refused_by(uses::kContactInput, spec).empty())
      out.add(input, "the case, module 3", contact_input(spec, placement, *patches[k]));
  }
  return out;
}

std::vector<std::string> export_words() { return {"calculix", "abaqus", "lsdyna", "contact"}; }

ExitCode command_export(const ExportOptions& wanted, const CommandOptions& options) {
  const ExportTarget target = kTargets.at(wanted.to);
  require_used(wanted, options, target);
  const LoadedCase loaded = load_case_of(options, target == ExportTarget::contact ? uses::kContactResult : uses::kDeck);
  const std::filesystem::path out = output_folder_of(options, loaded, "-" + wanted.to);
  const Files files =
      target == ExportTarget::contact ? contact_result(loaded, options.cell) : deck(loaded, target, wanted.friction);
  const FolderHold hold = prepare_output_folder(out, options.force);
  write_origin(out, loaded, options.command_line, options.threads);
  for (const auto& [name, content] : files.contents) write_whole_file(out / name, content);
  write_whole_file(out / "README.txt",
                   export_readme(loaded.spec, target, files.lines, wanted.friction, files.comparison));
  if (options.json)
    fmt::print("{}\n", json_text(nlohmann::json{{"folder", out.generic_string()}}));
  else
    fmt::print("{} is in {}; README.txt there lists what was not carried over\n", files.contents.front().first,
               out.string());
  return ExitCode::ok;
}

CommandWork declare_export(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<ExportOptions>();
  sub.add_option("case", options.case_file, "Case file, or a folder with case.toml: a case's or a result's")
      ->required();
  add_set(sub, options, "Override a key of the case; once for each key");
  sub.add_option("--to", own->to, "The program that reads it")->check(CLI::IsMember(export_words()))->required();
  add_output(sub, options, "results/<case name>-<program>");
  sub.add_flag("--friction", own->friction,
               "abaqus, calculix, lsdyna: the contact has the case's friction coefficient (default: none, as in the "
               "preload here)");
  add_cell(sub, options);
  return [own, &options] { return command_export(*own, options); };
}

}  // namespace

extern const Command kExportCommand{
    "export",
    "The case in the files of other programs: mesh and static preload for Abaqus, CalculiX and LS-DYNA; case and "
    "half-space result for CONTACT",
    "Examples:\n  railstrata export cases/quick --to calculix --out /tmp/quick-ccx\n  railstrata export "
    "cases/verification/hertz_sphere.toml --to contact\n",
    declare_export};

}  // namespace railstrata
