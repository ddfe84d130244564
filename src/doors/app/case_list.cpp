#include "app/case_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "many/result_columns.hpp"

namespace railstrata {
namespace {

/// Forces, pressure and stress, not their places.
std::vector<ListedNumber> numbers_of_way() {
  constexpr std::size_t kMost = 4;  // then those of a dip
  std::vector<ListedNumber> out;
  for (const ResultColumn& c : passage_columns())
    if (out.size() < kMost && (c.unit == "kN" || c.unit == "MPa"))
      out.push_back({fmt::format("{} {}", c.symbol(), c.unit), c.name});
  return out;
}

}  // namespace

const std::vector<ListedNumber>& listed_numbers() {
  static const std::vector<ListedNumber> numbers{{"p_max MPa", "p_max_MPa"},
                                                 {"q_max MPa", "q_max_MPa"},
                                                 {"area mm²", "patch_area_mm2"},
                                                 {"slip %", "slip_area_fraction", 100},
                                                 {"creep 1e-3", "creepage_x", 1e3, 3}};
  return numbers;
}

std::vector<ListedNumber> telling_numbers(const std::vector<CaseRow>& rows) {
  const std::vector<ListedNumber> of_way = numbers_of_way();
  const bool on_way = std::any_of(rows.begin(), rows.end(),
                                  [&](const CaseRow& row) { return std::isfinite(row.number(of_way.front().column)); });
  const std::vector<ListedNumber>& of_contact = on_way ? of_way : listed_numbers();
  std::vector<ListedNumber> out{{"shakedown", "shakedown_wandering", 1, 3}};
  out.insert(out.end(), of_contact.begin(), of_contact.end());
  std::erase_if(out, [&](const ListedNumber& n) {
    const auto shown = [&](const CaseRow& row) {
      const double v = n.factor * row.number(n.column);
      return std::isfinite(v) ? fixed(v, n.digits) : std::string();
    };
    std::vector<std::string> done;
    for (const CaseRow& row : rows)
      if (row.done()) done.push_back(shown(row));
    const bool same =
        std::all_of(done.begin(), done.end(), [&](const std::string& text) { return text == done.front(); });
    return same && !done.empty() && (done.size() > 1 || done.front().empty());
  });
  return out;
}

void print_rows(const std::vector<CaseColumn>& head, const std::vector<ListedNumber>& numbers,
                const std::vector<CaseRow>& rows) {
  constexpr std::size_t kLeastWidth = 10;
  const auto text = [](const CaseColumn& c, const CaseRow& row) { return c.cell(row).get<std::string>(); };
  std::vector<std::size_t> width;
  for (const CaseColumn& c : head) {
    width.push_back(c.name.size());
    for (const CaseRow& row : rows) width.back() = std::max(width.back(), text(c, row).size());
    fmt::print("{:<{}}  ", c.name, width.back());
  }
  for (const ListedNumber& n : numbers) fmt::print("  {:>10}", n.heading);
  fmt::print("\n");
  for (const CaseRow& row : rows) {
    for (std::size_t k = 0; k < head.size(); ++k) fmt::print("{:<{}}  ", text(head[k], row), width[k]);
    for (const ListedNumber& n : numbers) {
      const double v = n.factor * row.number(n.column);
      fmt::print("  {:>{}}", std::isfinite(v) ? fixed(v, n.digits) : "-", std::max(kLeastWidth, n.heading.size()));
    }
    fmt::print("{}\n", row.fault.empty() ? "" : "  " + row.fault);
  }
}

}  // namespace railstrata
