#include "study/study_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "core/faults.hpp"
#include "io/checkpoint_file.hpp"
#include "io/output_folder.hpp"
#include "io/provenance.hpp"
#include "io/result_folder.hpp"
#include "record/csv.hpp"
#include "record/output_file.hpp"
#include "report/assets.hpp"
#include "runs/write_fem_result.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read_json(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return in ? Json::parse(in, nullptr, false) : Json(nullptr);
}

bool holds(const fs::path& folder, const StudyCase& c) {
  const Json j = read_json(folder / kStudyFile);
  return j.is_object() && j.value("key", "") == c.key && j.contains("fault") && j["fault"].is_null() &&
         read_json(folder / "summary.json").is_object();
}

fs::path beside(const fs::path& folder, const std::string& ending) { return folder.string() + ending; }

/// The largest values of a section's cells and the depth of their centres: what a picture of the section shows.
void add_section_maxima(const fs::path& folder, Json& out) {
  const CsvTable table = read_csv(folder / "rail_longitudinal_section.csv");
  const std::vector<double> depth = table.column("depth_mm");
  for (const StressMeasure& m : stress_measures()) {
    const ResultColumn& largest = column_of(fmt::format("section_{}", m.symbol));
    const std::vector<double> v = table.column(fmt::format("{}{}", m.symbol, largest.shown_unit.column_ending));
    const auto k = static_cast<std::size_t>(std::max_element(v.begin(), v.end()) - v.begin());
    out[largest.name] = v[k];
    out[column_of(fmt::format("section_{}_depth", m.symbol)).name] = depth[k];
  }
}

/// The largest von Mises stress and principal stress of the rail wherever they are, the surface included, with their
/// depth.
void add_rail_maxima(const Json& summary, Json& out) {
  for (const StressMeasure& m : stress_measures()) {
    const ResultColumn &largest = column_of(fmt::format("rail_{}", m.symbol)),
                       &its_depth = column_of(fmt::format("rail_{}_depth", m.symbol));
    double best = -std::numeric_limits<double>::infinity(), depth = 0;
    for (const StressZone& zone : stress_zones()) {
      const auto number = [&](const char* key, const ResultColumn& c) {
        const auto at = fmt::format("/stress/rail/{}/{}/{}{}", zone.key, m.key, key, c.shown_unit.key_ending);
        return column_value({.name = "", .path = at, .factor = c.factor}, summary);
      };
      if (const double value = number("value", largest); std::isfinite(value) && value > best) {
        best = value;
        depth = number("depth", its_depth);
      }
    }
    if (!std::isfinite(best)) continue;
    out[largest.name] = best;
    out[its_depth.name] = depth;
  }
}

Json numbers_of(const fs::path& folder) {
  Json out = Json::object();
  add_rail_maxima(read_json(folder / "summary.json"), out);
  add_section_maxima(folder, out);
  return out;
}

std::string study_json(const StudyCase& c, const Json& fault, const Json& numbers) {
  Json values = Json::object();
  for (const auto& [key, text] : c.values) values[key] = text;
  return Json{{"key", c.key},       {"result_version", kResultVersion},
              {"engine", c.engine}, {"group", c.group},
              {"case", c.name},     {"values", values},
              {"fault", fault},     {"numbers", numbers}}
             .dump(2) +
         "\n";
}

/// An old folder makes room for a new one; a reader finds one or the other, and for a moment none. Another study that
/// does the same at this moment takes its turn.
void put_in_place(const fs::path& working, const fs::path& place) {
  const fs::path old = beside(place, ".old" + part_ending());
  std::error_code moved, error, ignored;
  for (int turn = 0; turn < 1000; ++turn) {
    fs::rename(place, old, moved);
    fs::rename(working, place, error);
    const bool others_came_first = error == std::errc::directory_not_empty || error == std::errc::file_exists;
    if (!error || others_came_first)
      fs::remove_all(old, ignored);
    else if (!moved)
      fs::rename(old, place, ignored);
    if (!others_came_first) break;
  }
  if (error)
    throw EnvironmentError(fmt::format("cannot rename {} to {}: {}", working.string(), place.string(), error.message()),
                           "look at both folders, then start the study again");
}

/// An unfinished copy of a folder: of no use to anybody.
std::string copy_ending() { return ".copy" + part_ending(); }

/// What processes have begun of a case and not renamed yet.
std::vector<fs::directory_entry> parts_of(const fs::path& out, const StudyCase& c) {
  std::vector<fs::directory_entry> parts;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator((out / c.folder).parent_path(), error))
    if (const std::string name = entry.path().filename().string();
        name.starts_with(c.folder.filename().string() + ".") && is_part(name))
      parts.push_back(entry);
  return parts;
}

/// Folders of a case that others had begun. Small files that they have left are removed: only the owner of the claim
/// asks.
std::vector<fs::path> left_behind(const fs::path& out, const StudyCase& c) {
  std::vector<fs::path> left;
  std::error_code error;
  for (const fs::directory_entry& part : parts_of(out, c))
    if (part.is_directory(error) && part.path().filename().string().find(".copy.") == std::string::npos)
      left.push_back(part.path());
    else
      fs::remove_all(part.path(), error);
  return left;
}

bool rename_to(const fs::path& folder, const fs::path& working) {
  std::error_code error;
  fs::rename(folder, working, error);
  return !error;
}

bool in_use(const fs::path& folder) {
  try {
    const FolderHold hold(folder);
    return false;
  } catch (const CaseError&) {
    return true;
  }
}

/// The folder, renamed; its process may be alive without knowing that it has lost the case (a machine that slept): then
/// a copy, so that what it still writes reaches nobody.
bool move_or_copy(const fs::path& out, const StudyCase& c, const fs::path& folder, const fs::path& working) {
  if (is_abandoned_part(folder.filename().string()) && !in_use(folder)) return rename_to(folder, working);
  const fs::path taken = beside(out / c.folder, ".taken" + part_ending()), copy = beside(out / c.folder, copy_ending());
  std::error_code error, ignored;
  if (!rename_to(folder, taken)) return false;
  fs::copy(taken, copy, fs::copy_options::recursive, error);
  const bool whole = !error && rename_to(copy, working);
  fs::remove_all(copy, ignored);
  fs::remove_all(taken, ignored);
  return whole;
}

/// The folder that another process has left becomes the working one.
bool make_working(const fs::path& out, const StudyCase& c, const fs::path& folder, const fs::path& working) {
  const bool ours = move_or_copy(out, c, folder, working);
  if (ours) remove_parts(working, PartsOf::anyone);
  return ours;
}

/// Its checkpoint is whole, of this case and of this program: going on gives the bits of a run in one go.
bool can_go_on(const fs::path& folder, const StudyCase& c) {
  try {
    return read_checkpoint(folder, case_identity(c.loaded)).checkpoint.origin.program == version_text();
  } catch (const CaseError&) {
    return false;
  }
}

void recover_case(const fs::path& out, const StudyCase& c) {
  std::error_code error;
  for (const fs::path& folder : left_behind(out, c)) {
    if (is_done(out, c) || !(holds(folder, c) || has_checkpoint(folder)))
      fs::remove_all(folder, error);
    else if (holds(folder, c) && make_working(out, c, folder, working_folder(out, c)))
      put_in_place(working_folder(out, c), out / c.folder);
  }
}

/// Tables that a process had half written: it is known to be dead, or has not written for a lease.
void remove_half_tables(const fs::path& out, double lease) {
  std::error_code error;
  std::vector<fs::path> tables;
  for (const auto& entry : fs::directory_iterator(out, error)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_regular_file(error) || !is_part(name)) continue;
    const std::optional<double> written = written_at(entry.path()), now = file_server_time(out / "study");
    if (is_abandoned_part(name) || (written && now && *now - *written > lease)) tables.push_back(entry.path());
  }
  for (const fs::path& file : tables) fs::remove(file, error);
}

}  // namespace

void find_results(const fs::path& out, std::vector<StudyCase>& cases) {
  std::map<std::string, fs::path> found;
  for (const StudyCase& c : cases)
    for (const fs::path& folder : {c.folder, c.own_folder})
      if (!found.contains(c.key) && holds(out / folder, c)) found[c.key] = folder;
  for (StudyCase& c : cases)
    if (const auto at = found.find(c.key); at != found.end()) c.folder = at->second;
}

bool is_done(const fs::path& out, const StudyCase& c) { return holds(out / c.folder, c); }

std::string last_failure(const fs::path& out, const StudyCase& c) {
  const Json j = read_json(beside(out / c.folder, ".failed") / kStudyFile);
  return j.is_object() && j.value("key", "") == c.key && j.contains("fault") && j["fault"].is_string()
             ? j["fault"].get<std::string>()
             : "";
}

fs::path working_folder(const fs::path& out, const StudyCase& c) { return beside(out / c.folder, part_ending()); }

fs::path claim_file(const fs::path& out, const StudyCase& c) { return beside(out / c.folder, ".claim"); }

bool keep_result(const fs::path& out, const StudyCase& c, const fs::path& working, const Claim& claim) {
  if (!claim.is_ours()) return false;
  std::vector<fs::path> scripts;
  for (const auto& entry : fs::recursive_directory_iterator(working))
    if (entry.path().filename() == "view.py") scripts.push_back(entry.path().parent_path());
  for (const fs::path& folder : scripts) write_view_script(folder, out / c.folder / fs::relative(folder, working));
  write_whole_file(working / kStudyFile, study_json(c, nullptr, numbers_of(working)));
  std::error_code error;
  if (!claim.is_ours()) return false;
  if (is_done(out, c))
    fs::remove_all(working, error);  // another study was faster: the same numbers
  else
    put_in_place(working, out / c.folder);
  fs::remove_all(beside(out / c.folder, ".failed"), error);
  return true;
}

bool keep_failure(const fs::path& out, const StudyCase& c, const fs::path& working, const std::string& reason,
                  const Claim& claim) {
  if (!claim.is_ours()) return false;
  write_whole_file(working / kStudyFile, study_json(c, reason, Json::object()));
  if (!claim.is_ours()) return false;
  put_in_place(working, beside(out / c.folder, ".failed"));
  return true;
}

void recover(const fs::path& out, const std::vector<StudyCase>& cases, double lease) {
  std::error_code error;
  for (const StudyCase& c : cases)
    if (c.first && (!parts_of(out, c).empty() || fs::exists(claim_file(out, c), error)))
      if (const auto claim = Claim::take(claim_file(out, c), lease)) recover_case(out, c);
  remove_half_tables(out, lease);
}

bool take_over(const fs::path& out, const StudyCase& c, const fs::path& working) {
  std::error_code error;
  // of an earlier process of the same name and number, as containers have them
  rename_to(working, beside(out / c.folder, ".taken" + part_ending()));
  bool taken = false;
  std::vector<fs::path> left = left_behind(out, c);
  if (const fs::path failed = beside(out / c.folder, ".failed"); has_checkpoint(failed))
    left.push_back(failed);  // killed or out of room, most likely; what fails by itself will do so again soon
  for (const fs::path& folder : left) {
    if (!taken && has_checkpoint(folder)) {
      const bool ours = make_working(out, c, folder, working);
      taken = ours && can_go_on(working, c);
      if (ours && !taken) fs::remove_all(working, error);
    } else {
      fs::remove_all(folder, error);
    }
  }
  return taken;
}

std::vector<CaseRow> study_rows(const fs::path& out, const std::vector<StudyCase>& cases) {
  const std::vector<ResultColumn> columns = result_columns(true);
  const ResultColumn& threads = column_of("threads");
  std::vector<CaseRow> rows;
  for (const StudyCase& c : cases) {
    CaseRow row{c.group, c.name, c.engine, "to do", last_failure(out, c), c.folder, c.values, {}, {}};
    if (is_done(out, c)) {
      const Json summary = read_json(out / c.folder / "summary.json"), study = read_json(out / c.folder / kStudyFile);
      row.state = "done";
      row.fault = failed_check(summary);
      row.remarks = remarks_of(summary);
      for (const ResultColumn& column : columns)
        if (column.name != "wall_s") row.numbers.emplace_back(column.name, column_value(column, summary));
      if (summary.contains(kPassageGroup))
        for (const ResultColumn& column : passage_columns())
          row.numbers.emplace_back(column.name, column_value(column, summary));
      for (const auto& [name, value] : study["numbers"].items())
        row.numbers.emplace_back(name, value.is_number() ? value.get<double>() : kNotApplicable);
      row.numbers.emplace_back("wall_s", column_value(columns.back(), summary));
      row.numbers.emplace_back(threads.name, column_value(threads, summary));
    } else if (!row.fault.empty()) {
      row.state = "failed";
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void write_study_table(const fs::path& file, std::vector<std::string> origin, const std::vector<CaseRow>& rows) {
  origin.push_back(patches_remark(result_columns(true)));
  const std::vector<CaseColumn> head{
      {"group", [](const CaseRow& row) { return row.group; }},
      {"case", [](const CaseRow& row) { return row.name; }},
      {"engine", [](const CaseRow& row) { return std::string(engine_word(row.engine)); }}};
  const std::vector<CaseColumn> state{{"folder", [](const CaseRow& row) { return row.folder.generic_string(); }},
                                      {"state", [](const CaseRow& row) { return row.state; }}};
  write_cases(
      file, origin,
      {joined(head, value_columns(rows), number_columns(rows), answer_columns(rows), state, remark_columns()), rows});
}

}  // namespace railstrata
