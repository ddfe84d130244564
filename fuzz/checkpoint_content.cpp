// Changed contents of a checkpoint, with a valid checksum, so that HDF5 reads them. First byte even: changes (place,
// place, value) of the bytes of its HDF5 part; odd: changes made by HDF5 (see edit()): all that the reader asks of
// HDF5.
#include <hdf5.h>
#include <stdlib.h>  // mkstemp
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "checkpoint_sample.hpp"
#include "reader.hpp"

using namespace railstrata;
using fuzz::Bytes;
using fuzz::promise;

/// HDF5 itself loses object headers of forged files, and keeps much for the next: what counts is that the reader leaves
/// nothing open (see leaves_nothing_open()).
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace {

constexpr std::size_t kHeader = 512;

/// HDF5 gives its large blocks back to the system at every close; kept, an input takes a third of the time.
[[maybe_unused]] const herr_t kKeepsBlocks = H5set_free_list_limits(-1, -1, -1, -1, -1, -1);

/// A file outside the checkpoint, for links and storage that lead there: one of this process, since HDF5 writes to it.
const std::string& decoy() {
  static const struct Decoy {
    std::string path = (std::filesystem::temp_directory_path() / "railstrata-fuzz-XXXXXX").string();
    Decoy() {
      const int file = mkstemp(path.data());
      promise(file >= 0 && write(file, "outside", 7) == 7 && close(file) == 0, "a scratch file can be made");
    }
    ~Decoy() { std::remove(path.c_str()); }
    Decoy(const Decoy&) = delete;
    Decoy& operator=(const Decoy&) = delete;
  } file;
  return file.path;
}

/// The HDF5 part of a small checkpoint, and the names of all datasets in it.
struct Base {
  std::string image = fuzz::sample_checkpoint().substr(kHeader);
  std::vector<std::string> names;
};

hid_t open_image(std::string& image, unsigned access_flags) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 16, 0);
  H5Pset_file_image(access, image.data(), image.size());
  const hid_t file = H5Fopen("checkpoint", access_flags, access);
  H5Pclose(access);
  return file;
}

const Base& base() {
  static const Base made = [] {
    Base b;
    const hid_t file = open_image(b.image, H5F_ACC_RDONLY);
    H5Ovisit2(
        file, H5_INDEX_NAME, H5_ITER_INC,
        [](hid_t, const char* name, const H5O_info_t*, void* names) {
          if (name[0] != '.') static_cast<std::vector<std::string>*>(names)->emplace_back(name);
          return herr_t{0};
        },
        &b.names, H5O_INFO_BASIC);
    H5Fclose(file);
    return b;
  }();
  return made;
}

double odd_number(unsigned byte) {
  constexpr std::array kOdd{std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity(),
                            -1.0,
                            -0.5,
                            0.0,
                            0.5,
                            1.0,
                            2.0,
                            3.0,
                            1e5,
                            2147483648.0,
                            -2147483649.0,
                            4294967296.0,
                            9.3e18,
                            -9.3e18,
                            1.9e19,
                            1e300};
  return byte < kOdd.size() ? kOdd[byte] : static_cast<double>(byte) - 128;
}

hsize_t odd_size(unsigned byte) { return byte < 200 ? byte % 20 : hsize_t{1} << (byte - 200) % 64; }

/// One change of what stands in the file: another value, shape, type or storage of an array, a link elsewhere, nothing
/// at all.
void edit(hid_t file, Bytes& in) {
  const std::vector<std::string>& names = base().names;
  const unsigned what = in.next() % 8;
  const char* name = names[in.next() % names.size()].c_str();
  if (what == 0) {  // other values
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    if (set < 0) return;
    const hid_t space = H5Dget_space(set);
    if (const hssize_t n = H5Sget_simple_extent_npoints(space); n > 0 && n < 1000) {
      std::vector<double> values(static_cast<std::size_t>(n));
      H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values[in.next() % values.size()] = odd_number(in.next());
      H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }
    H5Sclose(space);
    H5Dclose(set);
    return;
  }
  H5Ldelete(file, name, H5P_DEFAULT);
  if (what == 1) return;
  if (what == 2) {
    if (const hid_t group = H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT); group >= 0) H5Gclose(group);
    return;
  }
  const char* other = names[in.next() % names.size()].c_str();
  if (what == 3) {
    H5Lcreate_soft(other, file, name, H5P_DEFAULT, H5P_DEFAULT);
    return;
  }
  if (what == 4) {
    H5Lcreate_external(decoy().c_str(), other, file, name, H5P_DEFAULT, H5P_DEFAULT);
    return;
  }
  std::array<hsize_t, 3> size{};
  const int rank = static_cast<int>(in.next() % 4);
  for (hsize_t& n : size) n = odd_size(in.next());
  const hid_t space =
      rank == 0 ? H5Screate(in.next() % 2 ? H5S_NULL : H5S_SCALAR) : H5Screate_simple(rank, size.data(), nullptr);
  const unsigned kind = in.next() % 5;
  const hid_t type = kind == 0 ? H5Tcopy(H5T_C_S1)
                               : H5Tcopy(kind == 1   ? H5T_IEEE_F64LE
                                         : kind == 2 ? H5T_STD_I32LE
                                         : kind == 3 ? H5T_C_S1
                                                     : H5T_IEEE_F32BE);
  if (kind == 0) H5Tset_size(type, H5T_VARIABLE);
  if (kind == 3) H5Tset_size(type, std::max<std::size_t>(1, odd_size(in.next())));
  const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
  const unsigned storage = in.next() % 4;
  if (storage == 1 && rank > 0) {
    std::array<hsize_t, 3> chunk{4, 4, 4};
    H5Pset_chunk(how, rank, chunk.data());
    if (in.next() % 2) H5Pset_deflate(how, 1);
  }
  if (storage == 2) H5Pset_layout(how, H5D_COMPACT);
  if (storage == 3) H5Pset_external(how, decoy().c_str(), 0, H5F_UNLIMITED);
  if (const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT); set >= 0) H5Dclose(set);
  H5Pclose(how);
  H5Tclose(type);
  H5Sclose(space);
}

std::string edited_image(Bytes in) {
  std::string image = base().image;
  const hid_t file = open_image(image, H5F_ACC_RDWR);
  promise(file >= 0, "the sample opens");
  for (int n = 0; n < 8 && !in.empty(); ++n) edit(file, in);
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size > 0) image.assign(static_cast<std::size_t>(size), '\0');
  if (size > 0) H5Fget_file_image(file, image.data(), image.size());
  H5Fclose(file);
  return image;
}

/// An accepted state can be saved and is read back unchanged.
void check(const Checkpoint& c) {
  const std::string kept = checkpoint_bytes(c.origin, c.run);
  const Checkpoint again = checkpoint_of(kept, "again");
  promise(checkpoint_bytes(again.origin, again.run) == kept, "an accepted checkpoint keeps its bits");
}

/// Files, arrays, types, shapes, lists of properties: as many as before.
void leaves_nothing_open() {
  static const auto open = [] {
    hsize_t all = 0;
    for (const H5I_type_t kind :
         {H5I_FILE, H5I_GROUP, H5I_DATATYPE, H5I_DATASPACE, H5I_DATASET, H5I_ATTR, H5I_GENPROP_LST}) {
      hsize_t n = 0;
      H5Inmembers(kind, &n);
      all += n;
    }
    return all;
  };
  static const hsize_t before = open();
  promise(open() == before, "the reader leaves nothing open");
}

}  // namespace

// HDF5 asks the heap for the sizes in a forged file; where the system's heap would refuse, the sanitizers' are to
// refuse too, and not to end the program.
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1"; }
extern "C" const char* __tsan_default_options() { return "allocator_may_return_null=1"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string& sample = base().image;
  if (size == 0) return 0;
  leaves_nothing_open();
  const Bytes rest(fuzz::text_of(data + 1, size - 1));
  std::string image = data[0] % 2 ? edited_image(rest) : sample;
  if (data[0] % 2 == 0) fuzz::change(image, rest);
  fuzz::accepts([&] { check(checkpoint_of(sealed_checkpoint(image), "checkpoint.h5")); });
  leaves_nothing_open();
  return 0;
}
