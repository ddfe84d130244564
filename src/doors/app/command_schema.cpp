#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "options/case_schema.hpp"
#include "report/result_reference.hpp"
#include "rules/clashes.hpp"

namespace railstrata {
namespace {

ExitCode command_schema(const CommandOptions& options) {
  const bool markdown = options.schema.markdown;
  if (options.schema.results)
    fmt::print("{}", markdown ? results_reference_markdown() : results_reference_json().dump(2) + "\n");
  else
    fmt::print("{}", markdown ? case_reference_markdown() : case_json_schema());
  return ExitCode::ok;
}

void declare_schema(CLI::App& sub, CommandOptions& options) {
  auto* json = sub.add_flag("--json-schema", options.schema.json_schema, "JSON schema (default)");
  sub.add_flag("--markdown", options.schema.markdown, "Reference page in Markdown")->excludes(json);
  sub.add_flag("--results", options.schema.results,
               "Of results instead of cases: every number of summary.json, every check");
  sub.add_flag_callback(
      "--exclusions",
      [] {
        fmt::print("{}", exclusions_markdown());
        throw CLI::Success();
      },
      "Page in Markdown: which settings exclude each other");
}

}  // namespace

const Command kSchemaCommand{
    "schema", "Print the JSON schema of case files for editors, or the reference of cases or results",
    "Examples:\n  railstrata schema --json-schema > case.schema.json\n  railstrata schema --markdown\n  railstrata "
    "schema --results --markdown\n",
    declare_schema, command_schema};

}  // namespace railstrata
