#include "app/common_options.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdlib>

#include "bem/bem_options.hpp"
#include "record/escaped_text.hpp"
#include "text/units.hpp"

namespace railstrata {

CLI::Option* add_repeated(CLI::App& sub, const std::string& name, std::vector<std::string>& values, const char* word,
                          const char* what) {
  return sub.add_option(name, values, what)->allow_extra_args(false)->option_text(word);
}

void add_set(CLI::App& sub, CommandOptions& options, const char* what) {
  add_repeated(sub, "--set", options.overrides, "KEY=VALUE", what);
}

void add_case(CLI::App& sub, CommandOptions& options) {
  sub.add_option("case", options.case_file, "Case file, a folder with case.toml, or NAME.inp of CONTACT")->required();
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

namespace {

double quantity_of(const std::string& option, const std::string& text, const Dimension& dimension) {
  try {
    return parse_quantity(text, dimension);
  } catch (const UnitError& e) {
    throw CaseError(fmt::format("{} \"{}\": {}", option, text, e.what()), e.remedy);
  }
}

}  // namespace

double length_of(const std::string& option, const std::string& text) {
  return quantity_of(option, text, dimension::kLength);
}

double mass_of(const std::string& option, const std::string& text) {
  const double mass = quantity_of(option, text, dimension::kMass);
  if (mass > 0 && std::isfinite(mass)) return mass;
  throw CaseError(fmt::format("{} \"{}\": must be above 0", option, text), "write e.g. \"20 Mt\"");
}

double cell_size(const std::string& text) {
  if (text.empty()) return BemOptions{}.cell;
  const double cell = length_of("--cell", text);
  if (!(cell >= kSmallestCell && cell <= kLargestCell))
    throw CaseError(fmt::format("--cell \"{}\" is out of range", text),
                    fmt::format("write a length from {:g} mm to {:g} mm", 1e3 * kSmallestCell, 1e3 * kLargestCell));
  return cell;
}

double wall_time(const std::string& option, const std::string& text) {
  if (text == "0" || text == "never") return 0;
  try {
    const double seconds = parse_quantity(text, dimension::kTime);
    if (seconds >= 0 && std::isfinite(seconds)) return seconds;
    throw CaseError(fmt::format("{} \"{}\" is out of range", option, text),
                    "write a time, e.g. \"10 min\", or 0 for never");
  } catch (const UnitError& e) {
    throw CaseError(fmt::format("{} \"{}\": {}", option, text, e.what()), e.remedy);
  }
}

bool is_page_name(const std::filesystem::path& page) {
  std::string ending = page.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".html" || ending == ".htm";
}

void require_name_of_page(const std::filesystem::path& page, const std::string& preset) {
  if (is_page_name(page)) return;
  const std::filesystem::path name = page.filename();
  const bool folder = name.empty() || name == "." || name == "..";
  const std::filesystem::path other = folder ? page / preset : std::filesystem::path(page).replace_extension(".html");
  throw CaseError(fmt::format("--out {}: a page has a name that ends in .html", page.string()),
                  fmt::format("write for example --out {}", shell_word(other.string())));
}

}  // namespace railstrata
