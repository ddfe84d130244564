#include "validate/validation_set.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "case/text_file.hpp"
#include "case/toml_reader.hpp"
#include "case/unit_table.hpp"
#include "many/axis.hpp"

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
  explicit SetReader(CaseSource& source) : source_(source) {}

  VariedColumn varied(const toml::table& t) {
    TomlReader r(source_, t, {"column", "key", "before", "unit", "factor"}, kExample);
    const std::string column = column_at(r, t, "column");
    return {column, axis_key(r.text("key", true)), r.text("before"), r.text("unit"), r.number("factor", 1)};
  }

  ValidationSeries series(const toml::table& t) {
    TomlReader r(source_, t, {"name", "set", "judged"}, kExample);
    return {r.text("name", true), r.texts("set"), r.flag("judged", true)};
  }

  ComparedColumn compared(const toml::table& t) {
    TomlReader r(source_, t, {"column", "title", "unit", "result", "factor", "deviation", "by", "relative", "bar"},
                 kExample);
    ComparedColumn out;
    out.column = column_at(r, t, "column");
    out.title = r.text_or("title", out.column);
    out.unit = r.text("unit");
    const std::string result = r.text("result", true);
    out.result = find_column(result);
    if (!out.result && !result.empty())
      source_.complain_at(place_of(*t.get("result")), fmt::format("result = \"{}\" is no column of a result", result),
                          "take a name of the head of sweep.csv, e.g. \"p_max_MPa\"");
    out.factor = r.number("factor", 1);
    if (t.contains("deviation")) out.deviation = column_at(r, t, "deviation");
    const std::string by = r.text_or("by", difference_text(out.by));
    const std::string rms = difference_text(DifferenceBy::rms);
    r.choice("by", by, {rms, difference_text(DifferenceBy::largest)});
    out.by = by == rms ? DifferenceBy::rms : DifferenceBy::largest;
    out.relative = r.flag("relative");
    out.bar = r.number("bar", 0, true);
    return out;
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
    return out;
  }

 private:
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
  CaseSource& source_;
  std::vector<NamedColumn> columns_;
};

}  // namespace

ValidationSet load_validation(const fs::path& folder) {
  const fs::path file = folder / kFile;
  CaseSource source(file, read_text_file(file, "a validation set is a folder with validation.toml; docs/validate.md"));
  const toml::table document = toml_document(source);
  TomlReader top(source, document,
                 {"title", "source", "reference", "uncertainty", "fitted", "note", "case", "data", "cell", "vary",
                  "series", "compare"},
                 kExample);
  ValidationSet out;
  out.name = fs::absolute(folder).lexically_normal().filename().string();
  out.title = top.text("title", true);
  out.source = top.text("source", true);
  out.uncertainty = top.text("uncertainty", true);
  out.fitted = top.text("fitted", true);
  out.note = top.text("note");
  out.reference = top.text("reference", true);
  out.cell = top.text("cell");
  top.choice("reference", out.reference, {"measured", "computed", "closed form"});
  out.loaded = load_case(folder / top.text_or("case", "case.toml"));
  SetReader reader(source);
  for (const toml::table* t : tables(document, "vary")) out.varied.push_back(reader.varied(*t));
  for (const toml::table* t : tables(document, "series")) out.series.push_back(reader.series(*t));
  for (const toml::table* t : tables(document, "compare")) out.compared.push_back(reader.compared(*t));
  if (out.compared.empty())
    source.complain_at({1, 1}, "nothing is compared", "add a [[compare]] with column, result and bar");
  else
    out.data = reader.data(folder / top.text_or("data", "data.csv"));
  source.finish();
  if (out.series.empty()) out.series.emplace_back();
  return out;
}

const char* difference_text(DifferenceBy by) { return by == DifferenceBy::rms ? "rms" : "largest"; }

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
