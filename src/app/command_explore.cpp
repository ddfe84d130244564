#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/option_values.hpp"
#include "app/page_name.hpp"
#include "explore/page.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"

namespace railstrata {
namespace {

/// What there is to look at without a case: a layer on a rail.
constexpr const char* kShippedCase = "cases/paper/layer_3mm_2E0.toml";

}  // namespace

ExitCode command_explore(const CommandOptions& given) {
  CommandOptions options = given;
  if (options.case_file.empty()) options.case_file = kShippedCase;
  const std::filesystem::path page = options.out.empty() ? "explore.html" : options.out;
  require_name_of_page(page, "explore.html");
  if (!options.force && std::filesystem::exists(page))
    throw CaseError(fmt::format("{}: there is a file of this name", page.string()),
                    "choose another name with --out, or replace it with --force");
  const std::string text = explorer_page(load_case_of(options), options.case_file, cell_size(options.cell));
  if (page.has_parent_path()) make_folder(page.parent_path());
  write_whole_file(page, text);
  if (options.json) fmt::print("{}\n", json_text(nlohmann::json{{"page", page.generic_string()}}));
  spdlog::info("the explorer is {}: open it in any browser, also without a network", page.string());
  return ExitCode::ok;
}

}  // namespace railstrata
