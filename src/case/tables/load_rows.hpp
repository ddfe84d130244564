#pragma once
// Rows of a load collective as cases, and what they ask of the case around them.
//
//   wheel_load [kN], lateral_shift [mm], passages     keys of [[load]] with their units, also as wheel_load_kN;
//   110, 0, 250000                                    unit_table.hpp; an empty cell gives
//   85, -3, 100000                                    nothing: the case's value
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// The case of one row: what the row gives instead of the case's, without any rows.
CaseSpec with_load(const CaseSpec& spec, const LoadSpec& load);

/// The row's name, or "load 3".
std::string load_name(const CaseSpec& spec, std::size_t index);

/// Fills spec.loads from a table; one with a column of time or distance is a series of one wheel, in bins.
/// Returns a note about it; empty: nothing. `lines`: where the loads stand, none of bins. Throws CaseError with line
/// and remedy; `file` names it.
std::string read_load_table(const std::string& text, const std::filesystem::path& file, CaseSpec& spec,
                            std::vector<int>* lines = nullptr);

/// Records every broken rule of the rows of [[load]].
void check_loads(const CaseSpec& spec, CaseSource& source);

}  // namespace railstrata
