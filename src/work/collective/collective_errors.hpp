#pragma once
// Errors of the answers of a load collective: what the cells of its contacts leave uncertain.
//
// The loads that decide are solved once more on cells r = 2 and 4 times as large, the others stay; the same sums of
// them give each number once more. A number f with f_r there is taken to be of first order:
//
//   ± = max over r of grid_bar(f - f_r, r) / share     (passes/pass_errors.hpp),
//
// with the share of the friction energy of all loads that the deciding ones have. What cancels between loads is no
// accuracy: sums have at least the mean relative bar of the loads' friction energy, the largest pressure the largest
// relative one of the loads' pressures, and that of their contacts (judge/cell_errors.hpp). Places have a cell of the
// profile more.
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "collective/collective_files.hpp"

namespace railstrata {

/// Places in `rows` of the loads that decide: those with the most friction energy until four fifths of all are reached,
/// the one with the smallest load factor, the one with the largest pressure. Of sound rows.
std::vector<std::size_t> deciding_loads(const std::vector<CollectiveRow>& rows);

/// As collective_numbers, each number with its half width, null where none is known; null: no load decides, or one has
/// no sound answer on either of the larger cells. options: as the rows were solved; placement: of the case.
nlohmann::ordered_json collective_errors(const CaseSpec& spec, const std::vector<CollectiveRow>& rows,
                                         const CollectiveDamage& damage, const Placement& placement,
                                         const std::filesystem::path& folder, const CollectiveOptions& options);

/// " ± 0.02", of a number of these at a place such as "/totals/rcf_damage_largest/damage" in a unit; empty where there
/// is none.
std::string bar_at(const nlohmann::ordered_json& errors, const std::string& place, double factor = 1);

}  // namespace railstrata
