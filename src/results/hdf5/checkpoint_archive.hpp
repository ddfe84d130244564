#pragma once
// The two archives that a checkpoint is described to: one writes HDF5 in memory, the other reads it and checks every
// array.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "hdf5/checkpoint_image.hpp"
#include "hdf5/hdf5_handle.hpp"

namespace railstrata::checkpoint_archive {

using Damage = CheckpointDamage;

/// Throws CheckpointDamage where HDF5 has failed in this step of its work.
inline hid_t checked(hid_t id, const char* step) {
  if (id < 0) throw Damage{fmt::format("HDF5 could not {}", step)};
  return id;
}
/// The same of a part of a checkpoint that is read.
inline hid_t readable(hid_t id, const char* part) {
  if (id < 0) throw Damage{fmt::format("{} cannot be read", part)};
  return id;
}

struct Handle : Hdf5Handle {
  Handle(hid_t id, Close close, const char* step) : Hdf5Handle(checked(id, step), close) {}
};
struct PartHandle : Hdf5Handle {
  PartHandle(hid_t id, Close close, const char* part) : Hdf5Handle(readable(id, part), close) {}
};

/// A file in memory only, that grows by so many bytes at a time.
inline Handle memory_access(std::size_t growth) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a file in memory");
  checked(H5Pset_fapl_core(access, growth, 0), "make a file in memory");
  return Handle(H5Pcopy(access), H5Pclose, "make a file in memory");
}

// describe() names the same entries in the same order to both archives: row: one record of numbers; rows: a table of
// them; numbers: a long array; text; group: a part.
class Writer {
 public:
  static constexpr bool reading = false;
  explicit Writer(hid_t at) : at_(at) {}

  void text(const char* name, std::string& value) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe a text");
    checked(H5Tset_size(type, value.size() + 1), "describe a text");
    Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describe a text"), how = timeless();
    Handle set(H5Dcreate2(at_, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, "add a text");
    checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.c_str()), "write a text");
  }
  template <class Array>
  void numbers(const char* name, Array& values) {
    write(name, values.data(), {values.size()}, {});
  }
  template <class T, class Visit>
  void rows(const char* name, std::vector<T>& all, Visit&& visit) {
    T sample{};
    table(name, sample, all.data(), all.size(), visit);
  }
  /// Rows that older formats lack, where there are any to write.
  template <class T, class Visit>
  void later_rows(const char* name, std::vector<T>& all, Visit&& visit, bool any = true) {
    if (any) rows(name, all, visit);
  }
  /// The same of further columns of rows that are there.
  template <class T, class Visit>
  void later_columns(const char* name, std::vector<T>& all, Visit&& visit, bool any = true) {
    if (any) rows(name, all, visit);
  }
  template <class T, class Visit>
  void row(const char* name, T& value, Visit&& visit) {
    table(name, value, &value, 1, visit);
  }
  template <class Describe>
  void group(const std::string& name, Describe&& describe) {
    Handle group(H5Gcreate2(at_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "add a group");
    Writer inner(group);
    describe(inner);
  }

 private:
  template <class T, class Visit>
  void table(const char* name, T& sample, T* first, std::size_t count, Visit&& visit) {
    std::vector<std::string> names;
    visit(sample, [&](const char* column, auto&) { names.emplace_back(column); });
    std::vector<double> values;
    values.reserve(count * names.size());
    for (std::size_t k = 0; k < count; ++k)
      visit(first[k], [&](const char*, auto& v) { values.push_back(static_cast<double>(v)); });
    write(name, values.data(), {count, names.size()}, names);
  }
  void write(const char* name, const double* values, const std::vector<hsize_t>& size,
             const std::vector<std::string>& columns) {
    Handle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose, "describe an array"),
        how = timeless();
    Handle set(H5Dcreate2(at_, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, "add an array");
    double none = 0;
    checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values ? values : &none), "write an array");
    if (columns.empty()) return;
    const std::string text = fmt::format("{}", fmt::join(columns, ","));
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "describe a text");
    checked(H5Tset_size(type, text.size() + 1), "describe a text");
    Handle one(H5Screate(H5S_SCALAR), H5Sclose, "describe a text");
    Handle attribute(H5Acreate2(set, "columns", type, one, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "add a text");
    checked(H5Awrite(attribute, type, text.c_str()), "write a text");
  }
  /// Without the time of day in it: the same state has the same bytes.
  static Handle timeless() {
    const hid_t how = checked(H5Pcreate(H5P_DATASET_CREATE), "describe an array");
    H5Pset_obj_track_times(how, false);
    return Handle(how, H5Pclose, "describe an array");
  }
  hid_t at_;
};

// Takes only what a Writer writes: arrays in one piece inside the file, no longer than it. Links, filters, other files
// and other types, which HDF5 would follow, are damage.
class Reader {
 public:
  static constexpr bool reading = true;
  /// bytes: of the whole image.
  Reader(hid_t at, std::size_t bytes) : at_(at), bytes_(bytes) {}

  void text(const char* name, std::string& value) {
    const PartHandle set = open_array(name);
    const PartHandle type(H5Dget_type(set), H5Tclose, name), space(H5Dget_space(set), H5Sclose, name);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
        H5Sget_simple_extent_type(space) != H5S_SCALAR || H5Tget_size(type) == 0 || H5Tget_size(type) > bytes_)
      throw Damage{fmt::format("{} is no text", name)};
    require_stored(set, name, H5Tget_size(type));
    std::string raw(H5Tget_size(type), '\0');
    readable(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()), name);
    value = raw.substr(0, raw.find('\0'));
  }
  template <class Array>
  void numbers(const char* name, Array& values) {
    const PartHandle set = open_array(name);
    values.resize(size_of(set, name, 1)[0]);
    read(set, name, values.data(), values.empty());
  }
  template <class T, class Visit>
  void rows(const char* name, std::vector<T>& all, Visit&& visit) {
    T sample{};
    const auto [values, count] = table(name, sample, visit);
    all.assign(count, T{});
    const double* next = values.data();
    for (T& one : all) take(one, next, visit);
  }
  template <class T, class Visit>
  void later_rows(const char* name, std::vector<T>& all, Visit&& visit, bool = true) {
    if (H5Lexists(at_, name, H5P_DEFAULT) > 0) rows(name, all, visit);
  }
  template <class T, class Visit>
  void later_columns(const char* name, std::vector<T>& all, Visit&& visit, bool = true) {
    if (H5Lexists(at_, name, H5P_DEFAULT) <= 0) return;
    T sample{};
    const auto [values, count] = table(name, sample, visit);
    const double* next = values.data();
    for (std::size_t k = 0; k < std::min(count, all.size()); ++k) take(all[k], next, visit);
  }
  template <class T, class Visit>
  void row(const char* name, T& value, Visit&& visit) {
    const auto [values, count] = table(name, value, visit);
    if (count != 1) throw Damage{fmt::format("{} is not one row", name)};
    const double* next = values.data();
    take(value, next, visit);
  }
  template <class Describe>
  void group(const std::string& name, Describe&& describe) {
    require_part_of_file(name.c_str());
    PartHandle group(H5Gopen2(at_, name.c_str(), H5P_DEFAULT), H5Gclose, name.c_str());
    Reader inner(group, bytes_);
    describe(inner);
  }
  /// How many parts a list has cannot be more than the file has bytes.
  void require_count(const std::vector<std::size_t>& count) const {
    if (count.size() != 1 || count[0] > bytes_) throw Damage{"a list has no sound count"};
  }

 private:
  void require_part_of_file(const char* name) const {
    H5L_info_t link;
    if (H5Lget_info(at_, name, &link, H5P_DEFAULT) < 0) throw Damage{fmt::format("{} is missing", name)};
    if (link.type != H5L_TYPE_HARD) throw Damage{fmt::format("{} is a link", name)};
  }
  /// Refuses data that HDF5 would fill in because they were never written. Only data in one piece in this file have an
  /// offset: no chunks, which may be filtered, and no external file.
  static void require_stored(hid_t set, const char* name, hsize_t bytes) {
    if (H5Dget_storage_size(set) != bytes || (bytes > 0 && H5Dget_offset(set) == HADDR_UNDEF))
      throw Damage{fmt::format("{} is not stored in one piece", name)};
  }
  PartHandle open_array(const char* name) const {
    require_part_of_file(name);
    return PartHandle(H5Dopen2(at_, name, H5P_DEFAULT), H5Dclose, name);
  }
  template <class T, class Visit>
  std::pair<std::vector<double>, std::size_t> table(const char* name, T& sample, Visit&& visit) {
    const PartHandle set = open_array(name);
    const std::vector<hsize_t> size = size_of(set, name, 2);
    std::size_t columns = 0;
    visit(sample, [&](const char*, auto&) { ++columns; });
    if (columns != size[1]) throw Damage{fmt::format("{} has {} columns, not {}", name, size[1], columns)};
    std::vector<double> values(size[0] * size[1]);
    read(set, name, values.data(), values.empty());
    return {std::move(values), size[0]};
  }
  template <class T, class Visit>
  static void take(T& to, const double*& next, Visit&& visit) {
    visit(to,
          [&](const char* column, auto& v) { v = number_as<std::remove_reference_t<decltype(v)>>(*next++, column); });
  }
  /// A whole number must be one, and one that its type holds.
  template <class T>
  static T number_as(double value, const char* name) {
    if constexpr (!std::is_floating_point_v<T>) {
      const double end = std::ldexp(1.0, std::numeric_limits<T>::digits), begin = std::is_signed_v<T> ? -end : 0.0;
      if (!(value >= begin && value < end && value == std::floor(value)))
        throw Damage{fmt::format("{} has the value {}, which it cannot have", name, value)};
    }
    return static_cast<T>(value);
  }
  std::vector<hsize_t> size_of(hid_t set, const char* name, int dimensions) const {
    const PartHandle space(H5Dget_space(set), H5Sclose, name), type(H5Dget_type(set), H5Tclose, name);
    std::vector<hsize_t> size(dimensions);
    if (H5Sget_simple_extent_ndims(space) != dimensions)
      throw Damage{fmt::format("{} is no array of {} dimensions", name, dimensions)};
    if (H5Tequal(type, H5T_IEEE_F64LE) <= 0) throw Damage{fmt::format("{} is no array of numbers of 8 bytes", name)};
    readable(H5Sget_simple_extent_dims(space, size.data(), nullptr), name);
    hsize_t most = bytes_ / sizeof(double);
    for (const hsize_t n : size) {
      if (n > most) throw Damage{fmt::format("{} is longer than the file", name)};
      most = n > 0 ? most / n : most;
    }
    require_stored(set, name, std::accumulate(size.begin(), size.end(), hsize_t{sizeof(double)}, std::multiplies<>()));
    return size;
  }
  static void read(hid_t set, const char* name, double* values, bool empty) {
    if (!empty) readable(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  }
  hid_t at_;
  std::size_t bytes_;
};

}  // namespace railstrata::checkpoint_archive
