#pragma once
// Options that several commands declare, and the values of those that are texts.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands.hpp"

namespace railstrata {

/// An option that is written again for each further value.
CLI::Option* add_repeated(CLI::App& sub, const std::string& name, std::vector<std::string>& values, const char* word,
                          const char* what);
void add_set(CLI::App& sub, CommandOptions& options, const char* what);
/// The case file and --set.
void add_case(CLI::App& sub, CommandOptions& options);
/// --out, which may not be empty: an empty variable of a script does not mean the folder that is taken without --out.
CLI::Option* add_out(CLI::App& sub, CommandOptions& options, const std::string& what);
/// --out and --force of a result folder.
void add_output(CLI::App& sub, CommandOptions& options, const char* preset);
void add_no_report(CLI::App& sub, CommandOptions& options);
void add_cell(CLI::App& sub, CommandOptions& options);
/// Accepts finite numbers only; CLI::Range would accept NaN.
CLI::Validator finite();

/// The cell size of --cell ("0.25 mm"), m; the half-space engine's own default for an empty text. Throws CaseError.
double cell_size(const std::string& text);

/// A length in m. `option` names it in the CaseError of a text that is none.
double length_of(const std::string& option, const std::string& text);
/// "50 Mt" in kg, the same way; above 0.
double mass_of(const std::string& option, const std::string& text);

/// "10 min", "90 s", "1.5 h" in s; "0" and "never" are 0. `option` names it in the CaseError of a text that is no time.
double wall_time(const std::string& option, const std::string& text);

/// Whether the name ends in .html or .htm.
bool is_page_name(const std::filesystem::path& page);

/// A page by another name opens in no browser, and a result's own files have other names. Throws CaseError: the name
/// of --out does not end in .html or .htm; `preset` is what a name could be.
void require_name_of_page(const std::filesystem::path& page, const std::string& preset);

}  // namespace railstrata
