#include "validate/validation_set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "many/axis.hpp"
#include "tables/unit_table.hpp"
#include "text/text_file.hpp"
#include "text/toml_reader.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "validation.toml";
constexpr const char* kExample = "docs/validate.md lists the keys; cases/validation has examples";

/// A column of the data that the set names, and where.
struct NamedColumn {
  std::string name;
  const char* key;
  TextPlace place;
};

/// Reads the tables of one file.
class SetReader {
 public:
  SetReader(CaseSource& source, const ValidationKind& kind) : source_(source), kind_(kind) {}

  VariedColumn varied(const toml::table& t) {
    TomlReader r(source_, t, {"column", "key", "before", "unit", "factor"}, kExample);
    const std::string column = column_at(r, t, "column"), key = r.text("key", true);
    const bool of_case = kind_.keys.empty();
    if (!of_case && !key.empty()) r.choice("key", key, kind_.keys);
    return {column, of_case ? axis_key(key) : key, r.text("before"), r.text("unit"), r.number("factor", 1)};
  }

  ValidationSeries series(const toml::table& t, const fs::path& folder) {
    TomlReader r(source_, t, {"name", "set", "judged", "recorded", "where"}, kExample);
    ValidationSeries out{r.text("name", true), r.texts("set"), r.flag("judged", true), {}, {}};
    if (const std::string file = r.text("recorded"); !file.empty()) out.recorded = folder / file;
    for (const std::string& text : r.texts("where")) {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos)
        source_.complain_at(place_of(*t.get("where")), fmt::format("where = \"{}\" has no \"=\"", text),
                            "write where = [\"engine=fem\"]: columns of the recorded table and their texts");
      else
        out.where.push_back({text.substr(0, equals), text.substr(equals + 1)});
    }
    if (!out.recorded.empty() && !out.overrides.empty())
      source_.complain_at(place_of(*t.get("set")), "set has no effect on recorded answers",
                          "take it out, or record answers of that case");
    return out;
  }

  ComparedColumn compared(const toml::table& t) {
    TomlReader r(source_, t, {"column", "title", "unit", "result", "factor", "deviation", "by", "relative", "bar"},
                 kExample);
    ComparedColumn out;
    out.column = column_at(r, t, "column");
    out.title = r.text_or("title", out.column);
    out.unit = r.text("unit");
    out.result = r.text("result", true);
    if (!out.result.empty() && std::find(kind_.results.begin(), kind_.results.end(), out.result) == kind_.results.end())
      source_.complain_at(place_of(*t.get("result")),
                          fmt::format("result = \"{}\" is no number of an answer", out.result),
                          fmt::format("of {} rows take one of: {}", kind_.name, fmt::join(kind_.results, ", ")));
    out.factor = r.number("factor", 1);
    if (t.contains("deviation")) out.deviation = column_at(r, t, "deviation");
    const std::string by = r.text_or("by", difference_text(out.by));
    std::vector<std::string> ways;
    for (const DifferenceBy way : {DifferenceBy::rms, DifferenceBy::largest, DifferenceBy::factor}) {
      ways.emplace_back(difference_text(way));
      if (ways.back() == by) out.by = way;
    }
    r.choice("by", by, ways);
    out.relative = r.flag("relative");
    if (out.relative && out.by == DifferenceBy::factor)
      source_.complain_at(place_of(*t.get("relative")), "relative = true has no meaning with by = \"factor\"",
                          "leave relative out: bar = 3 allows a third to three times the data");
    out.bar = r.number("bar", 0, true);
    if (out.relative) relative_.push_back({out.column, "column", place_of(t)});
    return out;
  }

  PressedCircle circle(const toml::table& t) {
    TomlReader r(source_, t, {"x", "y", "radius", "pressure"}, kExample);
    return {r.quantity("x", dimension::kLength, 0), r.quantity("y", dimension::kLength, 0),
            above_zero(r, t, "radius", dimension::kLength), above_zero(r, t, "pressure", dimension::kPressure)};
  }

  /// The columns that the tables name, of a file with more perhaps; as a spreadsheet writes it too.
  CsvTable data(const fs::path& file) {
    std::vector<Option> options;
    options.reserve(columns_.size());
    for (const NamedColumn& c : columns_)
      if (std::none_of(options.begin(), options.end(), [&](const Option& o) { return o.key == c.name; }))
        options.push_back({.key = c.name, .slot = nullptr, .doc = {}, .dimension = dimension::kNumber});
    UnitTableForm form{.columns = {}, .rivals = {}, .what = "a validation set", .example = "load_kN, p_max_MPa"};
    form.as_written = true;
    for (const Option& o : options) form.columns.push_back({&o, o.key});
    const UnitTable table = read_unit_table(read_text_file(file, "the data of a validation set, as CSV"), file, form);
    CsvTable out{file, {}};
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      CsvColumn& column = out.columns.emplace_back(CsvColumn{std::string(table.columns[k]->key), {}});
      for (const UnitTable::Row& row : table.rows) column.values.push_back(*row.cells[k].number);
    }
    require_columns(out);
    for (const NamedColumn& c : relative_) require_no_zero(c, out);
    return out;
  }

 private:
  double above_zero(TomlReader& r, const toml::table& t, const char* key, const Dimension& dimension) {
    const double value = r.quantity(key, dimension, 1, true);
    if (!(value > 0))
      source_.complain_at(place_of(*t.get(key)),
                          fmt::format("{} = \"{}\": must be above 0", key, t[key].value_or(std::string())),
                          "an area that is not pressed needs no circle");
    return value;
  }
  std::string column_at(TomlReader& r, const toml::table& t, const char* key) {
    const std::string name = r.text(key, true);
    if (!name.empty()) columns_.push_back({name, key, place_of(*t.get(key))});
    return name;
  }
  void require_columns(const CsvTable& data) {
    for (const NamedColumn& c : columns_)
      if (std::none_of(data.columns.begin(), data.columns.end(), [&](const CsvColumn& d) { return d.name == c.name; }))
        source_.complain_at(c.place,
                            fmt::format("{} = \"{}\" is no column of {}", c.key, c.name, data.file.filename().string()),
                            "the first line without \"#\" names its columns");
  }
  void require_no_zero(const NamedColumn& c, const CsvTable& data) {
    for (const CsvColumn& d : data.columns)
      for (std::size_t i = 0; d.name == c.name && i < d.values.size(); ++i)
        if (d.values[i] == 0)
          source_.complain_at(
              c.place,
              fmt::format("relative = true, and \"{}\" is 0 in row {}: nothing can be divided by it", c.name, i + 1),
              "take relative out and give the bar in the unit of the data, or leave the row out");
  }
  CaseSource& source_;
  const ValidationKind& kind_;
  std::vector<NamedColumn> columns_, relative_;
};

const ValidationKind& kind_of(TomlReader& top) {
  const std::vector<ValidationKind>& all = validation_kinds();
  const std::string word = top.text_or("kind", std::string(all.front().name));
  std::vector<std::string> known;
  for (const ValidationKind& kind : all) known.emplace_back(kind.name);
  top.choice("kind", word, known);
  const auto found = std::find(known.begin(), known.end(), word);
  return all[found == known.end() ? 0 : static_cast<std::size_t>(found - known.begin())];
}

int increments_of(CaseSource& source, TomlReader& top, const toml::table& document) {
  const double number = top.number("increments", 100);
  if (!(number >= 1 && number <= 1e6 && number == std::floor(number)))
    source.complain_at(place_of(*document.get("increments")), "increments must be a whole number from 1 to 1000000",
                       "write increments = 100");
  return static_cast<int>(std::clamp(number, 1.0, 1e6));
}

void refuse_settings_of_others(CaseSource& source, const toml::table& document, const ValidationKind& kind) {
  for (const ValidationKind& other : validation_kinds())
    for (const std::string& key : other.settings)
      if (document.contains(key) && std::find(kind.settings.begin(), kind.settings.end(), key) == kind.settings.end())
        source.complain_at(
            place_of(*document.get(key)),
            fmt::format("{} belongs to kind = \"{}\", this set is of kind {}", key, other.name, kind.name),
            fmt::format("take {} out, or write kind = \"{}\"", key, other.name));
}

}  // namespace

ValidationSet load_validation(const fs::path& folder) {
  const fs::path file = folder / kFile;
  CaseSource source(file, read_text_file(file, "a validation set is a folder with validation.toml; docs/validate.md"));
  const toml::table document = toml_document(source);
  TomlReader top(source, document,
                 {"title", "source", "reference", "uncertainty", "fitted", "note", "kind", "case", "data", "cell",
                  "material", "increments", "from_virgin", "circle", "vary", "series", "compare"},
                 kExample);
  ValidationSet out;
  out.file = file;
  out.name = fs::absolute(folder).lexically_normal().filename().string();
  out.title = top.text("title", true);
  out.source = top.text("source", true);
  out.uncertainty = top.text("uncertainty", true);
  out.fitted = top.text("fitted", true);
  out.note = top.text("note");
  out.reference = top.text("reference", true);
  top.choice("reference", out.reference, {"measured", "computed", "closed form"});
  out.kind = &kind_of(top);
  refuse_settings_of_others(source, document, *out.kind);
  out.cell = top.text("cell");
  out.material = top.text_or("material", "rail");
  out.increments = increments_of(source, top, document);
  out.from_virgin = top.flag("from_virgin");
  out.loaded = load_case(folder / top.text_or("case", "case.toml"));
  SetReader reader(source, *out.kind);
  for (const toml::table* t : tables(source, document, "circle")) out.circles.push_back(reader.circle(*t));
  for (const toml::table* t : tables(source, document, "vary")) out.varied.push_back(reader.varied(*t));
  for (const toml::table* t : tables(source, document, "series")) out.series.push_back(reader.series(*t, folder));
  for (const toml::table* t : tables(source, document, "compare")) out.compared.push_back(reader.compared(*t));
  if (out.compared.empty())
    source.complain_at({1, 1}, "nothing is compared", "add a [[compare]] with column, result and bar");
  else if (out.circles.empty() && out.kind->name == "pressure")
    source.complain_at({1, 1}, "nothing presses", "add a [[circle]] with radius and pressure");
  else
    out.data = reader.data(folder / top.text_or("data", "data.csv"));
  source.finish();
  if (out.series.empty()) out.series.emplace_back();
  return out;
}

const char* difference_text(DifferenceBy by) {
  constexpr const char* kTexts[] = {"rms", "largest", "factor"};
  return kTexts[static_cast<int>(by)];
}

bool holds_validation(const fs::path& folder) { return fs::exists(folder / kFile); }

std::vector<fs::path> validation_folders(const fs::path& root) {
  std::vector<fs::path> out;
  if (!fs::is_directory(root)) return out;
  for (const auto& entry : fs::directory_iterator(root))
    if (holds_validation(entry.path())) out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace railstrata
