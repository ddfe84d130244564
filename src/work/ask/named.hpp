#pragma once
// The numbers of a record in one list: what the C interface, Fortran and Python have of it follows from that.
#include <variant>

namespace railstrata {

/// A number of a record, or some of one name, SI, by a pointer to a member of one of the types.
template <class Record, class... Types>
struct Named {
  const char *name, *unit;
  std::variant<Types Record::*...> at;
};

/// Calls f with the member of the record that a row names; rows may have a plain pointer to a member.
template <class Row, class Record, class F>
void with_member(const Row& row, Record& record, F&& f) {
  if constexpr (requires { record.*row.at; })
    f(record.*row.at);
  else
    std::visit([&](auto at) { f(record.*at); }, row.at);
}

}  // namespace railstrata
