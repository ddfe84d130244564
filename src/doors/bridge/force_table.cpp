// Creep-force tables.
#include <cmath>
#include <memory>

#include "bridge/functions.hpp"
#include "io/table_file.hpp"

namespace railstrata::bridge {
namespace {

/// A table and what looks things up in it.
struct OpenTable {
  explicit OpenTable(ForceTable read) : table(std::move(read)), between(table) {}
  ForceTable table;
  TableInterpolation between;
};

void open_table(Call& call) {
  const auto opened = std::make_shared<OpenTable>(read_force_table(call.text("file")));
  Json axes = Json::array(), grid = Json::array(), numbers = Json::array();
  std::vector<std::size_t> shape;
  for (const TableAxis& axis : opened->table.axes) {
    shape.push_back(axis.at.size());
    grid.push_back({axis.name, axis.unit, Call::view(axis.at.data(), {axis.at.size()})});
    const TableAxis& asked = opened->table.asked(shape.size() - 1);
    axes.push_back({asked.name, asked.unit, Call::view(asked.at.data(), {asked.at.size()})});
  }
  for (const TableNumber& n : opened->table.numbers)
    numbers.push_back({n.name, n.unit, Call::view(n.values.data(), shape)});
  call.answer = {{"axes", axes}, {"grid", grid}, {"numbers", numbers}};
  call.make(opened);
}

/// (n, numbers) at (n, axes) points, and how many of their values lie beyond an axis.
void look_up(Call& call) {
  const auto opened = call.made<OpenTable>("table");
  const Array points = call.array("points");
  const std::size_t axes = opened->table.axes.size(), numbers = opened->table.numbers.size(), n = points.size() / axes;
  std::vector<double> out(n * numbers);
  int beyond = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double* point = points.data + axes * k;
    for (std::size_t a = 0; a < axes; ++a)
      if (std::isnan(point[a])) throw std::invalid_argument(opened->table.asked(a).name + ": not a number");
    beyond += opened->between.at(point, out.data() + numbers * k);
  }
  call.answer["beyond"] = beyond;
  call.answer["found"] = call.kept(std::move(out), {n, numbers});
}

}  // namespace

Functions table_functions() { return {{"open_table", open_table}, {"look_up", look_up}}; }

}  // namespace railstrata::bridge
