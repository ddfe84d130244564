#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/common_options.hpp"
#include "explore/page.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

/// The case when none is given: a layer on a rail.
constexpr const char* kShippedCase = "cases/paper/layer_3mm_2E0.toml";

ExitCode command_explore(const CommandOptions& given) {
  CommandOptions options = given;
  if (options.case_file.empty()) options.case_file = kShippedCase;
  const std::filesystem::path page = options.out.empty() ? "explore.html" : options.out;
  require_name_of_page(page, "explore.html");
  if (!options.force && std::filesystem::exists(page))
    throw CaseError(fmt::format("{}: there is a file of this name", page.string()),
                    "choose another name with --out, or replace it with --force");
  const std::string text =
      explorer_page(load_case_of(options, uses::kExplorer), options.case_file, cell_size(options.cell));
  if (page.has_parent_path()) make_folder(page.parent_path());
  write_whole_file(page, text);
  if (options.json) fmt::print("{}\n", json_text(nlohmann::json{{"page", page.generic_string()}}));
  spdlog::info("the explorer is {}: open it in any browser, also without a network", page.string());
  return ExitCode::ok;
}

CommandWork declare_explore(CLI::App& sub, CommandOptions& options) {
  sub.add_option("case", options.case_file,
                 "Case file, or a folder with case.toml (default: cases/paper/layer_3mm_2E0.toml)");
  add_set(sub, options, "Override a key of the case; once for each key");
  add_out(sub, options, "The page to write, NAME.html (default: explore.html)");
  sub.add_flag("--force", options.force, "Replace a file of this name");
  add_cell(sub, options);
  return [&options] { return command_explore(options); };
}

}  // namespace

extern const Command kExploreCommand{
    "explore",
    "One page with the half-space engine inside: sliders for layers, load and drive, and a contact that follows them",
    "Examples:\n  railstrata explore\n  railstrata explore cases/paper/layer_3mm_2E0.toml --out layer.html\n",
    declare_explore};

}  // namespace railstrata
