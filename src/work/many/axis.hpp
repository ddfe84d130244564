#pragma once
// Axes of many cases: keys of a case with the values that they take. `sweep --vary`, `creep-table --axis`, the tables
// of a study file and Python's sweep use the same words.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace railstrata {

struct Option;

/// A key and its values, as an override takes them ("0.2 mm", with or without quotes).
struct Axis {
  std::string key;
  std::vector<std::string> values;
};

/// An axis of numbers that ascend, as a table needs it.
struct NumberAxis : Axis {
  std::string word;        ///< the short word of the key, else the key
  std::string unit;        ///< SI; "": a plain number. Slopes are tangents
  std::vector<double> at;  ///< in that unit, two or more
};

/// Words for keys that often vary: creepage_x, creepage_y, spin, load, friction, lateral_shift, yaw.
std::vector<std::string> axis_words();

/// The key of a word; a key is its own.
std::string axis_key(const std::string& word);

/// The option of "table.option" or "table.index.option"; null if there is none.
const Option* option_of_key(const std::string& key);

/// Whether a key of the case takes words or lists: it makes no axis of numbers.
bool takes_no_number(const std::string& key);

/// A value as people read it: ["-200 MPa", "-100 MPa"] as -200 MPa; -100 MPa.
std::string shown_value(const std::string& text);

/// The axis of a word or key. One value that stands for several is expanded: "from:to:count" at equal distances, "log
/// from:to:count" at equal ratios, "+-largest:count", odd, through 0 and by equal ratios over two and a half decades to
/// both sides. Throws CaseError: a range of what is no number, values out of the key's range.
Axis make_axis(const std::string& word, std::vector<std::string> values);

/// Reads options "WORD=v1,v2,…" or "WORD=RANGE"; blanks and quotes around values do not count. `option` names them in
/// messages ("--vary"). Throws CaseError as make_axis; no "=", no or an empty value, a key given twice.
std::vector<Axis> parse_axes(const std::string& option, const std::vector<std::string>& texts);

/// The same of numbers: a bare number has the unit of the last value that has one. Throws CaseError also: an unknown
/// word or key, one that is no number, values that do not ascend, no axis or more than a table may have.
std::vector<NumberAxis> parse_number_axes(const std::string& option, const std::vector<std::string>& texts);

/// A value as an override of the axis' key takes it.
std::string axis_text(const NumberAxis& axis, double value);

/// A value's number for a chart, and the text after it ("0.2 mm": 0.2, "mm"); NaN for a word.
std::pair<double, std::string> axis_value(const std::string& text);

/// The share of the largest value that the k-th of n has, equal ratios over two and a half decades; k in [0, n].
double decade_share(int k, int n);

/// Largest number of combinations of a sweep or of a group of a study.
inline constexpr std::size_t kMostCases = 10'000;

/// Every combination, the last key changing fastest: per case the value of each key. One empty combination of no keys.
/// Throws CaseError beyond `most`, for a key without values and for an empty value.
std::vector<std::vector<std::string>> combinations(const std::vector<Axis>& axes, std::size_t most = kMostCases);

}  // namespace railstrata
