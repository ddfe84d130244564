#include "app/common_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "core/engine.hpp"

namespace railstrata {

std::string engines_text() {
  std::string out;
  for (const EngineRow& row : kEngines)
    out += fmt::format("{}{} ({}: {})", out.empty() ? "" : ", ", row.word, row.title, row.about);
  return out;
}

CLI::Option* add_repeated(CLI::App& sub, const std::string& name, std::vector<std::string>& values, const char* word,
                          const char* what) {
  return sub.add_option(name, values, what)->allow_extra_args(false)->option_text(word);
}

void add_set(CLI::App& sub, CommandOptions& options, const char* what) {
  add_repeated(sub, "--set", options.overrides, "KEY=VALUE", what);
}

void add_case(CLI::App& sub, CommandOptions& options) {
  sub.add_option("case", options.case_file, "Case file, or a folder with case.toml")->required();
  add_set(sub, options, "Override a key: --set mesh.element_size=\"2 mm\"; once for each key");
}

CLI::Option* add_out(CLI::App& sub, CommandOptions& options, const std::string& what) {
  return sub.add_option("-o,--out", options.out, what)
      ->check(
          CLI::Validator([](const std::string& text) { return std::string(text.empty() ? "names nothing" : ""); }, ""));
}

void add_output(CLI::App& sub, CommandOptions& options, const char* preset) {
  add_out(sub, options, fmt::format("Folder for the results (default: {})", preset));
  sub.add_flag("--force", options.force, "Write into a folder that is not empty; files of the same name are replaced");
}

void add_case_and_output(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>");
}

void add_no_report(CLI::App& sub, CommandOptions& options) {
  sub.add_flag_callback(
      "--no-report", [&options] { options.page = false; }, "Do not write report.html");
}

void add_cell(CLI::App& sub, CommandOptions& options) {
  sub.add_option("--cell", options.cell, "Cells of the potential contact area (default: \"0.25 mm\")");
}

CLI::Validator finite() {
  return {[](const std::string& text) {
            return std::isfinite(std::strtod(text.c_str(), nullptr)) ? std::string() : text + " is no finite number";
          },
          "FINITE"};
}

}  // namespace railstrata
