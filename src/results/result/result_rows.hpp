#pragma once
// How a row of the numbers of a result is written, and the groups of rows that result_table.cpp puts together.
#include <string_view>
#include <vector>

#include "result/result_table.hpp"

namespace railstrata::result_rows {

template <auto... Path>
double at(const Summary& s) {
  return (s.*....*Path);
}

// The forces of several patches close to 1e-6 of the load (docs/bem-theory.md), those that symmetry cancels to 1e-9:
// below 1e-7 of the normal force there is no result, nor in what follows from forces.
inline constexpr std::string_view kNormalForce = "/contact/normal_force_N";
inline constexpr RoundOff kOfTGamma{1e-12, kNormalForce};  // a creepage that is none times the normal force

/// Marks of a number: where it appears and which engine has it. None: in summary.json, from both engines.
enum Mark : unsigned { kColumn = 1, kShown = 2, kCompared = 4, kFem = 8, kBem = 16, kOfAll = 32 };
inline constexpr unsigned kFile = 0, kMain = kColumn | kShown | kCompared;

inline ResultNumber row(std::string_view symbol, const Unit& unit, double (*value)(const Summary&),
                        std::string_view label, std::string_view name, std::string_view doc, unsigned marks = kFile,
                        const RoundOff& round_off = {}) {
  ResultNumber out;
  static_cast<Column<Summary>&>(out) = {std::string(symbol), unit, value};
  out.label = label;
  out.name = name;
  out.doc = doc;
  out.engine = marks & kFem   ? AvailableIn::finite_elements
               : marks & kBem ? AvailableIn::half_spaces
                              : AvailableIn::both_engines;
  out.column = marks & kColumn;
  out.shown = marks & kShown;
  out.comparable = marks & kCompared;
  out.of_all_patches = marks & kOfAll;
  out.round_off = round_off;
  return out;
}

// Groups that may be absent: what a passage does to strengths, layers, surfaces and cracks.
std::vector<ResultNumber> shakedown_numbers();
std::vector<ResultNumber> layer_numbers();
std::vector<ResultNumber> damage_numbers();
std::vector<ResultNumber> life_numbers();
std::vector<ResultNumber> crack_numbers();
std::vector<ResultNumber> interface_numbers();

}  // namespace railstrata::result_rows
