#pragma once
// What the files of options have in common: how the rows of the tables name their place in a case, and the tables.
#include <initializer_list>
#include <string_view>
#include <type_traits>

#include "options/option_table.hpp"

namespace railstrata::option_slot {

/// Whether an option applies: one that never does is read and not written out.
inline bool never(const CaseSpec&, std::size_t) { return false; }

/// A list or an optional of rows that are described by their columns.
template <class T>
concept HasRows = requires(typename T::value_type& row) {
  columns(row);
};

template <class T>
Slot slot_of(T& member) {
  if constexpr (std::is_enum_v<T> || requires { std::variant_size<T>::value; })
    return ChoiceSlot(member);
  else if constexpr (HasRows<T>)
    return RowsSlot(member);
  else
    return &member;
}
/// A member of a table that stands once in a case, by the members on the way to it.
template <auto... Path>
Slot at(CaseSpec& spec, std::size_t) {
  return slot_of((spec.*....*Path));
}
/// The same for an entry of a list of tables.
template <auto List, auto... Path>
Slot entry(CaseSpec& spec, std::size_t index) {
  return slot_of(((spec.*List).at(index).*....*Path));
}
template <auto... Path>
inline constexpr auto layer = entry<&CaseSpec::layers, Path...>;
template <auto List>
TableList list_of() {
  return {[](const CaseSpec& spec) { return (spec.*List).size(); },
          [](CaseSpec& spec, std::size_t n) { (spec.*List).resize(n); }};
}

/// A row of a table; further properties are added by .where(…), .derived(…), ….
inline Option option(std::string_view key, Slot (*slot)(CaseSpec&, std::size_t), std::string_view doc,
                     const Dimension& dimension = {}, const Range& range = {}) {
  return {.key = key, .slot = slot, .doc = doc, .dimension = dimension, .range = range};
}
/// A number in the rows of a table by depth or of named numbers.
inline Option column(std::string_view key, std::string_view doc, const Dimension& dimension, const Range& range) {
  return option(key, nullptr, doc, dimension, range);
}
inline void append(std::vector<Option>& to, const std::vector<Option>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

template <class Struct, class T>
T type_of(T Struct::*);
/// A word and the value it stands for, of the same enum as the member.
template <auto Member>
struct Word {
  std::string_view word;
  decltype(type_of(Member)) value;
};
template <auto Member>
Option choice(std::string_view key, Slot (*slot)(CaseSpec&, std::size_t), std::string_view doc,
              std::initializer_list<Word<Member>> words) {
  Option out = option(key, slot, doc);
  for (const Word<Member>& w : words) out.choices.push_back({w.word, static_cast<int>(w.value)});
  return out;
}
/// One of several words in a table that stands once in a case.
template <auto Part, auto Member>
Option choice_at(std::string_view key, std::string_view doc, std::initializer_list<Word<Member>> words) {
  return choice<Member>(key, at<Part, Member>, doc, words);
}

/// The word of a body, in a table of a list.
template <auto Member>
Option body_choice(Slot (*slot)(CaseSpec&, std::size_t), std::string_view doc) {
  return choice<Member>("on", slot, doc,
                        {{body_word(BodyId::rail), BodyId::rail}, {body_word(BodyId::wheel), BodyId::wheel}});
}

inline Range above(double min, double max = std::numeric_limits<double>::infinity()) { return {min, max, true}; }

}  // namespace railstrata::option_slot

namespace railstrata {

/// The tables of the keys, a function each; case_tables() puts them together.
OptionTable geometry_table();
OptionTable rail_material_table();
OptionTable wheel_material_table();
OptionTable layer_table();
OptionTable stretch_table();
OptionTable irregularity_table();
OptionTable vehicle_table();
OptionTable track_table();
OptionTable drive_table();
OptionTable friction_table();
OptionTable third_body_table();
OptionTable mesh_table();
OptionTable run_table();
OptionTable bem_table();
OptionTable transient_table();
OptionTable curve_table();
OptionTable bogie_table();
OptionTable load_table();
OptionTable collective_table();
OptionTable crack_table();
OptionTable life_table();
OptionTable grinding_table();
OptionTable passes_table();
OptionTable output_table();

}  // namespace railstrata
