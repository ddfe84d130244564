#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <fstream>
#include <iterator>

#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/shipped_files.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void print_what_is_there(const fs::path& out, const fs::path& case_file) {
  fmt::print(
      "\nResults: {}\n"
      "  report.html    everything on one page, for any browser\n"
      "  summary.json   the numbers and their checks\n"
      "  patch.csv      pressure, traction, slip and state of every point of the patch\n"
      "  *.pvd, *.vtu   for ParaView\n"
      "The case: {}\n",
      out.string(), case_file.string());
}

ExitCode command_demo(const CommandOptions& options) {
  const fs::path shipped = shipped_folder();
  if (shipped.empty())
    throw EnvironmentError("the cases that come with the program are not beside it",
                           "install it with `cmake --install`, or name their folder in RAILSTRATA_DATA");
  CommandOptions run = options;
  run.case_file = shipped / "cases/quick/case.toml";
  if (run.out.empty()) run.out = "results/quick";
  // An earlier demo is replaced without a question, other people's files are not.
  if (!run.force && fs::exists(run.out / "case.original.toml"))
    run.force = text_of(run.out / "case.original.toml") == text_of(run.case_file);
  const ExitCode code = command_run(run);
  if (!options.json && (code == ExitCode::ok || code == ExitCode::failed_checks))
    print_what_is_there(run.out, run.case_file);
  return code;
}

void declare_demo(CLI::App& sub, CommandOptions& options) {
  add_output(sub, options, "results/quick");
  add_set(sub, options, "Override a key of the case; once for each key");
  add_no_report(sub, options);
}

}  // namespace

const Command kDemoCommand{
    "demo", "Run the shipped case cases/quick, in a minute or two, and print where the results are",
    "Examples:\n  railstrata demo\n  railstrata demo --out /tmp/quick\n", declare_demo, command_demo};

}  // namespace railstrata
