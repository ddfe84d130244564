#include "collective/collective_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "collective/collective_errors.hpp"
#include "collective/life_files.hpp"
#include "collective/wear_words.hpp"
#include "judge/judgement.hpp"
#include "many/result_columns.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/number_text.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"
#include "report/checks.hpp"
#include "report/page.hpp"
#include "report/report.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

/// In the unit of a column, or as people see it: divided, as these files have always been, to the last digit.
double in_column(const Unit& unit, double si) { return si / (1 / unit.column_factor); }
double as_shown(const Unit& unit, double si) { return si / (1 / unit.factor); }

CsvColumn column(const std::string& symbol, const Unit& unit, std::vector<double> values) {
  for (double& v : values) v = in_column(unit, v);
  return {symbol + std::string(unit.column_ending), std::move(values)};
}

template <class Damage>
std::vector<KnownWear> known_laws(const Damage& damage, const std::string& whose) {
  std::vector<KnownWear> out;
  for (const KnownWear& wear :
       {KnownWear{WearLaw::usfd, "usfd", "USFD"}, KnownWear{WearLaw::kth, "kth", "Archard, Jendel's map (KTH)"},
        KnownWear{WearLaw::archard, "archard", fmt::format("Archard, {} wear_coefficient", whose)}})
    if (const std::vector<double>& depth = damage.depth(wear.law);
        std::all_of(depth.begin(), depth.end(), [](double v) { return std::isfinite(v); }))
      out.push_back(wear);
  return out;
}

/// A wheel's totals per metre rolled.
Json wheel_json(const WheelDamage& d) {
  Json out = Json::object();
  for (const KnownWear& wear : known_wear(d)) {
    const std::vector<double>& depth = d.depth(wear.law);
    const auto at = static_cast<std::size_t>(std::max_element(depth.begin(), depth.end()) - depth.begin());
    out[wear.key + "_area_m2_per_m"] = worn_area(d, depth);
    out[wear.key + "_deepest"] = {{"depth_m_per_m", depth[at]}, {"wheel_y_m", d.y[at]}};
  }
  return out;
}

/// A cell by its value.
Json extreme(const RailDamage& d, const std::vector<double>& values, const std::string& key) {
  const auto at = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  return {{key, values[at]}, {"rail_y_m", d.y[at]}};
}

std::vector<ResultColumn> columns_for(const std::vector<CollectiveRow>& rows) {
  const bool strengths =
      std::any_of(rows.begin(), rows.end(), [](const CollectiveRow& r) { return !r.summary.shakedown.bodies.empty(); });
  std::vector<ResultColumn> out = result_columns(true);
  std::erase_if(out, [&](const ResultColumn& c) { return c.of_strength ? !strengths : c.of_stress; });
  return out;
}

/// Lateral position of the contact of a solved row, from the rail's axis, m.
double contact_y(const CollectiveRow& row) { return model_to_rail(row.track, row.patches.front().contact.point).y; }

Json row_json(const CollectiveRow& row) {
  const double factor = row.summary.shakedown.least(&ShakedownFactors::wandering);
  Json warnings = Json::array();
  for (const Warning& w : row.summary.warnings) warnings.push_back(w.name);
  return {{"name", row.name},
          {"passages", row.passages},
          {"shift_moved_m", json_number(row.moved)},
          {"shakedown_wandering", json_number(factor)},
          {"warnings", warnings},
          {"fault", row.fault.empty() ? Json(nullptr) : Json(row.fault)}};
}

/// Loads that the sums lack.
ReportCheck unsolved_check(const std::vector<CollectiveRow>& rows) {
  ReportCheck out{.name = "loads_left_out", .runs = {}};
  for (const CollectiveRow& row : rows)
    if (!row.sound()) {
      out.value += 1;
      out.note += (out.note.empty() ? "" : "; ") + row.name + ": " + row.fault;
    }
  out.ok = out.value == 0;
  return out;
}

ReportTable rows_table(const std::vector<CollectiveRow>& rows) {
  ReportTable t{.id = "loads",
                .title = "Loads",
                .note =
                    "y: contact position from the rail's axis, positive to the field side. Shakedown: load factor for "
                    "wandering traffic; above 1 there is a reserve.",
                .columns = {},
                .rows = {}};
  using C = CollectiveRow;
  const auto number = [](const char* label, const Unit& unit, auto&& si) {
    return TextColumn<C>{titled(label, unit.shown), [=](const C& row) {
                           return row.solved() ? json_number(unit.factor * si(row)) : Json(nullptr);
                         }};
  };
  const Unit mm = unit::kMillimetres;
  Unit wear = unit::kNanometres;
  wear.shown = "nm/passage";
  add_rows(t, rows,
           {{"load", [](const C& row) { return row.name; }},
            {"passages", [](const C& row) { return row.passages; }},
            number("load", unit::kKilonewtons, [](const C& row) { return row.summary.contact.F_z; }),
            {titled("contact y", mm.shown),
             [mm](const C& row) { return row.solved() ? json_number(as_shown(mm, contact_y(row))) : Json(nullptr); }},
            number("p_max", unit::kMPa, [](const C& row) { return row.summary.contact.patch.p_max; }),
            number("T-gamma", unit::kNewtons, [](const C& row) { return row.summary.damage.t_gamma; }),
            number("USFD wear", wear, [](const C& row) { return row.summary.damage.usfd_depth; }),
            number("shakedown", unit::kNone,
                   [](const C& row) { return row.summary.shakedown.least(&ShakedownFactors::wandering); }),
            {"lasts", [](const C& row) { return remarks_of(row.summary_json).lasts; }},
            {"decided by", [](const C& row) { return remarks_of(row.summary_json).decided_by; }},
            {"fault", [](const C& row) { return row.fault.empty() ? Json(nullptr) : Json(row.fault); }}});
  return t;
}

ReportTable totals_table(const std::vector<CollectiveRow>& rows, const CollectiveDamage& both) {
  const RailDamage& damage = both.rail;
  ReportTable t{
      .id = "totals",
      .title = "All passages together",
      .note = fmt::format("Wear of dry laboratory surfaces times collective.wear_factor = {:.3g}: a lubricated or wet "
                          "rail has 0.2 or less. RCF damage: Burstow's function for R260 over the width of each patch; "
                          "1 is a visible crack, below zero wear removes the cracks.",
                          rows.front().spec.collective.wear_factor),
      .columns = {"what", "unit", "total", "±", "largest", "±", "at y [mm]"},
      .rows = {}};
  const auto bar = [&](const std::string& place, double factor) {
    const Json::json_pointer at("/totals/" + place);
    return both.error.is_object() && both.error.contains(at) && both.error.at(at).is_number()
               ? Json(factor * both.error.at(at).get<double>())
               : Json(nullptr);
  };
  struct Bars {
    Json total{}, largest{};
  };
  const auto add = [&](const std::string& what, const char* units, const Json& total, const std::vector<double>& values,
                       auto&& shown, const Bars& bars = {}) {
    const auto at = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
    t.rows.push_back(
        {what, units, total, bars.total, shown(values[at]), bars.largest, as_shown(unit::kMillimetres, damage.y[at])});
  };
  const auto wear_bars = [&](const KnownWear& wear, double factor) {
    return Bars{bar(wear.key + "_area_m2", factor * unit::kSquareMillimetres.factor),
                bar(wear.key + "_deepest/depth_m", factor * unit::kMicrometres.factor)};
  };
  for (const KnownWear& wear : known_wear(damage))
    for (const std::string& words : {steel_words(rows, wear.law), map_words(rows, wear.law)})
      if (!words.empty()) t.note += fmt::format(" {}: {}.", wear.words, words);
  if (const std::string words = free_words(rows); !words.empty()) t.note += fmt::format(" {}.", words);
  const auto plain = [](double v) { return v; };
  const double passages = passages_of(rows);
  add("passages; over one place", "", passages, damage.passages, plain);
  add(
      "friction energy; over one place", "J/m; J/mm²", worn_area(damage, damage.friction_energy),
      damage.friction_energy, [](double v) { return unit::kSurfaceEnergy.factor * v; },
      Bars{bar("friction_energy_J_m", 1), nullptr});
  for (const KnownWear& wear : known_wear(damage)) {
    std::vector<double> of_thousand = smoothed_wear(damage, wear.law);
    for (double& depth : of_thousand) depth *= 1000 / passages;
    add(
        "wear of 1000 passages, " + wear.words, "mm²; µm",
        as_shown(unit::kSquareMillimetres, worn_area(damage, of_thousand)), of_thousand,
        [](double v) { return as_shown(unit::kMicrometres, v); }, wear_bars(wear, 1000 / passages));
  }
  for (const KnownWear& wear : known_wear(damage))
    add(
        "wear of all, " + wear.words, "mm²; µm",
        as_shown(unit::kSquareMillimetres, worn_area(damage, damage.depth(wear.law))), smoothed_wear(damage, wear.law),
        [](double v) { return as_shown(unit::kMicrometres, v); }, wear_bars(wear, 1));
  add("RCF damage", "", nullptr, damage.rcf_damage, plain, Bars{nullptr, bar("rcf_damage_largest/damage", 1)});
  return t;
}

ReportSeries series_over(const std::string& name, const std::vector<double>& y, const std::vector<double>& rolled,
                         const std::vector<double>& values, const Unit& shown_in) {
  constexpr std::size_t kRoom = 8;
  const auto [from, to] = cells_above(rolled, 0, kRoom);
  ReportSeries s{.name = name, .x = {}, .y = {}, .markers = false};
  for (std::size_t i = from; i < to; ++i) {
    s.x.push_back(as_shown(unit::kMillimetres, y[i]));
    s.y.push_back(as_shown(shown_in, values[i]));
  }
  return s;
}

ReportChart wheel_chart(const WheelDamage& d) {
  ReportChart out{
      "wheel-wear",
      "Wear depth over the wheel's tread",
      "For one wheel that runs all loads in proportion to their passages: depth per turn over the length of a turn.",
      "y across the wheel, from the tape circle to the field side [mm]",
      titled("wear depth", unit::kWearRate.shown),
      {}};
  for (const KnownWear& known : known_wear(d))
    out.series.push_back(series_over(known.words, d.y, d.share, d.depth(known.law), unit::kWearRate));
  return out;
}

/// Wear and fatigue on the rail's head.
ReportChart head_chart(const RailDamage& d) {
  ReportChart out{"profile",
                  "Wear and rolling contact fatigue on the rail's head",
                  "",
                  kAcross,
                  titled("z", unit::kMillimetres.shown),
                  {}};
  const std::vector<double> nothing(d.y.size(), 0);
  out.series.push_back(beside_profile("rail", d, nothing));
  const std::vector<KnownWear> known = known_wear(d);
  if (!known.empty()) {
    std::vector<double> depth = smoothed_wear(d, known.front().law);
    const double factor = magnification(depth);
    for (double& v : depth) v *= -factor;
    out.series.push_back(
        beside_profile(fmt::format("wear, {}, drawn {:.6g} times", known.front().words, factor), d, depth));
    out.note = "Inwards from the rail: wear of all passages. ";
  }
  std::vector<double> rcf;
  for (const double v : d.rcf_damage) rcf.push_back(1e-3 * std::max(v, 0.0));
  out.series.push_back(beside_profile("RCF damage, 1 mm for 1", d, rcf));
  out.note += "Outwards: RCF damage; 1 is a visible crack.";
  return out;
}

std::vector<ReportChart> charts_of(const RailDamage& d) {
  using Lines = std::vector<std::pair<std::string, std::vector<double>>>;
  const auto chart = [&](const char* id, const char* title, const char* note, const char* label, const Unit& unit,
                         const Lines& lines) {
    ReportChart out{id, title, note, kAcross, titled(label, unit.shown), {}};
    for (const auto& [name, values] : lines) out.series.push_back(series_over(name, d.y, d.passages, values, unit));
    return out;
  };
  Lines wear;
  for (const KnownWear& known : known_wear(d)) wear.emplace_back(known.words, smoothed_wear(d, known.law));
  return {head_chart(d),
          chart("wear", "Wear depth over the rail", "All passages together.", "wear depth", unit::kMicrometres, wear),
          chart("rcf", "RCF damage over the rail", "Below zero wear removes cracks.", "RCF damage", unit::kNone,
                {{"Burstow, R260", d.rcf_damage}}),
          chart("energy", "Friction energy over the rail", "", "friction energy", unit::kSurfaceEnergy,
                {{"friction energy", d.friction_energy}}),
          chart("passages", "Passages over the rail", "", "passages", unit::kNone, {{"passages", d.passages}})};
}

}  // namespace

double magnification(const std::vector<double>& values) {
  constexpr double kDrawn = 5e-3;
  const double most = *std::max_element(values.begin(), values.end());
  return most > 0 ? std::pow(10, std::floor(std::log10(kDrawn / most))) : 0;
}

ReportSeries beside_profile(const std::string& name, const RailDamage& d, const std::vector<double>& outwards) {
  ReportSeries out{.name = name, .x = {}, .y = {}, .markers = false};
  for (std::size_t i = 0; i < d.y.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, d.y.size() - 1);
    const double dy = d.y[after] - d.y[before], dz = d.z[after] - d.z[before], length = std::hypot(dy, dz);
    const double up = dy > 0 ? 1 : -1;
    out.x.push_back(as_shown(unit::kMillimetres, d.y[i] - up * outwards[i] * dz / length));
    out.y.push_back(as_shown(unit::kMillimetres, d.z[i] + up * outwards[i] * dy / length));
  }
  return out;
}

ShownCells cells_above(const std::vector<double>& values, double least, std::size_t room) {
  const auto above = [&](double v) { return v > least; };
  const auto first = std::find_if(values.begin(), values.end(), above);
  if (first == values.end()) return {0, values.size()};
  const auto from = static_cast<std::size_t>(first - values.begin()),
             to = static_cast<std::size_t>(std::find_if(values.rbegin(), values.rend(), above).base() - values.begin());
  return {from > room ? from - room : 0, std::min(values.size(), to + room)};
}

std::vector<KnownWear> known_wear(const RailDamage& damage) { return known_laws(damage, "the rail's"); }
std::vector<KnownWear> known_wear(const WheelDamage& damage) { return known_laws(damage, "the wheel's"); }

void write_wheel_damage(const std::filesystem::path& file, const std::vector<std::string>& origin,
                        const WheelDamage& d) {
  using namespace unit;
  std::vector<CsvColumn> columns{column("s", kMillimetres, d.s), column("wheel_y", kMillimetres, d.y),
                                 column("wheel_z", kMillimetres, d.z), column("share_of_distance", kNone, d.share)};
  for (const KnownWear& wear : known_wear(d))
    columns.push_back(column(wear.key + "_depth", kWearRate, d.depth(wear.law)));
  write_csv(file, origin, columns);
}

CaseTable collective_table(const std::vector<CollectiveRow>& rows) {
  using C = CollectiveRow;
  const Columns<C> own{
      {"passages", unit::kNone, &C::passages},
      {"speed", unit::kMetresPerSecond, [](const C& r) { return r.spec.drive.speed; }},
      {"lateral_shift", unit::kMillimetres, [](const C& r) { return r.spec.geometry.lateral_shift; }},
      {"friction_coefficient", unit::kNone, [](const C& r) { return r.spec.drive.friction_coefficient; }},
      {"rail_y", unit::kMillimetres, [](const C& r) { return r.solved() ? contact_y(r) : kNotApplicable; }}};
  const std::vector<ResultColumn> columns = columns_for(rows);
  CaseTable out{{{"load", [](const CaseRow& row) { return row.name; }}}, {}};
  for (const CollectiveRow& r : rows) {
    CaseRow& row = out.rows.emplace_back();
    row.name = r.name;
    row.state = r.solved() ? "done" : r.done ? "failed" : "to do";
    row.fault = r.fault;
    for (const Column<CollectiveRow>& c : own) row.numbers.emplace_back(c.column_name(), in_column(c.unit, c.value(r)));
    for (const ResultColumn& c : columns) row.numbers.emplace_back(c.name, column_value(c, r.summary_json));
    row.numbers.emplace_back("rcf_damage", r.summary.damage.rcf_damage);
    row.remarks = remarks_of(r.summary_json);
    row.values = {{"warnings", row.remarks.warnings}};
  }
  out.columns = joined(out.columns, number_columns(out.rows), answer_columns(out.rows), value_columns(out.rows));
  out.columns.push_back(remark_columns().front());
  return out;
}

void write_collective_table(const std::filesystem::path& file, const std::vector<std::string>& origin,
                            const std::vector<CollectiveRow>& rows) {
  write_cases(file, origin, collective_table(rows));
}

void write_rail_damage(const std::filesystem::path& file, const std::vector<std::string>& origin, const RailDamage& d) {
  using namespace unit;
  std::vector<CsvColumn> columns{column("s", kMillimetres, d.s),
                                 column("rail_y", kMillimetres, d.y),
                                 column("rail_z", kMillimetres, d.z),
                                 column("passages", kNone, d.passages),
                                 column("friction_energy", kSurfaceEnergy, d.friction_energy),
                                 column("rcf_damage", kNone, d.rcf_damage)};
  for (const KnownWear& wear : known_wear(d))
    columns.push_back(column(wear.key + "_depth", kMicrometres, smoothed_wear(d, wear.law)));
  write_csv(file, origin, columns);
}

Json collective_numbers(const std::vector<CollectiveRow>& rows, const CollectiveDamage& both) {
  const RailDamage& damage = both.rail;
  Json totals{{"friction_energy_J_m", worn_area(damage, damage.friction_energy)}};
  for (const KnownWear& wear : known_wear(damage)) {
    totals[wear.key + "_area_m2"] = worn_area(damage, damage.depth(wear.law));
    totals[wear.key + "_deepest"] = extreme(damage, smoothed_wear(damage, wear.law), "depth_m");
  }
  totals["rcf_damage_largest"] = extreme(damage, damage.rcf_damage, "damage");
  if (const CollectiveRow* pressed = most_pressed_row(rows))
    totals["largest_pressure"] = {{"p_max_Pa", pressed->summary.contact.patch.p_max}, {"load", pressed->name}};
  totals["wheel"] = wheel_json(both.wheel);
  const CollectiveRow* worst = worst_row(rows);
  return {{"totals", totals},
          {"worst_shakedown", worst ? Json{{"load", worst->name},
                                           {"wandering", worst->summary.shakedown.least(&ShakedownFactors::wandering)},
                                           {"where", remarks_of(worst->summary_json).decided_by}}
                                    : Json(nullptr)},
          {"lives", lives_json(both.lives)}};
}

Json collective_json(const std::string& title, const std::vector<CollectiveRow>& rows, const CollectiveDamage& both) {
  double passages = 0, left_out = 0;
  for (const CollectiveRow& row : rows) (row.sound() ? passages : left_out) += row.passages;
  const Json numbers = collective_numbers(rows, both);
  Json totals{{"passages", passages}, {"passages_left_out", left_out}};
  totals.update(numbers["totals"]);
  totals["wear_of_steels"] = wear_of_steels(rows);
  Json all = Json::array();
  for (const CollectiveRow& row : rows) all.push_back(row_json(row));
  return {{"title", title},
          {"cell_m", both.rail.cell},
          {"totals", totals},
          {"worst_shakedown", numbers["worst_shakedown"]},
          {"lives", numbers["lives"]},
          {"error", both.error},
          {"loads", all}};
}

ReportVerdict write_collective_page(const std::filesystem::path& page, const std::string& title,
                                    const std::vector<CollectiveRow>& rows, const CollectiveDamage& damage,
                                    const std::filesystem::path& looked_at, const std::string& shown,
                                    const CollectiveFront& front) {
  Report report;
  report.title = title;
  report.runs.push_back(read_report_run(looked_at));
  report.runs.back().name = shown;
  report.checks = report_checks(report.runs);
  report.checks.insert(report.checks.begin(), unsolved_check(rows));
  const bool followed = !front.answers.empty();
  report.answers = followed ? front.answers : collective_answers(rows, damage);
  if (const ReportAnswer compared = comparison_answer(rows); followed && !compared.text.empty())
    report.answers.push_back(compared);
  report.tables = front.tables;
  if (!damage.lives.rows.empty()) report.tables.push_back(lives_table(damage.lives));
  report.tables.push_back(totals_table(rows, damage));
  report.tables.push_back(rows_table(rows));
  report.charts = followed ? front.charts : charts_of(damage.rail);
  if (const std::optional<ReportChart> life = life_chart(damage.lives))
    report.charts.insert(report.charts.begin(), *life);
  report.charts.push_back(wheel_chart(damage.wheel));
  write_whole_file(page, report_page(report));
  return verdict_of(report);
}

}  // namespace railstrata
