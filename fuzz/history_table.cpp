// Tables of a transient's history.
#include "tables/history_table.hpp"

#include <cmath>

#include "reader.hpp"
#include "rules/case_rules.hpp"

using namespace railstrata;
using fuzz::promise;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::accepts([&] {
    CaseSpec spec;
    read_history_table(std::string(fuzz::text_of(data, size)), "history.csv", spec);
    const std::vector<GivenColumn> columns = given_columns(spec);
    promise(!columns.empty(), "a table has columns");
    for (const GivenColumn& c : columns) {
      promise(c.values.size() == columns[0].values.size(), "columns are of one length");
      for (const double v : c.values) promise(std::isfinite(v), "values are finite");
    }
  });
  return 0;
}
