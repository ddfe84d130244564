#pragma once
// Handles, which are addresses of the objects that they stand for; structs, filled and read by the lists of the records
// that they stand for: numbers in the order of the list, one after the other (tests/capi holds the lists against
// railstrata.h).
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "ask/contact.hpp"
#include "ask/named.hpp"
#include "ask/wheelset.hpp"
#include "capi/railstrata.h"
#include "core/faults.hpp"

namespace railstrata::capi {

inline rs_contact* handle_of(Contact* contact) { return reinterpret_cast<rs_contact*>(contact); }
inline rs_wheelset* handle_of(Wheelset* set) { return reinterpret_cast<rs_wheelset*>(set); }

/// Throws CaseError: NULL.
inline Contact& contact_of(rs_contact* handle) {
  if (!handle) throw CaseError("the contact is NULL", "make one with rs_contact_new");
  return *reinterpret_cast<Contact*>(handle);
}
inline const Contact& contact_of(const rs_contact* handle) { return contact_of(const_cast<rs_contact*>(handle)); }
inline Wheelset& wheelset_of(rs_wheelset* handle) {
  if (!handle) throw CaseError("the wheelset is NULL", "make one with rs_wheelset_new");
  return *reinterpret_cast<Wheelset*>(handle);
}

/// Overrides "key=value". Throws CaseError: a text is NULL.
std::vector<std::string> overrides_of(const char* const* overrides, int count);

/// Throws CaseError: a NULL that must not be.
inline void require(bool given, const char* what, const char* remedy) {
  if (!given) throw CaseError(fmt::format("{} is NULL", what), remedy);
}

/// Throws CaseError: the struct is of another version.
template <class Struct>
void require_size(const Struct& s, const char* name) {
  if (s.size != sizeof(Struct))
    throw CaseError(fmt::format("{}.size = {} is of another version of the library", name, s.size),
                    fmt::format("set size = sizeof({}), and compile with this version's railstrata.h", name));
}

/// Numbers of a struct from a place in it on.
struct Writer {
  char* at;
  void operator()(double value) { copy(value); }
  void operator()(int value) { copy(value); }
  void operator()(bool value) { copy(static_cast<int>(value)); }
  void operator()(Vec2 value) { copy(std::array{value.y, value.z}); }
  void operator()(Vec3 value) { copy(std::array{value.x, value.y, value.z}); }
  template <class T>
  void copy(T value) {
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
  }
};

/// Writes the members of a record into a struct, from `offset` on.
template <class Rows, class Record, class Struct>
void fill(const Rows& rows, const Record& record, Struct& out, std::size_t offset) {
  Writer write{reinterpret_cast<char*>(&out) + offset};
  for (const auto& row : rows) with_member(row, record, write);
}

/// Numbers of a struct from a place in it on; of optional ones those whose bits are given, in their order.
struct Reader {
  const char* at;
  unsigned given, bit = 1;
  double next() {
    double out = 0;
    std::memcpy(&out, at, sizeof out);
    at += sizeof out;
    return out;
  }
  void operator()(double& value) { value = next(); }
  void operator()(std::optional<double>& value) {
    if (const double number = next(); given & bit) value = number;
    bit <<= 1;
  }
  void operator()(std::array<double, 2>& values) {
    for (double& value : values) value = next();
  }
};

}  // namespace railstrata::capi
