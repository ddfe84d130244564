#include "hdf5/table_image.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <array>
#include <sstream>
#include <string_view>

#include "hdf5/hdf5_handle.hpp"

namespace railstrata {
namespace {

constexpr const char *kUnits = "units", *kAxes = "axes", *kScaled = "scaled", *kStiffness = "creep_stiffness_";
constexpr std::size_t kGrowth = std::size_t{1} << 20, kMostPoints = 100'000'000;

struct Refused {};  // by HDF5

hid_t checked(hid_t id) {
  if (id < 0) throw Refused{};
  return id;
}

struct TableHandle : Hdf5Handle {
  TableHandle(hid_t id, Close close) : Hdf5Handle(checked(id), close) {}
};

/// HDF5 prints its stack of errors unless that is turned off.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

void add_text(hid_t at, const char* name, std::string_view text) {
  const TableHandle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
  checked(H5Tset_size(type, text.size() + 1));
  checked(H5Tset_cset(type, H5T_CSET_UTF8));
  const TableHandle attribute(H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, type, std::string(text).c_str()));
}

std::string text_of(hid_t at, const char* name) {
  const TableHandle attribute(H5Aopen(at, name, H5P_DEFAULT), H5Aclose), type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) throw Refused{};
  std::string out(H5Tget_size(type) + 1, '\0');
  checked(H5Aread(attribute, type, out.data()));
  return out.c_str();
}

/// Largest size, load, friction, and the ends of the spin.
using ScalingValues = std::array<double, 5>;

void add_values(hid_t at, const char* name, const ScalingValues& values) {
  const hsize_t size = values.size();
  const TableHandle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const TableHandle attribute(H5Acreate2(at, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checked(H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data()));
}

/// Of a table of before, the spins of which are not known: without the last two.
ScalingValues values_of(hid_t at, const char* name) {
  const TableHandle attribute(H5Aopen(at, name, H5P_DEFAULT), H5Aclose), space(H5Aget_space(attribute), H5Sclose);
  constexpr hssize_t kBefore = 3;
  ScalingValues out{};
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count != kBefore && count != static_cast<hssize_t>(out.size())) throw Refused{};
  checked(H5Aread(attribute, H5T_NATIVE_DOUBLE, out.data()));
  return out;
}

/// Without the time of day in it: the same table has the same bytes.
void add_numbers(hid_t file, const std::string& name, const std::string& unit, const std::vector<hsize_t>& size,
                 const std::vector<double>& values) {
  const TableHandle space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose),
      how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  checked(H5Pset_obj_track_times(how, false));
  const TableHandle set(H5Dcreate2(file, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose);
  checked(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  add_text(set, kUnits, unit);
}

void add_axis(hid_t file, const TableAxis& axis) {
  add_numbers(file, axis.name, axis.unit, {axis.at.size()}, axis.at);
  const TableHandle set(H5Dopen2(file, axis.name.c_str(), H5P_DEFAULT), H5Dclose);
  checked(H5DSset_scale(set, axis.name.c_str()));
}

/// What a scaled table has besides: ends of the asked axes, stiffnesses, in the attribute the ScalingValues.
void fill_scaling(hid_t file, const ForceTable& table, const TableScaling& scaling) {
  add_values(file, kScaled,
             {scaling.largest_size, scaling.load, scaling.friction, scaling.spin_low, scaling.spin_high});
  for (const TableAxis& axis : scaling.asked) add_axis(file, axis);
  std::vector<hsize_t> size;
  for (std::size_t k = kScaledAxes; k < table.axes.size(); ++k) size.push_back(table.axes[k].at.size());
  if (size.empty()) size.push_back(1);
  for (const TableNumber& k : scaling.stiffness) add_numbers(file, k.name, k.unit, size, k.values);
}

void fill(hid_t file, const ForceTable& table, const TableRemarks& remarks) {
  std::string names;
  std::vector<hsize_t> size;
  for (const TableAxis& axis : table.axes) {
    names += (names.empty() ? "" : ",") + axis.name;
    size.push_back(axis.at.size());
    add_axis(file, axis);
  }
  add_text(file, kAxes, names);
  for (const auto& [name, text] : remarks) add_text(file, name.c_str(), text);
  for (const TableNumber& number : table.numbers) {
    add_numbers(file, number.name, number.unit, size, number.values);
    const TableHandle set(H5Dopen2(file, number.name.c_str(), H5P_DEFAULT), H5Dclose);
    for (std::size_t k = 0; k < table.axes.size(); ++k) {
      const TableHandle scale(H5Dopen2(file, table.axes[k].name.c_str(), H5P_DEFAULT), H5Dclose);
      checked(H5DSattach_scale(set, scale, static_cast<unsigned>(k)));
    }
  }
  if (table.scaling) fill_scaling(file, table, *table.scaling);
}

std::string image_of(const ForceTable& table, const TableRemarks& remarks) {
  const TableHandle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  checked(H5Pset_fapl_core(access, kGrowth, 0));
  const TableHandle file(H5Fcreate("table", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  fill(file, table, remarks);
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL));
  std::string out(static_cast<std::size_t>(checked(H5Fget_file_image(file, nullptr, 0))), '\0');
  checked(H5Fget_file_image(file, out.data(), out.size()));
  return out;
}

std::vector<double> numbers_of(hid_t set) {
  const TableHandle space(H5Dget_space(set), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 1 || static_cast<std::size_t>(count) > kMostPoints) throw Refused{};
  std::vector<double> out(static_cast<std::size_t>(count));
  checked(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()));
  return out;
}

/// Every data set that is no axis, by name.
herr_t collect(hid_t group, const char* name, const H5L_info_t*, void* names) {
  const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
  if (object < 0) return -1;
  if (H5Iget_type(object) == H5I_DATASET && H5DSis_scale(object) == 0)
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  H5Oclose(object);
  return 0;
}

TableNumber number_in(hid_t file, const std::string& name) {
  const TableHandle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  return {name, text_of(set, kUnits), numbers_of(set)};
}

void read_scaling(hid_t file, ForceTable& table) {
  TableScaling& scaling = table.scaling.emplace();
  const auto [largest_size, load, friction, spin_low, spin_high] = values_of(file, kScaled);
  scaling.largest_size = largest_size;
  scaling.load = load;
  scaling.friction = friction;
  scaling.spin_low = spin_low;
  scaling.spin_high = spin_high;
  constexpr const char *kAsked[] = {"creepage_x", "creepage_y", "spin"}, *kOf[] = {"x", "y", "spin"};
  for (std::size_t k = 0; k < kScaledAxes; ++k) {
    const TableHandle set(H5Dopen2(file, kAsked[k], H5P_DEFAULT), H5Dclose);
    scaling.asked[k] = {kAsked[k], text_of(set, kUnits), numbers_of(set)};
    scaling.stiffness[k] = number_in(file, std::string(kStiffness) + kOf[k]);
  }
}

ForceTable table_in(hid_t file) {
  ForceTable out;
  std::istringstream axes(text_of(file, kAxes));
  for (std::string name; std::getline(axes, name, ',');) {
    const TableHandle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    out.axes.push_back({name, text_of(set, kUnits), numbers_of(set)});
  }
  std::vector<std::string> numbers;
  checked(H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &numbers));
  if (H5Aexists(file, kScaled) > 0) read_scaling(file, out);
  for (const std::string& name : numbers)
    if (!out.scaling || name.rfind(kStiffness, 0) != 0) out.numbers.push_back(number_in(file, name));
  return out;
}

}  // namespace

std::string table_image(const ForceTable& table, const TableRemarks& remarks) {
  const Quiet quiet;
  try {
    return image_of(table, remarks);
  } catch (const Refused&) {
    return {};
  }
}

std::optional<ForceTable> table_in_file(const std::filesystem::path& file) {
  const Quiet quiet;
  try {
    const TableHandle from(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    return table_in(from);
  } catch (const Refused&) {
    return std::nullopt;
  }
}

}  // namespace railstrata
