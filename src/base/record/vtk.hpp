#pragma once
// Results for ParaView and VTK: XML files with appended raw data, UInt64 headers and zlib blocks (VTK 9.1,
// ParaView 5.11 and meshio read them). Every file is written whole (record/output_file). Errors: EnvironmentError for
// the disk, std::invalid_argument for arrays that do not fit or bad names.
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "record/column.hpp"

namespace railstrata {

/// An array over points or cells. Names carry the unit and neither blanks nor brackets: pressure_MPa, stress_MPa,
/// slip_velocity_mm_s, state. values: components of one point after the other. Symmetric tensors have 6 components in
/// VTK's order XX YY ZZ XY YZ XZ (that of Sym3).
struct VtkField {
  std::string name;
  int components = 1;
  std::variant<std::vector<float>, std::vector<double>, std::vector<std::int32_t>> values;
};

/// An array of records as tables have them, a component a column; `name` without a unit, which is the columns'.
template <class Number, class Record>
VtkField vtk_field(const std::string& name, const std::vector<Record>& records, const Columns<Record>& columns) {
  std::vector<Number> values;
  for (const Record& record : records)
    for (const Column<Record>& c : columns) values.push_back(static_cast<Number>(c.in_table(record)));
  return {name + std::string(columns.front().unit.column_ending), static_cast<int>(columns.size()), std::move(values)};
}

/// An array for each column: whole numbers of counts.
template <class Number, class Record>
void add_vtk_fields(std::vector<VtkField>& fields, const std::vector<Record>& records, const Columns<Record>& columns) {
  for (const Column<Record>& c : columns)
    fields.push_back(c.unit.whole ? vtk_field<std::int32_t, Record>(c.symbol, records, {c})
                                  : vtk_field<Number, Record>(c.symbol, records, {c}));
}

/// Cells of Corners nodes each, node numbers from 0, in VTK's order. Points in metres, stored in double precision.
template <std::size_t Corners>
struct VtkMesh {
  std::vector<Vec3> points;
  std::vector<std::array<long long, Corners>> cells;
  std::vector<VtkField> point_fields, cell_fields;
};
using VtkHexahedra = VtkMesh<8>;
using VtkQuads = VtkMesh<4>;

/// Volume: an unstructured grid of hexahedra (.vtu).
void write_vtu(const std::filesystem::path& file, const VtkHexahedra& mesh);
/// Surface: polygonal data of quadrilaterals (.vtp).
void write_vtp(const std::filesystem::path& file, const VtkQuads& mesh);

/// A time series (.pvd) of .vtu or .vtp files. The collection is rewritten after each frame, so it can be opened while
/// the run goes on.
class PvdSeries {
 public:
  explicit PvdSeries(std::filesystem::path file) : file_(std::move(file)) {}
  /// Adds a frame that has been written; `frame` is stored relative to the collection's folder. time in seconds, or
  /// whatever the frames are ordered by.
  void add(double time, const std::filesystem::path& frame);

 private:
  std::filesystem::path file_;
  std::string entries_;
};

}  // namespace railstrata
