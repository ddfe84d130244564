// Files of results: folders, tables of creep forces, pages.
#include <cmath>
#include <memory>

#include "bridge/records.hpp"
#include "io/result_folder.hpp"
#include "io/table_file.hpp"
#include "record/csv.hpp"
#include "report/passes_page.hpp"
#include "runs/write_report.hpp"

namespace railstrata::bridge {
namespace {

void read_folder(Call& call) {
  const auto found = std::make_shared<ResultFolder>(read_result_folder(call.text("folder")));
  call.answer["summary"] = Json(found->summary);
  call.answer["patches"] = Json::array({patch_of(found->field)});
  for (const ContactField& field : found->further) call.answer["patches"].push_back(patch_of(field));
  call.make(found);
}

/// The columns of a CSV file of a result folder, by name.
void read_table(Call& call) {
  const auto found = std::make_shared<CsvTable>(read_csv(call.text("file")));
  Json& columns = call.answer["columns"] = Json::object();
  for (const CsvColumn& c : found->columns) columns[c.name] = Call::view(c.values.data(), {c.values.size()});
  call.make(found);
}

std::vector<std::filesystem::path> folders_of(const Call& call) {
  const std::vector<std::string> all = call.texts("folders");
  return {all.begin(), all.end()};
}

void report_page(Call& call) {
  call.answer["notes"] = write_report(call.text("page"), folders_of(call), call.flag("reference")).notes;
}

void passes_page(Call& call) { write_passes_page(call.text("page"), folders_of(call)); }

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

Functions folder_functions() {
  return {{"read_result_folder", read_folder}, {"read_table", read_table}, {"write_report", report_page},
          {"write_passes_page", passes_page},  {"open_table", open_table}, {"look_up", look_up}};
}

}  // namespace railstrata::bridge
