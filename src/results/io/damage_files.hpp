#pragma once
// Files of shakedown: shakedown.json, and for each body the strength required at every depth and the map of the
// section.
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bem/interface_slip.hpp"
#include "fatigue/crack_summary.hpp"
#include "fatigue/shakedown_summary.hpp"
#include "fatigue/streamlines.hpp"
#include "result/summary.hpp"

namespace railstrata {

/// {"factors": {...}, "verdict": words, "governing": {body, zone, depth_m, y_m}, "bodies": [...]}; null without bodies.
nlohmann::ordered_json shakedown_json(const Summary& summary);

/// Fatigue parameters of every body with their places, zones and interfaces.
nlohmann::ordered_json fatigue_json(const Summary& summary);

/// shakedown.json; shakedown_<body>.csv, a row a depth: yield strengths there and asked for by each level; and
/// shakedown_<body>_map.csv, a row a point: the share of the strength there that the load uses of the upper bound.
/// Nothing without sections.
void write_shakedown(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                     const Summary& summary, const std::vector<SectionShakedown>& sections);

/// shakedown_<body>_sliding.csv: a row for each traction coefficient of the map, its load factors and the largest
/// pressure at each limit. Nothing without maps.
void write_sliding_maps(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                        const std::vector<SlidingMap>& maps);

/// crack.csv: a row a place of the wheel; crack_depths.csv: a row a depth of the crack, which one inside has not.
void write_crack(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                 const CrackResult& crack);

/// interface_slip.csv: slip and shear along the row that slips most, of the first passage and the last one.
void write_interface_slip(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                          const InterfaceSlip& slip);

/// Wear, heat and fatigue of one passage: a row per streamline, y ascending. Writes nothing without rows.
void write_streamlines(const std::filesystem::path& file, const std::vector<std::string>& provenance,
                       const std::vector<StreamlineRow>& rows);

}  // namespace railstrata
