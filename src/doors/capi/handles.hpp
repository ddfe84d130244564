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
#include <type_traits>
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

inline const Wheelset& wheelset_of(const rs_wheelset* handle) { return wheelset_of(const_cast<rs_wheelset*>(handle)); }

/// The point that moments are about; NULL: none.
inline std::optional<Vec3> point_of(const double* about) {
  return about ? std::optional(Vec3{about[0], about[1], about[2]}) : std::nullopt;
}

/// Overrides "key=value". Throws CaseError: a text is NULL.
std::vector<std::string> overrides_of(const char* const* overrides, int count);

/// Throws CaseError: a NULL that must not be.
inline void require(bool given, const char* what, const char* remedy) {
  if (!given) throw CaseError(fmt::format("{} is NULL", what), remedy);
}

/// Size of a struct in 0.4.0, the first version whose structs are taken. A struct that has grown since has a line
/// below.
template <class Struct>
inline constexpr std::size_t kFirstSize = sizeof(Struct);
template <>
inline constexpr std::size_t kFirstSize<rs_wheelset_state> = offsetof(rs_wheelset_state, wheel_pitch_rate);

template <>
inline constexpr std::size_t kFirstSize<rs_forces> = offsetof(rs_forces, beyond);
template <>
inline constexpr std::size_t kFirstSize<rs_wheelset_forces> = offsetof(rs_wheelset_forces, beyond);

/// The caller's struct has `beyond`: else an answer that is would not be seen as such.
template <class Struct>
bool shows_beyond(const Struct& s) {
  return s.size > offsetof(Struct, beyond);
}

/// Throws CaseError: the struct is larger than that of this library, or smaller than the first one.
template <class Struct>
void require_size(const Struct& s, const char* name) {
  if (s.size < kFirstSize<Struct> || s.size > sizeof(Struct) || s.size % alignof(Struct) != 0)
    throw CaseError(
        fmt::format("{}.size = {}; this library takes {} to {}", name, s.size, kFirstSize<Struct>, sizeof(Struct)),
        fmt::format("set size = sizeof({}), and use a library as new as your railstrata.h", name));
}

/// A struct of the caller's; members that an older one lacks are 0. Throws CaseError: its size.
template <class Struct>
Struct taken(const Struct& given, const char* name) {
  require_size(given, name);
  Struct out{};
  std::memcpy(&out, &given, given.size);
  return out;
}

/// Writes as much as the caller's struct, whose size was looked at, has room for.
template <class Struct>
void give(Struct found, Struct& out) {
  found.size = out.size;
  std::memcpy(&out, &found, found.size);
}

/// Element k of an array of structs, which lie apart by the size that the caller knows.
template <class Struct>
Struct& element(Struct* first, std::size_t k) {
  using Byte = std::conditional_t<std::is_const_v<Struct>, const char, char>;
  return *reinterpret_cast<Struct*>(reinterpret_cast<Byte*>(first) + k * first->size);
}

/// Throws CaseError: not all elements of an array have the size of the first, which is that of a version.
template <class Struct>
void require_sizes(const Struct* all, std::size_t n, const char* name) {
  for (std::size_t k = 0; k < n; ++k) {
    if (k == 0) require_size(*all, name);
    if (element(all, k).size != all->size)
      throw CaseError(fmt::format("{}.size of element {} is not that of the first", name, k),
                      fmt::format("set size = sizeof({}) of every one", name));
  }
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

inline rs_patch in_c(const PatchForces& forces) {
  rs_patch out{};
  fill(kPatchForces, forces, out, offsetof(rs_patch, force));
  return out;
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
