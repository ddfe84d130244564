#pragma once
// Contents of passes.json common to both methods.
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "passes/pass_point.hpp"
#include "record/csv.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// The last row of passes.csv, but for its number; null for what is not finite.
nlohmann::ordered_json last_pass_json(const CsvTable& table);

/// Number of points of each class. points: the last passes of each; whole: the class of the series.
nlohmann::ordered_json points_json(const std::vector<std::vector<PassStrain>>& points, PassClass whole);

/// Passes until the ductility [equivalent strain] is used up, and between which two numbers that lies; null: never by
/// this law. reached: the largest equivalent plastic strain so far; cycles of `cycle` passes.
nlohmann::ordered_json ductility_json(double ductility, double reached, const std::vector<PassStrain>& cycles,
                                      int cycle);

/// A zone of the rail: 0 the rail itself, then its layers from the surface down.
struct ZoneTop {
  int zone = 0;
  double top = 0;  ///< m below the surface
};
nlohmann::ordered_json zones_json(const CaseSpec& spec, const std::vector<ZoneTop>& zones);

/// Positions of the points whose loops are in loops.csv.
nlohmann::ordered_json loops_json(const std::vector<PassLoop>& loops);

}  // namespace railstrata
