#pragma once
// The numbers of a result: one row for each. The keys of summary.json, the columns of the tables of `sweep` and
// `study`, the text on the screen, the page, docs/results-reference.md and `railstrata info --schema --results` all
// come from these rows, so that a new number is a member of result/summary.hpp or result/patch.hpp with its
// computation, and one row here.
//
// The table stands in this room because it is the lowest one that knows a Summary; io, report, study and app see it.
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "record/column.hpp"
#include "record/number_text.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// Places in summary.json: of load factors, of layers and interfaces, of the life, of a passage.
inline constexpr std::string_view kShakedownGroup = "shakedown/factors", kLayersGroup = "layers", kLifeGroup = "life",
                                  kCrackGroup = "crack", kInterfaceGroup = "interface", kPassageGroup = "passage";

enum class AvailableIn { both_engines, finite_elements, half_spaces };

/// Below which size a number is what round-off and the solvers' tolerances leave, and screen and page show 0: `share`
/// times the numbers at these paths of the same result ("" none). Files keep every digit.
struct RoundOff {
  double share = 0;
  std::string_view of{}, times{};
};

struct ResultNumber : Column<Summary> {
  std::string_view group{};  ///< object of summary.json that holds it: "contact", "energy", "run"; "" for none
  std::string_view label{};  ///< short, as in the head of a table: "p_max"
  std::string_view name{};   ///< of the page and the screen
  std::string_view doc;      ///< one line of the reference page
  AvailableIn engine = AvailableIn::both_engines;
  bool column = false;      ///< stands in the tables of `sweep` and `study`
  bool shown = false;       ///< stands on the page and the screen
  bool comparable = false;  ///< a difference between two results means something: not of a small remainder, nor of
                            ///< another thing in the other engine
  int digits = 4;           ///< significant ones, where it is shown
  RoundOff round_off{};
  bool of_all_patches = false;  ///< where a wheel touches at several places; else of the one with the largest pressure

  std::string path() const;         ///< "/contact/p_max_Pa", a JSON pointer
  std::string column_name() const;  ///< "p_max_MPa"
};

/// All numbers, in the order of summary.json.
const std::vector<ResultNumber>& result_numbers();

/// The row of a number by its path; null if there is none.
const ResultNumber* find_number(std::string_view path);

/// The row of a number's error bar, whose symbol ends with "_error"; null if it has none.
const ResultNumber* find_error_bar(const ResultNumber& number);

/// Below which size a number is round-off; `number` gives others of the same result by path, NaN where there is none.
double round_off_size(const RoundOff& row, const std::function<double(std::string_view)>& number);

/// The value of a number, of a count too, for people: 0 where it is round-off.
double shown_value(const ResultNumber& row, const Summary& summary);

/// The value of a check for people: 0 where it is below a millionth of its limit.
double shown_beside_limit(double value, double limit);

/// The largest stresses: for every body, zone and measure a value and its place, null where the zone does not exist.
/// They stand in summary.json as /stress/<body>/<zone>/<measure>/<number>.
struct StressBody {
  std::string_view key;
  StressSummary Summary::*member;
};
struct StressZone {
  std::string_view key;
  std::optional<StressPair> StressSummary::*member;
  std::string_view name, doc;
};
struct StressMeasure {
  std::string_view key, symbol;  ///< of summary.json; of a column
  StressMaximum StressPair::*member;
  std::string_view name;
};
struct StressNumber {
  std::string_view key;
  Unit unit;
  double StressMaximum::*member;
  std::string_view doc;
};
const std::vector<StressBody>& stress_bodies();
const std::vector<StressZone>& stress_zones();
const std::vector<StressMeasure>& stress_measures();
const std::vector<StressNumber>& stress_numbers();

/// A number of a table, where it stands in summary.json and by what it is multiplied.
struct ResultColumn {
  std::string name, path{};
  double factor = 1;
  std::string title{};       ///< what an axis or the head of a column calls it: "p_max"
  std::string_view unit{};   ///< in the column, for people: "MPa"
  Unit shown_unit{};         ///< for people, where it is not the column's own: a share as per cent
  std::string_view doc{};    ///< one line
  bool of_stress = false;    ///< costs more than the contact
  bool of_strength = false;  ///< empty where no case gives a strength
  bool of_all_patches = false;
  bool of_passage = false;  ///< empty where nothing changes along the rail
  bool comparable = true;
  int digits = 4;

  std::string symbol() const;  ///< "p_max"
  bool is_error_bar() const;
  std::string key() const;  ///< "p_max_Pa", of numbers in SI
};

/// Every column of the tables in their order: contact, stresses of the rail, then the wall time.
std::vector<ResultColumn> table_columns();

}  // namespace railstrata
