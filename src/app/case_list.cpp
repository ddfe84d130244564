#include "app/case_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "result/result_table.hpp"

namespace railstrata {
const std::vector<ListedNumber>& listed_numbers() {
  static const std::vector<ListedNumber> numbers{{"p_max MPa", "p_max_MPa"},
                                                 {"q_max MPa", "q_max_MPa"},
                                                 {"area mm²", "patch_area_mm2"},
                                                 {"slip %", "slip_area_fraction", 100},
                                                 {"creep 1e-3", "creepage_x", 1e3, 3}};
  return numbers;
}

std::vector<ListedNumber> telling_numbers(const std::vector<CaseRow>& rows) {
  std::vector<ListedNumber> out{{"shakedown", "shakedown_wandering", 1, 3}};
  out.insert(out.end(), listed_numbers().begin(), listed_numbers().end());
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
      fmt::print("  {:>10}", std::isfinite(v) ? fixed(v, n.digits) : "-");
    }
    fmt::print("{}\n", row.fault.empty() ? "" : "  " + row.fault);
  }
}

}  // namespace railstrata
