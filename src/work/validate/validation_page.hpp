#pragma once
// What a validation shows: a page, a table, pictures, and the page of the documentation over all sets.
#include <filesystem>
#include <string>
#include <vector>

#include "report/report.hpp"
#include "validate/validation.hpp"

namespace railstrata {

/// Writes comparison.csv and report.html into the folder.
void write_validation(const std::filesystem::path& folder, const std::vector<std::string>& origin,
                      const Validation& validation);

/// A page over several: the verdicts as a table, then every chart.
std::string validations_page(const std::vector<Validation>& all);

/// A comparison as a picture (SVG): data with bars of their standard deviation, answers as lines.
std::string comparison_svg(const Validation& validation, const ComparedColumn& column);

/// Writes validation.md and images/validation-<set>-<k>.svg into the folder of the documentation.
void write_validation_docs(const std::filesystem::path& docs, const std::vector<Validation>& all);

}  // namespace railstrata
