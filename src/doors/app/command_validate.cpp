#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <set>

#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/shipped_files.hpp"
#include "io/output_folder.hpp"
#include "record/output_file.hpp"
#include "validate/validation_page.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

struct ValidateOptions {
  std::vector<std::string> sets;
  bool all = false;  ///< --all
  fs::path docs;     ///< --docs; empty: none
};

constexpr const char* kShipped = "cases/validation";

/// A folder, or the name of a shipped set.
fs::path folder_of(const std::string& name) {
  if (holds_validation(name)) return name;
  const fs::path shipped = shipped_folder() / kShipped / name;
  if (holds_validation(shipped)) return shipped;
  if (shipped_folder().empty())
    throw CaseError(
        fmt::format("{}: no folder with validation.toml, and the sets of the program are not beside it", name),
        "give a folder; or start the program by ./railstrata, or set RAILSTRATA_DATA to the folder that "
        "has cases/validation");
  std::string known;
  for (const fs::path& folder : validation_folders(shipped_folder() / kShipped))
    known += fmt::format("{}{}", known.empty() ? "" : ", ", folder.filename().string());
  throw CaseError(fmt::format("{}: neither a folder with validation.toml nor a set that comes with the program", name),
                  fmt::format("one of: {}; or a folder of your own", known));
}

/// Each once.
std::vector<fs::path> folders_of(const ValidateOptions& options) {
  std::vector<fs::path> out;
  const auto add = [&](const fs::path& folder) {
    if (std::none_of(out.begin(), out.end(), [&](const fs::path& o) { return fs::equivalent(o, folder); }))
      out.push_back(folder);
  };
  for (const std::string& name : options.sets) add(folder_of(name));
  if (options.all)
    for (const fs::path& folder : validation_folders(shipped_folder() / kShipped)) add(folder);
  return out;
}

/// Sets of one name in several folders are name, name-2, ..: each has a folder of results.
void tell_apart(std::vector<ValidationSet>& sets) {
  std::set<std::string> taken;
  for (ValidationSet& set : sets) {
    const std::string name = set.name;
    for (int k = 2; !taken.insert(set.name).second; ++k) set.name = fmt::format("{}-{}", name, k);
  }
}

void print_sets() {
  for (const fs::path& folder : validation_folders(shipped_folder() / kShipped)) {
    const ValidationSet set = load_validation(folder);
    fmt::print("{:<22} {} ({})\n", set.name, set.title, set.reference);
  }
}

void print_verdict(const Validation& v) {
  for (const Comparison& c : v.comparisons)
    fmt::print("{:<22} {:<22} {:<14} {:>9.3g} (bar {:.3g}{})  {}\n", v.set->name, c.column->title, c.series->name,
               c.difference, c.column->bar, c.column->relative ? " of the data" : "", agreement_text(c.agreement));
  for (const std::string& fault : v.faults) fmt::print("  {}\n", fault);
}

Validation solved(const ValidationSet& set, const CommandOptions& options) {
  InfluenceCache cache;
  BemOptions bem;
  bem.cell = cell_size(options.cell.empty() ? set.cell : options.cell);
  bem.cache = &cache;
  return validate(set, {bem, &control_by_signals()});
}

ExitCode command_validate(const ValidateOptions& wanted, const CommandOptions& options) {
  const std::vector<fs::path> folders = folders_of(wanted);
  if (folders.empty()) {
    print_sets();
    return ExitCode::ok;
  }
  std::vector<ValidationSet> sets;
  for (const fs::path& folder : folders) sets.push_back(load_validation(folder));
  tell_apart(sets);
  const bool own = options.out.empty();  // this command alone writes there: an earlier answer is replaced
  const fs::path out = own ? fs::path("results/validate") : options.out;
  const FolderHold hold = prepare_output_folder(out, options.force || own);
  std::vector<Validation> all;
  for (const ValidationSet& set : sets) {
    control().progress("validate", static_cast<double>(all.size()) / static_cast<double>(sets.size()));
    all.push_back(solved(set, options));
    control().progress("");
    if (control().stop) return ExitCode::interrupted;  // rows are missing
    fs::create_directories(out / set.name);
    write_validation(out / set.name, table_origin(set.loaded), all.back());
    print_verdict(all.back());
  }
  write_whole_file(out / "report.html", validations_page(all));
  if (!wanted.docs.empty()) write_validation_docs(wanted.docs, all);
  spdlog::info("everything on one page: {}", (out / "report.html").string());
  const bool agrees =
      std::all_of(all.begin(), all.end(), [](const Validation& v) { return v.agreement <= Agreement::within_bar; });
  return agrees ? ExitCode::ok : ExitCode::failed_checks;
}

CommandWork declare_validate(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<ValidateOptions>();
  sub.add_option("sets", own->sets, "Names of shipped sets, or folders with validation.toml; none: a list");
  sub.add_flag("--all", own->all, "Every set that comes with the program");
  sub.add_option("--docs", own->docs, "Also write validation.md and its pictures into this folder");
  add_output(sub, options, "results/validate");
  add_cell(sub, options);
  return [own, &options] { return command_validate(*own, options); };
}

}  // namespace

extern const Command kValidateCommand{
    "validate", "Answers held against measurements, other programs and closed forms",
    "Examples:\n  railstrata validate\n  railstrata validate locomotive\n  railstrata "
    "validate my_rig --out results/my_rig\n"
    "  railstrata validate --all\n",
    declare_validate};

}  // namespace railstrata
