#include "passes/rolled_series.hpp"

#include <map>
#include <utility>

#include "passes/pass_series.hpp"
#include "passes/rolled_pass_files.hpp"

namespace railstrata {

void add_rolled_pass(const PlasticSection& section, const PassContact& contact, RolledPass& pass,
                     RolledSeries& series) {
  std::map<std::pair<int, int>, std::vector<PassStrain>> earlier;
  for (std::size_t n = 0; n < series.section.quads.size(); ++n)
    earlier[{series.section.quads[n].block, series.section.quads[n].quad}] = series.points[n];
  series.points.clear();
  for (const PlasticSection::Quad& q : section.quads) series.points.push_back(earlier[{q.block, q.quad}]);
  series.section = section;
  ++series.passes;
  pass.row.pass = series.passes;
  add_row(rolled_columns(), {pass.row, contact}, series.table);
  series.strains.push_back(pass.row.largest);
  const PassClass whole = classify(series.strains).kind;
  for (std::size_t n = 0; n < pass.points.size(); ++n) {
    remember_pass(pass.points[n].strain, series.points[n]);
    pass.points[n].kind = class_of_point(series.points[n], whole);
  }
}

}  // namespace railstrata
