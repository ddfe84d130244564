#pragma once
// A quantity of a record, defined once: its name, its unit and where a record has it. Tables, JSON and VTK arrays are
// written from lists of columns (record/csv.hpp, record/json.hpp, record/vtk.hpp); a table that shows some of them
// selects them by symbol.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec.hpp"
#include "record/unit.hpp"

namespace railstrata {

inline constexpr int kEveryDigit = -1;

template <class Record>
struct Column {
  std::string symbol;  ///< its name without a unit: "p_max"
  Unit unit;
  std::function<double(const Record&)> value;  ///< SI, a member or a function; NaN: does not apply
  int decimals = kEveryDigit;                  ///< to which a table has it, in its own unit

  std::string column_name() const { return symbol + std::string(unit.column_ending); }  ///< "p_max_MPa"
  std::string key() const { return symbol + std::string(unit.key_ending); }             ///< in SI: "p_max_Pa"
  double in_table(const Record& record) const {
    const double v = unit.column_factor * value(record);
    if (decimals == kEveryDigit) return v;
    constexpr std::array kSteps{1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6};
    const double steps = kSteps[static_cast<std::size_t>(decimals)];
    return std::round(steps * v) / steps;
  }
};

template <class Record>
using Columns = std::vector<Column<Record>>;

template <class Record>
std::vector<std::string> names_of(const Columns<Record>& columns) {
  std::vector<std::string> out;
  for (const Column<Record>& c : columns) out.push_back(c.column_name());
  return out;
}

template <class Record>
std::vector<double> table_row(const Columns<Record>& columns, const Record& record) {
  std::vector<double> out;
  for (const Column<Record>& c : columns) out.push_back(c.in_table(record));
  return out;
}

template <class Record>
void append(Columns<Record>& columns, const Columns<Record>& more) {
  columns.insert(columns.end(), more.begin(), more.end());
}

/// The same for a record one of whose parts has them; `part` gets that part of a record.
template <class Record, class Part, class Get>
Columns<Record> of_part(const Columns<Part>& columns, Get part) {
  Columns<Record> out;
  for (const Column<Part>& c : columns)
    out.push_back({c.symbol, c.unit,
                   [value = c.value, part](const Record& record) { return value(std::invoke(part, record)); },
                   c.decimals});
  return out;
}

/// The columns of these symbols, in their order.
template <class Record>
Columns<Record> select(const Columns<Record>& columns, std::initializer_list<std::string_view> symbols) {
  Columns<Record> out;
  for (const std::string_view symbol : symbols) {
    const auto found = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.symbol == symbol; });
    assert(found != columns.end());
    out.push_back(*found);
  }
  return out;
}

/// The same to so many decimals.
template <class Record>
Columns<Record> rounded(Columns<Record> columns, int decimals) {
  for (Column<Record>& c : columns) c.decimals = decimals;
  return columns;
}

/// The order of a symmetric tensor's components, VTK's.
inline constexpr std::array<const char*, 6> kTensorComponents{"xx", "yy", "zz", "xy", "yz", "xz"};
inline double component(const Sym3& s, std::size_t i) { return std::array{s.xx, s.yy, s.zz, s.xy, s.yz, s.xz}[i]; }
inline double component(const std::array<double, 6>& s, std::size_t i) { return s[i]; }

/// The six columns of a symmetric tensor, "sigma_xx" and so on; `value` gives it of a record.
template <class Record, class Value>
Columns<Record> tensor_columns(const std::string& symbol, const Unit& unit, Value value) {
  Columns<Record> out;
  for (std::size_t i = 0; i < kTensorComponents.size(); ++i)
    out.push_back({symbol + "_" + kTensorComponents[i], unit,
                   [value, i](const Record& record) { return component(std::invoke(value, record), i); }});
  return out;
}

}  // namespace railstrata
