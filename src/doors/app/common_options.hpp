#pragma once
// Options that several commands declare.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/commands.hpp"

namespace railstrata {

/// "fem (finite elements: …), bem (…)".
std::string engines_text();

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
void add_case_and_output(CLI::App& sub, CommandOptions& options);
void add_no_report(CLI::App& sub, CommandOptions& options);
void add_cell(CLI::App& sub, CommandOptions& options);
/// Accepts finite numbers only; CLI::Range would accept NaN.
CLI::Validator finite();

}  // namespace railstrata
