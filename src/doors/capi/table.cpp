#include <cmath>
#include <limits>

#include "capi/guarded.hpp"
#include "capi/railstrata.h"
#include "io/table_file.hpp"

using namespace railstrata;

/// A table and what looks things up in it.
struct rs_table {
  explicit rs_table(ForceTable read) : table(std::move(read)), between(table) {}
  ForceTable table;
  TableInterpolation between;
};

namespace {

const TableAxis* axis_of(const rs_table* table, int axis) {
  if (!table || axis < 0 || static_cast<std::size_t>(axis) >= table->table.axes.size()) return nullptr;
  return &table->table.asked(static_cast<std::size_t>(axis));
}
const TableNumber* number_of(const rs_table* table, int number) {
  if (!table || number < 0 || static_cast<std::size_t>(number) >= table->table.numbers.size()) return nullptr;
  return &table->table.numbers[static_cast<std::size_t>(number)];
}

}  // namespace

extern "C" {

rs_table* rs_table_open(const char* file, rs_error* error) {
  return capi::made(error, [&] {
    if (!file) throw CaseError("no file was named", "give its path");
    return new rs_table(read_force_table(file));
  });
}

void rs_table_close(rs_table* table) { delete table; }

int rs_table_axes(const rs_table* table) { return table ? static_cast<int>(table->table.axes.size()) : 0; }
int rs_table_numbers(const rs_table* table) { return table ? static_cast<int>(table->table.numbers.size()) : 0; }

const char* rs_table_axis(const rs_table* table, int axis) {
  const TableAxis* found = axis_of(table, axis);
  return found ? found->name.c_str() : nullptr;
}

const char* rs_table_axis_unit(const rs_table* table, int axis) {
  const TableAxis* found = axis_of(table, axis);
  return found ? found->unit.c_str() : nullptr;
}

double rs_table_axis_first(const rs_table* table, int axis) {
  const TableAxis* found = axis_of(table, axis);
  return found ? found->at.front() : std::numeric_limits<double>::quiet_NaN();
}

double rs_table_axis_last(const rs_table* table, int axis) {
  const TableAxis* found = axis_of(table, axis);
  return found ? found->at.back() : std::numeric_limits<double>::quiet_NaN();
}

const char* rs_table_number(const rs_table* table, int number) {
  const TableNumber* found = number_of(table, number);
  return found ? found->name.c_str() : nullptr;
}

const char* rs_table_number_unit(const rs_table* table, int number) {
  const TableNumber* found = number_of(table, number);
  return found ? found->unit.c_str() : nullptr;
}

int rs_table_at(const rs_table* table, const double* at, double* out) {
  if (!table || !at || !out) return -1;
  for (std::size_t k = 0; k < table->table.axes.size(); ++k)
    if (std::isnan(at[k])) return -1;
  return table->between.at(at, out);
}

}  // extern "C"
