#pragma once
// A study file (TOML): cases that come from varying keys of a base case, in named groups, and what is drawn of them.
// docs/study.md explains it to users.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/engine.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// A key of the case and the value it takes; `text` as people read it, `toml` as an override takes it.
struct StudyValue {
  std::string key, text, toml;
  TextPlace place;
};

/// The values of one case.
using StudyPoint = std::vector<StudyValue>;

struct StudyGroup {
  std::string name, title;
  std::filesystem::path base;  ///< case file, as it can be opened
  std::vector<Engine> engines;
  StudyPoint set, tags;            ///< the same for all cases; tags appear in tables and figures and change no case
  std::vector<StudyPoint> points;  ///< vary x zip x case, in this order, the last changing fastest
};

/// A figure over the cases of some groups: one chart (or row of maps) for each value of `each`, one line (or map) for
/// each value of `series`. A case without such a key stands in every chart.
struct StudyFigure {
  std::string id, title, note, kind;  ///< "centre_line", "trend", "map", "verdict", "grid"
  std::string
      value;  ///< centre_line: "p", "q"; trend, grid: a column of the table; map: "state", "von_mises", "sigma_1"
  std::string each, series, x, y;  ///< keys; x: of a trend, x and y: of a grid
  std::vector<std::string> groups;
  std::vector<Engine> engines;
  std::map<std::string, std::vector<std::string>>
      where;  ///< only cases whose key has one of these values; those without the key pass
};

struct StudySpec {
  std::string title, cell;  ///< cell: of the half-space engine; empty: its default
  std::vector<StudyGroup> groups;
  std::vector<StudyFigure> figures;
};

struct LoadedStudy {
  StudySpec spec;
  std::filesystem::path file;
  std::string source_text;
};

/// Reads and checks a study file; base cases are looked for, not read. Throws CaseError with every mistake, each with
/// its place and a remedy.
LoadedStudy load_study(const std::filesystem::path& file);
LoadedStudy parse_study(const std::string& text, const std::filesystem::path& file);

}  // namespace railstrata
