#pragma once
// A measured wear against the one that a collective computes: the factor that brings the law to the line.
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "collective/collective.hpp"
#include "geometry/profile_change.hpp"

namespace railstrata {

struct MeasuredWear {
  ProfileChange change;   ///< of the measured profiles
  double tonnes = 0;      ///< t between them
  double computed = 0;    ///< m² of the same traffic, by collective.wear_law with the collective's own factor
  double own_factor = 1;  ///< collective.wear_factor, which `computed` has
  WearLaw law = WearLaw::usfd;
  double factor() const { return change.area / computed; }
  double factor_error() const { return change.area_error / computed; }
};

/// Profiles measured before and after so many tonnes. They are aligned where no sound row rolls. Throws CaseError.
MeasuredWear measured_wear(const std::vector<CollectiveRow>& rows, const RailDamage& damage,
                           const std::filesystem::path& before, const std::filesystem::path& after, double tonnes);

/// In words, with the line for the case.
std::string measured_text(const MeasuredWear& measured);
nlohmann::ordered_json measured_json(const MeasuredWear& measured);

}  // namespace railstrata
