#pragma once
// Rows of many cases on the terminal.
#include <string>
#include <vector>

#include "many/case_row.hpp"

namespace railstrata {

/// A number that the terminal shows of a case.
struct ListedNumber {
  std::string heading;
  std::string column;  ///< of the row's numbers
  double factor = 1;
  int digits = 1;
};

/// Largest pressure and traction, area, slip, longitudinal creepage.
const std::vector<ListedNumber>& listed_numbers();

/// Those of listed_numbers() and the load factor to shakedown that differ between the cases; of one case all. Where the
/// rail varies along the way, the extremes of the way instead of the contact at its end.
std::vector<ListedNumber> telling_numbers(const std::vector<CaseRow>& rows);

/// A line a row: the cells of `head`, the numbers, the fault; "-" where there is none.
void print_rows(const std::vector<CaseColumn>& head, const std::vector<ListedNumber>& numbers,
                const std::vector<CaseRow>& rows);

}  // namespace railstrata
