#pragma once
// Handles of HDF5, closed by their destructors.
#include <hdf5.h>

namespace railstrata {

/// A file, array, type or space of HDF5, closed with it. The caller checks for errors of HDF5 (negative numbers) first:
/// the number given here is valid.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() { close_(id_); }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): stands in for the number

 private:
  hid_t id_;
  Close close_;
};

}  // namespace railstrata
