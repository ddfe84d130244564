#include "report/payload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <tuple>

#include "core/engine.hpp"
#include "core/faults.hpp"
#include "io/provenance.hpp"
#include "io/result_files.hpp"
#include "material/elastic.hpp"
#include "record/json.hpp"
#include "record/unit.hpp"
#include "report/page.hpp"
#include "report/result_reference.hpp"
#include "result/patch.hpp"
#include "result/stress_sections.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMostPoints = 300, kMostRows = 1500, kMostWatchedRows = 6000;

/// Six digits of a number; null for what is not finite.
Json short_number(double v) {
  return std::isfinite(v) ? json_number(std::stod(fmt::format("{:.6g}", v))) : json_number(v);
}

Json numbers(const std::vector<double>& values, double factor = 1) {
  Json out = Json::array();
  for (double v : values) out.push_back(short_number(factor * v));
  return out;
}

/// 16 bits a number, low byte first: low + (high - low) k / 65534; 65535 stands for no number.
Json packed(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (double v : values)
    if (std::isfinite(v)) {
      low = std::min(low, v);
      high = std::max(high, v);
    }
  if (low > high) low = high = 0;
  std::string bytes;
  for (double v : values) {
    const auto k = std::isfinite(v)
                       ? static_cast<std::uint16_t>(high > low ? std::lround((v - low) / (high - low) * 65534) : 0)
                       : std::uint16_t{65535};
    bytes += static_cast<char>(k & 0xFF);
    bytes += static_cast<char>(k >> 8);
  }
  return {{"low", low}, {"high", high}, {"u16", base64_of(bytes)}};
}

/// Every n-th index from first to last, at most kMostPoints of them.
std::vector<int> thinned(int first, int last) {
  const int step = 1 + (last - first) / kMostPoints;
  std::vector<int> out;
  for (int i = first; i <= last; i += step) out.push_back(i);
  return out;
}

struct Range {
  int first, last;
};

/// The stations (or columns) that touch, and so many beside them that 2 mm are clear on either side.
template <class Coordinate, class Touches>
Range touching(int n, Coordinate&& at, Touches&& touches) {
  constexpr double kMargin = 2e-3;
  int first = 0, last = n - 1;
  while (first < n && !touches(first)) ++first;
  if (first == n) return {0, n - 1};
  while (!touches(last)) --last;
  const double low = at(first) - kMargin, high = at(last) + kMargin;
  while (first > 0 && at(first) > low) --first;
  while (last + 1 < n && at(last) < high) ++last;
  return {first, last};
}

Json patch(const ContactField& f) {
  const auto at = [&](int s, int c) { return static_cast<std::size_t>(s) * f.columns + c; };
  const auto station_touches = [&](int s) {
    return std::any_of(f.p.begin() + at(s, 0), f.p.begin() + at(s, 0) + f.columns, [](double p) { return p > 0; });
  };
  const auto column_touches = [&](int c) {
    for (int s = 0; s < f.stations; ++s)
      if (f.p[at(s, c)] > 0) return true;
    return false;
  };
  const Range sr = touching(
                  f.stations, [&](int s) { return f.x[at(s, 0)]; }, station_touches),
              cr = touching(
                  f.columns, [&](int c) { return f.y[c]; }, column_touches);
  const std::vector<int> stations = thinned(sr.first, sr.last), columns = thinned(cr.first, cr.last);
  Json out;
  out["x"] = Json::array();
  out["y"] = Json::array();
  for (int s : stations) out["x"].push_back(short_number(kToMilli * f.x[at(s, 0)]));
  for (int c : columns) out["y"].push_back(short_number(kToMilli * f.y[c]));
  const auto values = [&](const std::vector<double>& all, const Unit& unit) {
    std::vector<double> v;
    for (int s : stations)
      for (int c : columns) v.push_back(unit.factor * all[at(s, c)]);
    return packed(v);
  };
  out["p"] = values(f.p, unit::kMPa);
  out["q_x"] = values(f.q_x, unit::kMPa);
  out["q_y"] = values(f.q_y, unit::kMPa);
  const Unit slip = f.slip_is_distance ? unit::kMicrometres : unit::kMillimetresPerSecond;
  out["slip_x"] = values(f.slip_x, slip);
  out["slip_y"] = values(f.slip_y, slip);
  out["slip_unit"] = std::string(slip.shown);
  std::string state;
  for (int s : stations)
    for (int c : columns) state += static_cast<char>('0' + static_cast<int>(f.state[at(s, c)]));
  out["state"] = state;
  return out;
}

Json centre(const ContactField& field) {
  const CentreLine line = centre_line(field);
  Json out;
  for (const auto& [symbol, unit, values] : {std::tuple{"x", unit::kMillimetres, &line.x},
                                             {"p", unit::kMPa, &line.p},
                                             {"q_x", unit::kMPa, &line.q_x},
                                             {"q_y", unit::kMPa, &line.q_y}})
    out[fmt::format("{}{}", symbol, unit.column_ending)] = numbers(*values, unit.column_factor);
  out["y"] = Json::array({short_number(kToMilli * line.y)});
  return out;
}

template <class Item, class Part>
Json of_each(const std::vector<Item>& items, Part&& part) {
  Json out = Json::array();
  for (const Item& item : items) out.push_back(part(item));
  return out;
}

Json columns(const CsvTable* table) {
  return table ? table_json(*table, 1 + (table->rows() - 1) / kMostRows) : Json(nullptr);
}

/// Where the rail changes: a point's place, then its stress against the wheel's position.
Json watched_points(const CsvTable* table) {
  if (!table) return nullptr;
  const std::vector<double>&number = table->column("point"), &position = table->column("position_mm"),
        &von_mises = table->column("von_mises_MPa");
  const double points = *std::max_element(number.begin(), number.end());
  const auto rows_of_point = static_cast<std::size_t>(static_cast<double>(number.size()) / points);
  const std::size_t step = 1 + static_cast<std::size_t>(points) * rows_of_point / kMostWatchedRows;
  std::vector<std::size_t> seen(static_cast<std::size_t>(points), 0);
  std::vector<std::array<std::vector<double>, 2>> curves(seen.size());
  Json out = Json::array();
  for (std::size_t i = 0; i < number.size(); ++i) {
    const auto k = static_cast<std::size_t>(number[i]) - 1;
    if (seen[k]++ == 0) out.push_back({{"x_mm", table->column("x_mm")[i]}, {"depth_mm", table->column("depth_mm")[i]}});
    if ((seen[k] - 1) % step != 0) continue;
    curves[k][0].push_back(position[i]);
    curves[k][1].push_back(von_mises[i]);
  }
  for (std::size_t k = 0; k < curves.size(); ++k) {
    out[k]["position_mm"] = numbers(curves[k][0]);
    out[k]["von_mises_MPa"] = numbers(curves[k][1]);
  }
  return out;
}

std::vector<double> unique(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// A part of a film's rows on the grid of its own cells, index as in `patch`.
struct FilmRows {
  const std::vector<double>&x, &y, &q_x, &q_y, &state;
  Json on_grid(std::size_t first, std::size_t last, const std::vector<double>& all_x,
               const std::vector<double>& all_y) const {
    const auto at = [](const std::vector<double>& all, double v) {
      return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), v) - all.begin());
    };
    std::vector<double> q(all_x.size() * all_y.size(), std::numeric_limits<double>::quiet_NaN());
    std::string states(q.size(), '0');
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t k = at(all_x, x[i]) * all_y.size() + at(all_y, y[i]);
      q[k] = std::hypot(q_x[i], q_y[i]);
      states[k] = static_cast<char>('0' + static_cast<int>(std::clamp(state[i], 0.0, 2.0)));
    }
    return {{"q", packed(q)}, {"state", states}};
  }
};

/// The states of patch_film.csv: those of half-spaces on the grid of all their cells; those of finite elements, whose
/// nodes come and go as the wheel passes, each on its own.
Json film(const CsvTable* table, bool own_grids) {
  if (!table) return nullptr;
  const std::vector<double> step = table->column("step"), distance = table->column("distance_mm"),
                            x = table->column("x_mm"), y = table->column("y_mm");
  const std::vector<double> q_x = table->column("q_x_MPa"), q_y = table->column("q_y_MPa"),
                            state = table->column(kPatchState);
  const FilmRows rows{x, y, q_x, q_y, state};
  const std::vector<double> all_x = unique(x), all_y = unique(y);
  Json out{{"x", own_grids ? Json::array({short_number(all_x.front()), short_number(all_x.back())}) : numbers(all_x)},
           {"y", numbers(all_y)},
           {"frames", Json::array()}};
  for (std::size_t i = 0; i < step.size();) {
    const std::size_t first = i;
    while (i < step.size() && step[i] == step[first]) ++i;
    const auto from = x.begin() + static_cast<std::ptrdiff_t>(first), to = x.begin() + static_cast<std::ptrdiff_t>(i);
    const std::vector<double> own = unique({from, to});
    Json frame = rows.on_grid(first, i, own_grids ? own : all_x, all_y);
    frame["step"] = step[first];
    frame["distance_mm"] = short_number(distance[first]);
    if (own_grids) frame["x"] = numbers(own);
    out["frames"].push_back(std::move(frame));
  }
  return out;
}

/// How many rows of a table of a section have its first depth; throws CaseError where they make no grid.
std::size_t width_of(const CsvTable& table, const std::vector<double>& depth, std::size_t least) {
  std::size_t width = 0;
  while (width < depth.size() && depth[width] == depth[0]) ++width;
  if (width < least || depth.size() % width != 0 || depth.size() < 2 * width)
    throw CaseError(fmt::format("this section cannot be drawn: {} rows do not make a grid with one depth per row (the "
                                "first depth has {} points)",
                                depth.size(), width),
                    "lines were removed or sorted; restore the file, or write the results again with `railstrata run` "
                    "or `railstrata bem`",
                    table.file.string());
  return width;
}

std::string material_digits(const std::vector<double>& material) {
  std::string digits;
  for (double m : material) digits += "0123456789abcdefghijklmnopqrstuvwxyz"[std::clamp(static_cast<int>(m), 0, 35)];
  return digits;
}

/// MPa, of every row of a table of stresses.
std::vector<double> largest_shears(const CsvTable& table) {
  std::vector<std::vector<double>> s;
  for (const char* name : kTensorComponents) s.push_back(table.column(fmt::format("sigma_{}_MPa", name)));
  std::vector<double> out;
  for (std::size_t i = 0; i < s[0].size(); ++i)
    out.push_back(largest_shear(principal_stresses({s[0][i], s[1][i], s[2][i], s[3][i], s[4][i], s[5][i]})));
  return out;
}

/// What sections and slices have alike: values index along + along.size() * row.
Json maps_of(const CsvTable& table, const std::vector<double>& along, std::size_t width,
             const std::vector<double>& rows, const std::vector<double>& tau_max) {
  return {{"along", numbers({along.begin(), along.begin() + static_cast<std::ptrdiff_t>(width)})},
          {"depth", numbers(rows)},
          {"von_mises", packed(table.column("von_mises_MPa"))},
          {"sigma_1", packed(table.column("sigma_1_MPa"))},
          {"sigma_xz", packed(table.column("sigma_xz_MPa"))},
          {"tau_max", packed(tau_max)}};
}

Json section(const CsvTable& table, bool longitudinal) {
  const std::vector<double> x = table.column("x_mm"), y = table.column("y_mm"), depth = table.column("depth_mm");
  const std::size_t width = width_of(table, depth, 2);
  const std::vector<double>& along = longitudinal ? x : y;
  std::vector<double> rows;
  for (std::size_t i = 0; i < depth.size(); i += width) rows.push_back(depth[i]);
  Json out{{"at", short_number(longitudinal ? y[0] : x[0])}};
  out.update(maps_of(table, along, width, rows, largest_shears(table)));
  out["material"] = material_digits(table.column("material"));
  for (const CsvColumn& c : table.columns)
    if (c.name == "plastic_strain_accumulated") out["plastic_strain_accumulated"] = packed(c.values);
  return out;
}

/// Cross sections one behind the other: values index along + along.size() * (row + rows * slice).
Json slices_of(const CsvTable& table) {
  const std::vector<double> x = table.column("x_mm"), y = table.column("y_mm"), depth = table.column("depth_mm");
  const std::size_t width = width_of(table, depth, 1),
                    size = static_cast<std::size_t>(std::count(x.begin(), x.end(), x[0]));
  if (size % width != 0 || x.size() % size != 0) return nullptr;
  std::vector<double> at, rows;
  for (std::size_t i = 0; i < x.size(); i += size) at.push_back(x[i]);
  for (std::size_t i = 0; i < size; i += width) rows.push_back(depth[i]);
  Json out{{"at", numbers(at)}};
  out.update(maps_of(table, y, width, rows, table.column("tau_max_MPa")));
  return out;
}

Json slices(const ReportRun& run) {
  Json out = Json::object();
  for (const std::string body : {"rail", "wheel"})
    if (const CsvTable* table = run.table(body + "_slices")) out[body] = slices_of(*table);
  return out;
}

/// Where the wheel's two sections cross: the stresses against depth there.
Json wheel_depth_line(const ReportRun& run) {
  const CsvTable *along = run.table("wheel_longitudinal_section"), *across = run.table("wheel_cross_section");
  if (!along || !across) return nullptr;
  const double x = across->column("x_mm")[0];
  const std::vector<double> all = along->column("x_mm");
  Json out = Json::object();
  for (const CsvColumn& c : along->columns) {
    std::vector<double> v;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (std::abs(all[i] - x) < 1e-6) v.push_back(c.values[i]);
    out[c.name] = numbers(v);
  }
  return out;
}

Json sections(const ReportRun& run) {
  Json out = Json::object();
  for (const std::string body : {"rail", "wheel"}) {
    const CsvTable *along = run.table(body + "_longitudinal_section"), *across = run.table(body + "_cross_section");
    if (along && across) out[body] = {{"longitudinal", section(*along, true)}, {"cross", section(*across, false)}};
  }
  return out;
}

/// Residual state of the rail's section, after the wheel: every row, kMostRows is for histories.
Json residual(const ReportRun& run) {
  const CsvTable* table = run.table("residual");
  return table ? table_json(*table) : Json(nullptr);
}

Json shakedown(const ReportRun& run) {
  Json out = Json::object();
  for (const std::string body : {"rail", "wheel"}) {
    const std::string name = "shakedown_" + body;
    const CsvTable *profile = run.table(name), *map = run.table(name + "_map"), *sliding = run.table(name + "_sliding");
    if (profile && map) out[body] = {{"profile", table_json(*profile)}, {"map", table_json(*map)}};
    if (sliding) out[body]["sliding"] = table_json(*sliding);
  }
  return out;
}

/// Of a case with a crack: its passage, and the depths that it might have.
Json crack(const ReportRun& run) {
  const CsvTable *passage = run.table("crack"), *depths = run.table("crack_depths");
  if (!passage) return nullptr;
  return {{"passage", table_json(*passage)}, {"depths", depths ? table_json(*depths) : Json(nullptr)}};
}

/// The name alone of what is an absolute path: a page is sent to others, where the folders of one's machine lie is not.
std::string without_folders(const std::string& word) {
  const std::filesystem::path path = word;
  return path.is_absolute() ? path.lexically_normal().filename().string() : word;
}

/// The origin of a run as a page gives it. The processor, the machine's name and absolute paths stay in
/// provenance.json.
Json origin(const ReportRun& run) {
  if (!run.provenance.is_object()) return Json::object();
  Json out = run.provenance;
  for (const char* key : {"cpu", "host"}) out.erase(key);
  for (const char* key : {"command_line", "overrides"})
    if (out.contains(key) && out[key].is_array())
      for (Json& word : out[key])
        if (word.is_string()) word = without_folders(word.get<std::string>());
  if (out.contains("inputs") && out["inputs"].is_array())
    for (Json& input : out["inputs"])
      if (input.is_object() && input.contains("file") && input["file"].is_string())
        input["file"] = without_folders(input["file"].get<std::string>());
  return out;
}

/// geometry.json with the names of profile files instead of their paths.
Json geometry(const ReportRun& run) {
  Json out = run.geometry;
  for (const char* key : {"rail_profile", "wheel_profile"})
    if (out.is_object() && out.contains(key) && out[key].is_string())
      out[key] = without_folders(out[key].get<std::string>());
  return out;
}

Json option_json(const CaseOption& o) { return {o.table, o.key, without_folders(o.value)}; }

/// One run. A page of many runs has no slices, which would take megabytes.
Json run_json(const ReportRun& run, bool with_slices) {
  return {{"name", run.name},
          {"folder", without_folders(run.result.folder.string())},
          {"engine", run.result.engine},
          {"title", run.result.title},
          {"summary", run.result.summary},
          {"case", of_each(run.options, option_json)},
          {"provenance", origin(run)},
          {"geometry", geometry(run)},
          {"patch", patch(run.result.field)},
          {"further_patches", of_each(run.result.further, patch)},
          {"centre_line", centre(run.result.field)},
          {"further_centre_lines", of_each(run.result.further, centre)},
          {"depth_line", columns(run.table("depth_line"))},
          {"wheel_depth_line", wheel_depth_line(run)},
          {"history", columns(run.table("history"))},
          {"points", watched_points(run.table("points_history"))},
          {"spectrum", columns(run.table("force_spectrum"))},
          {"film", film(run.table("patch_film"), is_engine(run.result.engine, Engine::fem))},
          {"sections", sections(run)},
          {"residual", residual(run)},
          {"slices", with_slices ? slices(run) : Json::object()},
          {"shakedown", shakedown(run)},
          {"crack", crack(run)},
          {"interface", columns(run.table("interface_slip"))}};
}

Json answer_json(const ReportAnswer& a) { return {{"tone", a.tone}, {"title", a.title}, {"text", a.text}}; }

Json checked_json(const ReportCheck& c) {
  return {{"name", c.name},
          {"runs", c.runs},
          {"judged", c.judged},
          {"ok", c.ok},
          {"value", json_number(c.value)},
          {"limit", json_number(c.limit)},
          {"note", c.note}};
}

Json table_of_texts(const ReportTable& t) {
  return {{"id", t.id}, {"title", t.title}, {"note", t.note}, {"columns", t.columns}, {"rows", t.rows}};
}

Json series_json(const ReportSeries& s) {
  return {{"name", s.name},       {"x", numbers(s.x)},  {"y", numbers(s.y)},
          {"markers", s.markers}, {"colour", s.colour}, {"dash", s.dash}};
}

Json chart_json(const ReportChart& c) {
  return {{"id", c.id},     {"title", c.title}, {"note", c.note},
          {"x", c.x},       {"y", c.y},         {"series", of_each(c.series, series_json)},
          {"bars", c.bars}, {"wide", c.wide},   {"log", c.log}};
}

Json maps_json(const ReportMaps& m) {
  return {{"id", m.id}, {"title", m.title}, {"note", m.note}, {"kind", m.kind}, {"runs", m.runs}, {"names", m.names}};
}

Json cell_json(const ReportGridCell& c) {
  if (c.verdict.empty() && !std::isfinite(c.factor)) return nullptr;
  return {{"verdict", c.verdict}, {"factor", json_number(c.factor)}, {"fails_by", c.fails_by}};
}

Json grid_json(const ReportGrid& g) {
  return {{"name", g.name}, {"x", g.x}, {"y", g.y}, {"cells", of_each(g.cells, cell_json)}};
}

Json grids_json(const ReportGrids& row) {
  return {{"id", row.id},
          {"title", row.title},
          {"note", row.note},
          {"x", row.x},
          {"y", row.y},
          {"value", row.value},
          {"grids", of_each(row.grids, grid_json)}};
}

}  // namespace

Json table_json(const CsvTable& table, std::size_t step) {
  Json out = Json::object();
  for (const CsvColumn& c : table.columns) {
    Json& values = out[c.name] = Json::array();
    for (std::size_t i = 0; i < c.values.size(); i += step) values.push_back(short_number(c.values[i]));
  }
  return out;
}

Json report_payload(const Report& report) {
  Json out;
  out["title"] = report.title;
  out["program"] = version_text();
  out["words"] = results_reference_json();
  out["answers"] = of_each(report.answers, answer_json);
  out["checks"] = of_each(report.checks, checked_json);
  const bool one_result = std::all_of(report.runs.begin(), report.runs.end(),
                                      [&](const ReportRun& run) { return run.name == report.runs.front().name; });
  out["runs"] =
      of_each(report.runs, [&](const ReportRun& run) { return run_json(run, one_result || report.runs.size() < 3); });
  out["tables"] = of_each(report.tables, table_of_texts);
  out["charts"] = of_each(report.charts, chart_json);
  out["maps"] = of_each(report.maps, maps_json);
  out["grids"] = of_each(report.grids, grids_json);
  if (!report.passes.is_null()) out["passes"] = report.passes;
  return out;
}

}  // namespace railstrata
