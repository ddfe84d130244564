#include "validate/validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace railstrata {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

RowTexts rows_of(const ValidationSet& set) {
  RowTexts rows(set.data.rows());
  for (const VariedColumn& v : set.varied) {
    const std::vector<double> values = set.data.column(v.column, v.factor);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].push_back(fmt::format("{}{}{}{}", v.before, values[i], v.unit.empty() ? "" : " ", v.unit));
  }
  return rows;
}

/// Of all rows, as the bar of the column has it: absolute, or over the data.
template <class Absolute>
double of_all(const Comparison& comparison, Absolute&& absolute) {
  const ComparedColumn& column = *comparison.column;
  double squares = 0, largest = 0;
  for (const ComparedPoint& p : comparison.points) {
    const double m = absolute(p) / (column.relative ? std::abs(p.data) : 1);
    if (!std::isfinite(m)) return kUnknown;
    squares += m * m;
    largest = std::max(largest, m);
  }
  return column.by == DifferenceBy::largest ? largest
                                            : std::sqrt(squares / static_cast<double>(comparison.points.size()));
}

double largest_factor(const Comparison& comparison) {
  double largest = 1;
  for (const ComparedPoint& p : comparison.points) {
    const double factor = p.ours / p.data;
    if (!std::isfinite(factor) || !(factor > 0)) return kUnknown;
    largest = std::max({largest, factor, 1 / factor});
  }
  return largest;
}

Agreement agreement_of(const Comparison& c) {
  if (!std::isfinite(c.difference)) return Agreement::unsolved;
  if (c.difference <= c.scatter) return Agreement::within_scatter;
  return c.difference <= c.column->bar ? Agreement::within_bar : Agreement::outside;
}

Comparison compare(const ValidationSet& set, const ValidationSeries& series, const ComparedColumn& column,
                   const Answers& answers) {
  const std::vector<double> none(set.data.rows(), kUnknown),
      data = set.data.column(column.column),
      at = set.varied.empty() ? none : set.data.column(set.varied.front().column),
      deviation = column.deviation.empty() ? none : set.data.column(column.deviation);
  const auto found = std::find_if(answers.numbers.begin(), answers.numbers.end(),
                                  [&](const CsvColumn& c) { return c.name == column.result; });
  assert(found != answers.numbers.end());
  Comparison out{.column = &column, .series = &series, .points = {}};
  for (std::size_t i = 0; i < data.size(); ++i)
    out.points.push_back(
        {at[i], data[i], deviation[i], i < found->values.size() ? column.factor * found->values[i] : kUnknown});
  out.difference = column.by == DifferenceBy::factor
                       ? largest_factor(out)
                       : of_all(out, [](const ComparedPoint& p) { return std::abs(p.ours - p.data); });
  out.scatter = of_all(out, [](const ComparedPoint& p) { return p.deviation; });
  out.agreement = series.judged ? agreement_of(out) : Agreement::not_judged;
  return out;
}

}  // namespace

const char* agreement_text(Agreement a) {
  constexpr const char* kTexts[] = {"not judged", "within the scatter", "within the bar", "outside", "not solved"};
  return kTexts[static_cast<int>(a)];
}

Validation validate(const ValidationSet& set, const AnswerOptions& options) {
  const RowTexts rows = rows_of(set);
  Validation out{.set = &set, .comparisons = {}, .faults = {}, .agreement = Agreement::not_judged};
  for (const ValidationSeries& series : set.series) {
    const Answers answers =
        series.recorded.empty() ? set.kind->answer(set, series, rows, options) : recorded_answers(set, series, rows);
    for (const std::string& fault : answers.faults)
      out.faults.push_back(series.name.empty() ? fault : series.name + ", " + fault);
    for (const ComparedColumn& column : set.compared) {
      out.comparisons.push_back(compare(set, series, column, answers));
      if (!std::isfinite(out.comparisons.back().difference) && answers.faults.empty())
        out.faults.push_back(fmt::format("{}: answers of this kind and case have no {}", column.title, column.result));
      out.agreement = std::max(out.agreement, out.comparisons.back().agreement);
    }
  }
  return out;
}

}  // namespace railstrata
