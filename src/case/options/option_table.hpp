#pragma once
// The keys of a case file: one table per option struct of spec/case_spec.hpp. The reader, the range check, "did you
// mean", the resolved case, the JSON schema and the reference page all come from these tables, so that a new option is
// one member in case_spec.hpp and one row here.
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "spec/case_spec.hpp"
#include "text/units.hpp"

namespace railstrata {

/// A member of an enum type: the place of an option that is one of several words.
class ChoiceSlot {
 public:
  template <class Enum>
  explicit ChoiceSlot(Enum& member)
      : member_(&member),
        read_([](const void* m) { return static_cast<int>(*static_cast<const Enum*>(m)); }),
        write_([](void* m, int value) { *static_cast<Enum*>(m) = static_cast<Enum>(value); }) {}
  /// One of several kinds: the value is the number of the kind, which begins with its defaults.
  template <class... Kinds>
  explicit ChoiceSlot(std::variant<Kinds...>& member)
      : member_(&member),
        read_([](const void* m) { return static_cast<int>(static_cast<const std::variant<Kinds...>*>(m)->index()); }),
        write_([](void* m, int value) {
          const std::array<std::variant<Kinds...>, sizeof...(Kinds)> all{Kinds{}...};
          *static_cast<std::variant<Kinds...>*>(m) = all.at(static_cast<std::size_t>(value));
        }) {}
  int operator*() const { return read_(member_); }  ///< as of the pointers beside it in Slot
  void set(int value) const { write_(member_, value); }
  friend bool operator==(const ChoiceSlot& a, const ChoiceSlot& b) { return a.member_ == b.member_; }

 private:
  void* member_;
  int (*read_)(const void*);
  void (*write_)(void*, int);
};

/// A member that is a table, by depth or of named numbers: a list or an optional of rows, of a type whose numbers
/// `columns(row)` lists.
class RowsSlot {
 public:
  using Rows = std::vector<std::vector<double>>;
  template <class Table>
  requires requires { typename Table::value_type; }
  explicit RowsSlot(Table& member) : member_(&member), read_(read<Table>), write_(write<Table>) {}
  Rows operator*() const { return read_(member_); }
  void set(const Rows& rows) const { write_(member_, rows); }
  friend bool operator==(const RowsSlot& a, const RowsSlot& b) { return a.member_ == b.member_; }

 private:
  template <class Table>
  static constexpr bool kIsList = requires(Table& table) {
    table.clear();
  };
  template <class Table>
  static Rows read(const void* member) {
    const auto& table = *static_cast<const Table*>(member);
    Rows out;
    const auto add = [&](typename Table::value_type row) {
      std::vector<double>& numbers = out.emplace_back();
      for (const double* number : columns(row)) numbers.push_back(*number);
    };
    if constexpr (kIsList<Table>)
      for (const auto& row : table) add(row);
    else if (table)
      add(*table);
    return out;
  }
  template <class Table>
  static void write(void* member, const Rows& rows) {
    Table out;
    for (const std::vector<double>& numbers : rows) {
      typename Table::value_type row;
      std::size_t k = 0;
      for (double* number : columns(row)) *number = numbers.at(k++);
      if constexpr (kIsList<Table>)
        out.push_back(row);
      else
        out = row;
    }
    *static_cast<Table*>(member) = out;
  }
  void* member_;
  Rows (*read_)(const void*);
  void (*write_)(void*, const Rows&);
};

/// Where an option lives in a case, by type. A double or a list of doubles is a quantity of the option's dimension, in
/// SI; an optional one has no default, the case is another one without it; a table by depth has rows of the option's
/// columns.
using Slot = std::variant<double*, std::optional<double>*, int*, bool*, std::string*, ChoiceSlot, std::vector<double>*,
                          RowsSlot>;

/// A word of a case file and the value of the option's enum that it stands for.
struct Choice {
  std::string_view word;
  int value;
};

/// Allowed values of a number, ends included unless `open` (then min itself is refused).
struct Range {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  bool open = false;
  bool holds(double v) const { return (open ? v > min : v >= min) && v <= max; }
};

/// A second way of giving another option's slot: young_ratio, a multiple of the body's modulus, gives young; wheel_load
/// gives the sprung mass.
struct Derivation {
  /// The slot's value for the number written, SI; all other options are read by then.
  double (*value)(const CaseSpec&, std::size_t index, double written) = nullptr;
  std::string_view remedy = "choose a value that does";  ///< of a value that the slot must not have
  explicit operator bool() const { return value != nullptr; }
};

/// How a case writes the rows of a RowsSlot. By depth or value: in lists, the first column in order.
enum class RowForm {
  by_depth,  ///< [["0 mm", "400 MPa"], ["5 mm", "300 MPa"]]
  by_value,  ///< the same from anywhere on: [["-20 mm", 0.2], ["10 mm", 0.4]]
  ranges,    ///< [["180 mm", "192 mm"]]: from and to, one after the other
  named,     ///< [{ modulus = "60 GPa", recall = 250 }]: the keys are those of the columns
  one_named  ///< { saturation = "80 MPa", rate = 12 }
};
inline bool has_named_columns(RowForm form) { return form == RowForm::named || form == RowForm::one_named; }

struct Option {
  std::string_view key;
  Slot (*slot)(CaseSpec&, std::size_t index);  ///< index: which element of a list of tables ([[layer]]); else unused
  std::string_view doc;                        ///< one line, as on the reference page
  Dimension dimension{};
  Range range{};
  std::vector<Choice> choices{};  ///< of a ChoiceSlot, the only place where its words stand
  Derivation derivation{};
  /// Set for an option that only some cases have (the thickness of a layer, unless a table gives it): whether this case
  /// does. Else the resolved case leaves it out.
  bool (*applies)(const CaseSpec&, std::size_t index) = nullptr;
  std::string_view beyond{};  ///< advice for a value out of the range
  /// For a table by depth: the numbers of a row, the depth first; its `doc` gives where depth 0 is.
  std::vector<Option> columns{};
  std::string_view example{};  ///< of a list or a table by depth
  RowForm form = RowForm::by_depth;
  bool takes_mass = false;  ///< of one force: a mass stands for its weight
  bool first = false;       ///< read before the others, whose places depend on it

  /// The same option with one thing more, for the rows of the tables.
  template <auto Member, class Value>
  Option with(const Value& value) const {
    Option out = *this;
    out.*Member = value;
    return out;
  }
  Option where(bool (*condition)(const CaseSpec&, std::size_t)) const { return with<&Option::applies>(condition); }
  Option derived(const Derivation& from) const { return with<&Option::derivation>(from); }
  Option or_mass() const { return with<&Option::takes_mass>(true); }
  Option with_remedy(std::string_view text) const { return with<&Option::beyond>(text); }
  Option with_example(std::string_view text) const { return with<&Option::example>(text); }
  Option with_rows(RowForm of, const std::vector<Option>& numbers, std::string_view text) const {
    return with_example(text).with<&Option::form>(of).with<&Option::columns>(numbers);
  }
};

/// For a list of tables: the number in a case, and how to change it.
struct TableList {
  std::size_t (*count)(const CaseSpec&) = nullptr;
  void (*resize)(CaseSpec&, std::size_t) = nullptr;
  explicit operator bool() const { return count != nullptr; }
};

struct OptionTable {
  std::string_view name;  ///< "geometry", "material.rail", "layer"
  std::string_view doc;
  std::vector<Option> options;
  TableList repeated{};  ///< set for [[name]], any number of times
  /// Groups of keys for the same quantity: a case gives at most one of each.
  std::vector<std::vector<std::string_view>> rivals{};
};

/// The allowed words of an option with choices, in the table's order.
std::vector<std::string> choices_of(const Option& option);

/// All tables, in the order of the reference page and of a resolved case.
const std::vector<OptionTable>& case_tables();

/// The table of a name; null if there is none.
const OptionTable* find_table(std::string_view name);

/// The default case with one entry in every list of tables, so that each option has a place.
CaseSpec one_of_each();

/// The option's place in some case, for its type of value.
Slot any_slot(const Option& option);

/// A text in quotes as TOML reads it back; control characters are escaped.
std::string toml_quoted(std::string_view text);

/// A value as text that the case file's reader turns back into the same value: "2 mm" in quotes, 3, true, ["0.3 m"].
/// Empty for an optional one that is not given and for a list without values.
std::string toml_value(const Option& option, CaseSpec& spec, std::size_t index);

/// "between 0.05 mm and 10 mm", "above 0 s and at most 1 s"; empty when everything is allowed.
std::string describe(const Range& range, const Dimension& dimension);

}  // namespace railstrata
