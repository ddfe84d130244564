#include "creep/creep_table_job.hpp"

#include <fmt/format.h>

#include <utility>

#include <nlohmann/json.hpp>

#include "io/table_file.hpp"
#include "record/csv.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr JobKind kCreepTable{"creep table", "creep_table.identity",
                              "the case, the --set and the --cell of its beginning"};
constexpr const char *kForceTable = "creep_table.h5", *kBegunTable = "creep_table.begun.h5";

JobOrder order_in(JobOrder order) {
  order.force = order.force || order.resume;
  order.resume = order.resume && fs::exists(order.folder / kBegunTable);
  return order;
}

std::string with_unit(const std::string& name, std::string unit) {
  for (char& c : unit)
    if (c == ' ' || c == '/') c = '_';
  return unit.empty() ? name : name + "_" + unit;
}

/// Axes and places as whoever asks gives them.
std::vector<CsvColumn> columns_of(const ForceTable& table) {
  std::vector<CsvColumn> out;
  for (std::size_t k = 0; k < table.axes.size(); ++k)
    out.push_back({with_unit(table.asked(k).name, table.asked(k).unit), {}});
  for (std::size_t point = 0; point < table.points(); ++point) {
    const std::vector<double> place = asked_place(table, point);
    for (std::size_t k = 0; k < place.size(); ++k) out[k].values.push_back(place[k]);
  }
  for (const TableNumber& number : table.numbers) out.push_back({with_unit(number.name, number.unit), number.values});
  return out;
}

TableRemarks remarks_of(const std::vector<std::string>& lines, const TableError& error) {
  std::string origin, accuracy;
  for (const std::string& line : lines) origin += (origin.empty() ? "" : "; ") + line;
  for (const TableError::Number& n : error.numbers)
    accuracy += fmt::format("{}{} {:.3g} {}", accuracy.empty() ? "" : ", ", n.name, n.largest, n.unit);
  TableRemarks out{{"origin", origin}};
  if (error.places > 0)
    accuracy += fmt::format("; creep force by {:.3g} of friction times normal force, 95 % of the places by {:.3g}",
                            error.creep_force.largest, error.creep_force.most);
  if (error.places > 0)
    out.emplace_back("interpolation_error",
                     fmt::format("largest differences at {} places: {}", error.places, accuracy));
  return out;
}

class CreepTableJob : public CaseJob {
 public:
  CreepTableJob(LoadedCase base, CreepTableOrder order, Control& control)
      : CaseJob(kCreepTable, std::move(base), order_in(order), control),
        table_(loaded_, std::move(order.axes), order.scaled),
        places_(order.places) {
    require_table_files();
    options_.bem.cell = order.cell;
    options_.control = &control;
    options_.solved = [this](std::size_t done) {
      control_.progress("creep table", static_cast<double>(done) / static_cast<double>(table_.points()));
      save_when_due();
    };
  }
  nlohmann::ordered_json json() const {
    nlohmann::ordered_json out;
    for (const TableAxis& axis : table_.table().axes)
      out["axes"].push_back({{"name", axis.name}, {"unit", axis.unit}, {"values", axis.at}});
    if (const std::optional<TableScaling>& scaling = table_.table().scaling)
      for (const TableAxis& axis : scaling->asked)
        out["asked"].push_back({{"name", axis.name}, {"unit", axis.unit}, {"ends", axis.at}});
    out["points"] = table_.points();
    out["missing"] = table_.missing();
    out["faults"] = table_.faults();
    out["interpolation"]["places"] = error_.places;
    if (error_.places > 0) {
      const TableError::CreepForce& force = error_.creep_force;
      out["interpolation"]["creep_force"] = {
          {"half_below", force.half}, {"most_below", force.most}, {"largest", force.largest}, {"where", force.where}};
    }
    for (const TableError::Number& n : error_.numbers)
      out["interpolation"]["numbers"].push_back({{"name", n.name},
                                                 {"unit", n.unit},
                                                 {"largest", n.largest},
                                                 {"mean", n.mean},
                                                 {"of_largest_value", n.scale > 0 ? n.largest / n.scale : 0.0}});
    return out;
  }
  const CreepTable& table() const { return table_; }
  const TableError& error() const { return error_; }

 private:
  std::string identity() const override { return fmt::format("{} {:.17g}", CaseJob::identity(), options_.bem.cell); }

  void begin() override {
    CaseJob::begin();
    control_.info("{} points", table_.points());
  }

  void resume() override {
    table_.take(read_force_table(folder() / kBegunTable));
    control_.info("{} points", table_.points());
  }

  bool step() override {
    table_.solve(options_);
    control_.progress("");
    if (!control_.stop) error_ = interpolation_error(table_, places_, options_);
    solved_ = !control_.stop;
    return solved_;
  }

  void save() override { write_force_table(folder() / kBegunTable, table_.table(), {}); }

  void finish() override {
    for (const std::string& axis : table_.idle_axes())
      control_.warn("--axis {}: no number of the table changes with it", axis);
    write_force_table(folder() / kForceTable, table_.table(), remarks_of(origin(), error_));
    std::vector<std::string> remarks = origin();
    remarks.emplace_back(
        "forces on the wheel: along x, lateral in the contact plane, along its normal; moment about it");
    write_csv(folder() / "creep_table.csv", remarks, columns_of(table_.table()));
    write_whole_file(folder() / "creep_table.json", json().dump(2) + "\n");
    fs::remove(folder() / kBegunTable);
    fs::remove(folder() / kCreepTable.identity);
    sound_ = table_.missing() == 0;
  }

  bool finished() const override { return solved_; }

  CreepTable table_;
  CreepTableOptions options_;
  int places_;
  TableError error_;
  bool solved_ = false;
};

}  // namespace

JobEnd carry_out_creep_table(LoadedCase base, CreepTableOrder order, Control& control, const CreepTableShown& at_end) {
  CreepTableJob job(std::move(base), std::move(order), control);
  return job.carry_out([&] {
    if (at_end) at_end(job.table(), job.error(), job.json());
  });
}

}  // namespace railstrata
