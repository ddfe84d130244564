#pragma once
// summary.json: stable keys, SI units, the same from both engines; what does not apply is null. Where the wheel touches
// at several places `patches` has the numbers of `contact` for each, that of the largest pressure first.
#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "result/summary.hpp"

namespace railstrata {

/// What JSON and tables have for a life that does not end within life.until.
inline constexpr const char* kEndlessLife = "inf";

/// Whose wear the depths are: factor, source and words of rail and wheel.
nlohmann::ordered_json steels_json(const DamageSummary& damage);
nlohmann::ordered_json summary_json(const Summary& summary);
void write_summary(const std::filesystem::path& file, const Summary& summary);

}  // namespace railstrata
