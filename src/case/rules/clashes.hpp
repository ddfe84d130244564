#pragma once
// What excludes what: one table (clashes.cpp) of pairs of features of a case, and of features that an engine or a
// command does not support. Refusals, notes on settings without effect, the page docs/exclusions.md and the controls
// that the explorer switches off come from it.
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/faults.hpp"
#include "rules/idle_setting.hpp"
#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// What a case may be used for: an engine or a command.
struct Use {
  std::string_view name;                     ///< after "is not supported by"
  const Use* part_of = nullptr;              ///< a wider use, whose rules hold too
  bool (*comes)(const CaseSpec&) = nullptr;  ///< set: the wider use brings this one for such a case
  /// By name: every shared library has its own copies of these constants.
  bool is(const Use& wider) const { return name == wider.name || (part_of && part_of->is(wider)); }
};

namespace uses {

inline constexpr Use kAny{"any use"}, kFiniteElements{"the finite elements"}, kHalfSpaces{"half-spaces"},
    kRanks{"several ranks"}, kReceptance{"a receptance", &kFiniteElements};
/// Elements and half-spaces of a case that rolls; the latter without a history in time.
extern const Use kRollingElements, kSteadyRolling;
inline constexpr Use kRolledPasses{"passes by finite elements", &kRollingElements},
    kElasticShakedown{"shakedown by finite elements", &kFiniteElements},
    kDeck{"a deck for another program", &kFiniteElements}, kPasses{"passes by half-spaces", &kSteadyRolling};
inline constexpr Use kCreepCurve{"a creep curve", &kSteadyRolling}, kCreepTable{"a creep table", &kSteadyRolling},
    kScaledTable{"a scaled creep table", &kCreepTable}, kCollective{"`railstrata collective`", &kSteadyRolling},
    kWearLoop{"the wear loop", &kCollective}, kExplorer{"the explorer", &kHalfSpaces};
inline constexpr Use kStates{"a contact that is solved state by state", &kHalfSpaces},
    kWheelset{"a wheelset", &kStates}, kContactResult{"a result for CONTACT", &kHalfSpaces},
    kContactInput{"an input file of CONTACT", &kContactResult};

}  // namespace uses

using Keys = std::vector<std::string>;

/// Something that a case may have. Without a function: another value than the default at a key, or this value
/// (run.device = "gpu"); an entry of a list of tables (stretch); any key of a table that the text gives (track). Keys
/// of layers count by layer, those of "*." in rail, wheel and layers; alternatives stand with " | " between them.
struct Feature {
  std::string_view key;
  bool (*has)(const CaseSpec&) = nullptr;                      ///< instead
  std::string_view name = {};                                  ///< in words, where the key does not say it
  Keys (*keys)(const CaseSpec&, const CaseSource*) = nullptr;  ///< instead, with the keys
  const Use* use = nullptr;                                    ///< a use in place of a feature
  // NOLINTNEXTLINE(google-explicit-constructor): rows of the table have keys and uses as they are
  constexpr Feature(const char* at) : key(at) {}
  // NOLINTNEXTLINE(google-explicit-constructor)
  constexpr Feature(const Use& of) : name(of.name), use(&of) {}
  constexpr Feature(const char* at, bool (*test)(const CaseSpec&), std::string_view words = {})
      : key(at), has(test), name(words) {}
  constexpr Feature(const char* at, Keys (*find)(const CaseSpec&, const CaseSource*), std::string_view words = {})
      : key(at), name(words), keys(find) {}
};

enum class ClashRule {
  excludes,      ///< a and b together are refused
  needs,         ///< a without b is refused
  idle_with,     ///< a has no effect with b: a note
  idle_without,  ///< a has no effect without b: a note
  overlooked     ///< the use b does not look at a, without a note
};

/// A row of the table.
struct Clash {
  Feature a;
  ClashRule rule;
  Feature b;
  const char *why, *remedy;
  const Use* in = nullptr;  ///< the use in which two features of a case clash; null: all
  /// The use that the row is about; null: any.
  const Use* of() const { return in ? in : a.use ? a.use : b.use; }
};
std::span<const Clash> clash_table();

/// Records in `source` the features of the case that exclude or lack each other.
void check_clashes(const CaseSpec& spec, CaseSource& source);

std::vector<IdleSetting> idle_settings(const CaseSpec& spec, const CaseSource* source = nullptr);
/// Settings without effect in a use.
std::vector<std::string> idle_in(const Use& use, const CaseSpec& spec);
/// Whether this use, or any (null), does not look at a feature, so that nothing is idle by it.
bool overlooked(const Feature& feature, const Use* by = nullptr);

/// Keys that would be refused or without effect if this case were given them for this use, and why.
std::map<std::string, std::string> excluded_keys(const Use& use, const CaseSpec& spec);

/// The table as a page in Markdown.
std::string exclusions_markdown();

}  // namespace railstrata
