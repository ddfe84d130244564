#pragma once
// Answers that were computed at length before, from a table of results such as study.csv.
#include "validate/validation_kind.hpp"

namespace railstrata {

/// Of each row the first one of series.recorded that has its texts in the columns named as the varied keys, and those
/// of series.where. Throws CaseError: no such table or column.
Answers recorded_answers(const ValidationSet& set, const ValidationSeries& series, const RowTexts& rows);

}  // namespace railstrata
