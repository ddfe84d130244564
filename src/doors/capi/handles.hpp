#pragma once
// Handles are addresses of the objects that they stand for.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "ask/contact.hpp"
#include "ask/wheelset.hpp"
#include "capi/railstrata.h"

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

}  // namespace railstrata::capi
