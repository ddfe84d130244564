#pragma once
// What the rows of a validation set are: half-space solutions, points of a material's path, points below a pressed
// surface, rails through their traffic. A kind names what a column of the data may give and which numbers an answer
// has, and finds them.
#include <string>
#include <string_view>
#include <vector>

#include "bem/bem_options.hpp"
#include "core/control.hpp"
#include "record/csv.hpp"

namespace railstrata {

struct ValidationSet;
struct ValidationSeries;

/// Numbers of all rows of a series; NaN where a row has none.
struct Answers {
  std::vector<CsvColumn> numbers;
  std::vector<std::string> faults;  ///< "row 3: why"
};

struct AnswerOptions {
  BemOptions bem;
  const Control* control = nullptr;
};

/// Of each row a text for each varied column: "0.2 mm".
using RowTexts = std::vector<std::vector<std::string>>;

struct ValidationKind {
  std::string_view name;
  std::vector<std::string> settings;  ///< keys of validation.toml that it has alone
  std::vector<std::string> keys;      ///< what a column may give; empty: any key of the case
  std::vector<std::string> results;   ///< names of an answer's numbers, with their units
  /// Throws CaseError for values that are refused in every row.
  Answers (*answer)(const ValidationSet& set, const ValidationSeries& series, const RowTexts& rows,
                    const AnswerOptions& options);
};

/// Answers that were computed at length before, from a table of results such as study.csv: of each row the first one of
/// series.recorded that has its texts in the columns named as the varied keys, and those of series.where. Throws
/// CaseError: no such table or column.
Answers recorded_answers(const ValidationSet& set, const ValidationSeries& series, const RowTexts& rows);

/// contact, the default, material, pressure, traffic.
const std::vector<ValidationKind>& validation_kinds();

}  // namespace railstrata
