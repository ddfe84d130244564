// Case files, after a first byte 2 inputs of CONTACT, and the overrides of the command line: the file, then after a
// byte 1 an override a line.
#include "reader/case_file.hpp"

#include <algorithm>
#include <sstream>

#include "many/axis.hpp"
#include "options/option_table.hpp"
#include "reader.hpp"
#include "tables/contact_input.hpp"

using namespace railstrata;
using fuzz::promise;

namespace {

struct InBounds {
  const Option& option;
  bool operator()(const double* v) const { return option.range.holds(*v); }
  bool operator()(const int* v) const { return option.range.holds(*v); }
  bool operator()(const bool*) const { return true; }
  bool operator()(const std::string*) const { return true; }
  bool operator()(const ChoiceSlot& v) const {
    return std::any_of(option.choices.begin(), option.choices.end(), [&](const Choice& c) { return c.value == *v; });
  }
  bool operator()(const std::optional<double>* v) const { return !*v || option.range.holds(**v); }
  bool operator()(const std::vector<double>* v) const {
    return std::all_of(v->begin(), v->end(), [&](double x) { return option.range.holds(x); });
  }
  bool operator()(const RowsSlot& v) const {
    for (const std::vector<double>& row : *v)
      for (std::size_t k = 0; k < row.size(); ++k)
        if (!option.columns.at(k).range.holds(row[k])) return false;
    return true;
  }
};

template <class Visit>
void each_option(CaseSpec& spec, Visit&& visit) {
  for (const OptionTable& table : case_tables())
    for (std::size_t i = 0; i < (table.repeated ? table.repeated.count(spec) : 1); ++i)
      for (const Option& option : table.options)
        if (!option.derivation && (!option.applies || option.applies(spec, i))) visit(option, i);
}

void check(LoadedCase& loaded) {
  each_option(loaded.spec, [&](const Option& option, std::size_t i) {
    promise(std::visit(InBounds{option}, option.slot(loaded.spec, i)), "an accepted case is within its bounds");
  });
  LoadedCase again = parse_case(loaded.resolved_toml, loaded.file);
  promise(again.spec.layers.size() == loaded.spec.layers.size(), "the resolved case has the same layers");
  each_option(loaded.spec, [&](const Option& option, std::size_t i) {
    const Slot a = option.slot(loaded.spec, i), b = option.slot(again.spec, i);
    const bool same = std::visit([&](auto value) { return *value == *std::get<decltype(value)>(b); }, a);
    promise(same, "the resolved case reads back to the same case");
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view all = fuzz::text_of(data, size);
  const std::size_t cut = std::min(all.find('\1'), all.size());
  std::vector<std::string> overrides;
  std::istringstream lines{std::string(all.substr(std::min(cut + 1, all.size())))};
  for (std::string line; std::getline(lines, line);) overrides.push_back(line);

  LoadedCase loaded;
  const bool accepted = fuzz::accepts([&] {
    std::string text(all.substr(0, cut));
    if (text.starts_with('\2')) text = read_contact_input(text.substr(1), {"wheel.inp", 0}).case_text;
    loaded = parse_case(text, "case.toml", overrides);
  });
  try {
    if (accepted) check(loaded);
  } catch (const CaseError&) {
    promise(false, "the resolved case is a case");
  }
  if (!overrides.empty()) fuzz::accepts([&] { combinations(parse_axes("--vary", overrides)); });
  return 0;
}
