#pragma once
// A validation set: numbers of others, the case that they belong to, and how near an answer has to come.
#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/circular_pressure.hpp"
#include "reader/case_file.hpp"
#include "record/csv.hpp"
#include "validate/validation_kind.hpp"

namespace railstrata {

/// A column of the data that gives a key of the rows' kind, of the case as a rule: factor * number between two texts,
/// "arc:R=" and "mm".
struct VariedColumn {
  std::string column, key, before, unit;
  double factor = 1;
};

/// A column and a text in it.
struct NamedText {
  std::string name, text;
};

/// The same data under other values of the case, or against answers that were recorded.
struct ValidationSeries {
  std::string name;
  std::vector<std::string> overrides;  ///< "key=value"
  bool judged = true;                  ///< false: shown beside the others, no part of the verdict
  std::filesystem::path recorded;      ///< a table of answers (recorded_answers); empty: they are computed
  std::vector<NamedText> where;        ///< what its rows must have
};

/// How the difference of all rows is made one number; factor: the answer over the data or the data over the answer,
/// the largest of all rows.
enum class DifferenceBy { rms, largest, factor };
const char* difference_text(DifferenceBy by);

/// A column of the data against factor * a number of the answer.
struct ComparedColumn {
  std::string column, title, unit;
  std::string result;  ///< its name among those of the kind
  double factor = 1;
  std::string deviation;  ///< column with the standard deviation of the data; empty: none is known
  DifferenceBy by = DifferenceBy::largest;
  bool relative = false;  ///< the difference over the data
  double bar = 0;         ///< in the unit of the data, or relative
};

struct ValidationSet {
  std::filesystem::path file;  ///< validation.toml
  std::string name;            ///< of its folder
  std::string title, source, uncertainty, fitted, note;
  std::string reference;  ///< "measured", "computed", "closed form"
  std::string cell;       ///< of the half-space engine; empty: its default
  const ValidationKind* kind = nullptr;
  std::string material;                ///< of kind material: "rail", "wheel" or a layer's name
  int increments = 1;                  ///< of kind material, a row
  bool from_virgin = false;            ///< of kind material: every row begins anew
  std::vector<PressedCircle> circles;  ///< of kind pressure
  LoadedCase loaded;
  CsvTable data;
  std::vector<VariedColumn> varied;
  std::vector<ValidationSeries> series;  ///< one without a name if the file has none
  std::vector<ComparedColumn> compared;
};

/// Reads validation.toml, data.csv and the case of a folder. Throws CaseError with every mistake, each at its place.
ValidationSet load_validation(const std::filesystem::path& folder);

bool holds_validation(const std::filesystem::path& folder);

/// The folders in `root` that hold a validation.toml, by name.
std::vector<std::filesystem::path> validation_folders(const std::filesystem::path& root);

}  // namespace railstrata
