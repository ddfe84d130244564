#include "rules/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "options/option_table.hpp"
#include "tables/history_table.hpp"

namespace railstrata {
namespace {

class TransientRules {
 public:
  TransientRules(const CaseSpec& spec, CaseSource& source)
      : spec_(spec), t_(spec.transient), source_(source), columns_(given_columns(spec)) {}

  void check() {
    if (!source_.sound({kHistoryFile})) return;  // rows that end at a fault would be blamed for it
    if (!rolls()) check_shift();
    check_rows();
    if (source_.sound({"transient"})) check_friction();
  }

 private:
  bool rolls() const { return t_.kind == TransientKind::rolling; }
  void refuse(const std::string& key, const std::string& what, const std::string& remedy) {
    source_.complain(key, fmt::format("{}: {}", key, what), remedy);
  }

  /// Refuses a row, counted from 1, which in a history file has a line.
  void refuse_row(const std::string& key, std::size_t row, const std::string& what, const std::string& remedy) {
    source_.complain(fmt::format("{}.{}", key, row), fmt::format("{}: {}", key, what), remedy);
  }

  void check_shift() {
    const auto moves = [](const GivenColumn& c) {
      return c.key != "at_time" && c.key != "wheel_load" && c.key != "load_factor";
    };
    if (source_.sound({"transient"}) && std::none_of(columns_.begin(), columns_.end(), moves))
      refuse("transient.kind", "a shift needs something that shifts",
             "give transient.tractive_force, displacement, lateral_force or lateral_displacement, e.g. displacement = "
             "[\"2 um\", \"-2 um\", \"2 um\"]");
  }

  /// As many values in every column; rolling: where the rows are, from the start on.
  void check_rows() {
    for (std::size_t k = 1; k < columns_.size(); ++k)
      if (columns_[k].values.size() != columns_[0].values.size())
        refuse("transient." + columns_[k].key,
               fmt::format("{} values, transient.{} has {}", columns_[k].values.size(), columns_[0].key,
                           columns_[0].values.size()),
               "give every column one value a row");
    const std::vector<double>& at = t_.at_time.empty() ? t_.at_distance : t_.at_time;
    const std::string key = t_.at_time.empty() ? "transient.at_distance" : "transient.at_time";
    if (const auto back = std::is_sorted_until(at.begin(), at.end()); back != at.end())
      refuse_row(key, static_cast<std::size_t>(back - at.begin()) + 1, "must not decrease from row to row",
                 "sort the rows; two rows at one place are a jump");
    if (!rolls() || !source_.sound({"transient"})) return;
    if (at.empty() && !columns_.empty())
      refuse("transient." + columns_[0].key, "where are these rows? There is neither at_distance nor at_time",
             "add at_distance = [\"0 mm\", …] or at_time with a value for each row");
    if (at.empty() && !t_.distance)
      refuse("transient.kind", "how far does it roll?", "add distance = \"25 mm\", or rows with at_distance");
    if (!at.empty() && at.front() != 0)
      refuse_row(key, 1, "the first row must be the start, 0", "begin with the values at the start");
    constexpr double kLongest = 20;  // m, as of distance and at_distance
    if (!t_.at_time.empty() && t_.at_time.back() * spec_.drive.speed > kLongest)
      refuse_row(key, at.size(),
                 fmt::format("the last row is {:.4g} m from the start at drive.speed; a transient rolls {:g} m at most",
                             t_.at_time.back() * spec_.drive.speed, kLongest),
                 "give earlier times or a lower speed; a longer way has the steady answer");
    if (!at.empty() && !t_.distance && !(at.back() > 0))
      refuse_row(key, at.size(), "the last row is at the start", "add a later row, or transient.distance");
  }

  double row_of(const std::vector<double>& column, std::size_t row, double otherwise) const {
    return column.empty() ? otherwise : column[row];
  }

  /// Linear between the rows: what holds in two rows holds between them.
  void check_friction() {
    const DriveSpec& d = spec_.drive;
    const double g = spec_.vehicle.load();
    const std::size_t rows = columns_.empty() ? 1 : columns_[0].values.size();
    const bool drives_x = rolls() && t_.creepage.empty(), drives_y = rolls() && t_.lateral_creepage.empty();
    for (std::size_t i = 0; i < rows; ++i) {
      const double load = row_of(t_.wheel_load, i, g * row_of(t_.load_factor, i, 1)),
                   along = row_of(t_.tractive_force, i,
                                  g * row_of(t_.traction_coefficient, i, drives_x ? d.traction().value_or(0) : 0)),
                   across = row_of(t_.lateral_force, i,
                                   g * row_of(t_.lateral_traction_coefficient, i,
                                              drives_y ? d.lateral_traction_coefficient.value_or(0) : 0)),
                   wanted = std::hypot(along, across), available = d.friction_coefficient * load;
      if (wanted == 0 || wanted < available) continue;
      const bool listed = !t_.tractive_force.empty() || !t_.traction_coefficient.empty();
      return refuse_row(
          listed ? (t_.tractive_force.empty() ? "transient.traction_coefficient" : "transient.tractive_force")
                 : "transient.kind",
          i + 1,
          fmt::format("row {} wants {:.4g} kN of friction, a friction coefficient of {:g} gives at most {:.4g} kN "
                      "under its load",
                      i + 1, 1e-3 * wanted, d.friction_coefficient, 1e-3 * available),
          "the wheel would slide: lower the force, or raise the friction or the load; full sliding is a "
          "creepage or a displacement");
    }
  }

  const CaseSpec& spec_;
  const TransientSpec& t_;
  CaseSource& source_;
  std::vector<GivenColumn> columns_;
};

}  // namespace

std::vector<GivenColumn> given_columns(CaseSpec spec) {
  std::vector<GivenColumn> out;
  for (const OptionTable& table : case_tables()) {
    if (table.name != "transient") continue;
    for (const Option& option : table.options) {
      const Slot slot = option.slot(spec, 0);
      auto* const* values = std::get_if<std::vector<double>*>(&slot);
      if (values && !(*values)->empty()) out.push_back({std::string(option.key), std::move(**values)});
    }
  }
  return out;
}

void check_transient(const CaseSpec& spec, CaseSource& source) {
  if (spec.transient.kind == TransientKind::none) return;
  TransientRules(spec, source).check();
}

}  // namespace railstrata
