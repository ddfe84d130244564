#pragma once
// Answers the rows of a validation set and compares them with its data.
#include <string>
#include <vector>

#include "validate/validation_set.hpp"

namespace railstrata {

enum class Agreement {
  not_judged,      ///< shown alone
  within_scatter,  ///< no further from the data than they scatter
  within_bar,
  outside,
  unsolved  ///< a row has no answer
};
const char* agreement_text(Agreement a);

/// A row of the data: the place along the first varied column, the data, our answer; NaN where there is none.
struct ComparedPoint {
  double x = 0, data = 0, deviation = 0, ours = 0;
};

/// A compared column of a series.
struct Comparison {
  const ComparedColumn* column = nullptr;
  const ValidationSeries* series = nullptr;
  std::vector<ComparedPoint> points;
  double difference = 0;  ///< of all rows, as the column's bar has it
  double scatter = 0;     ///< root mean square of the data's deviations, as the bar; NaN: not known
  Agreement agreement = Agreement::unsolved;
};

/// Refers to the set's columns and series.
struct Validation {
  const ValidationSet* set = nullptr;
  std::vector<Comparison> comparisons;
  std::vector<std::string> faults;            ///< of rows without an answer
  Agreement agreement = Agreement::unsolved;  ///< the worst of what is judged
};

/// Throws CaseError for values that are refused in every row.
Validation validate(const ValidationSet& set, const AnswerOptions& options);

}  // namespace railstrata
