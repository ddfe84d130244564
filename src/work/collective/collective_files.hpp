#pragma once
// The files of a load collective.
#include <filesystem>
#include <string>
#include <vector>

#include "collective/collective.hpp"
#include "many/case_row.hpp"
#include "report/checks.hpp"

namespace railstrata {

/// Title of the axis of pictures across the rail.
inline constexpr const char* kAcross = "y across the rail, from its axis to the field side [mm]";

/// Cells from the first up to the second.
struct ShownCells {
  std::size_t from = 0, to = 0;
};
/// From the first to the last value above `least`, with `room` cells on either side; all where there is none.
ShownCells cells_above(const std::vector<double>& values, double least, std::size_t room);

/// The columns of collective.csv, a row for each load.
CaseTable collective_table(const std::vector<CollectiveRow>& rows);
void write_collective_table(const std::filesystem::path& file, const std::vector<std::string>& origin,
                            const std::vector<CollectiveRow>& rows);

/// rail_damage.csv: a row for each cell across the rail; columns that lack data are left out.
void write_rail_damage(const std::filesystem::path& file, const std::vector<std::string>& origin,
                       const RailDamage& damage);

/// wheel_damage.csv: a row for each cell across the wheel's tread, depths per 1000 km.
void write_wheel_damage(const std::filesystem::path& file, const std::vector<std::string>& origin,
                        const WheelDamage& damage);

/// Damage of both bodies by all passages.
struct CollectiveDamage {
  RailDamage rail;
  WheelDamage wheel;
  Lives lives{};
  nlohmann::ordered_json error{};  ///< collective_errors (collective/collective_errors.hpp); null: not known
};

/// The numbers of the answer alone: totals, worst_shakedown, lives, as in collective.json.
nlohmann::ordered_json collective_numbers(const std::vector<CollectiveRow>& rows, const CollectiveDamage& damage);

/// collective.json: totals, where the extremes are, and every row in short.
nlohmann::ordered_json collective_json(const std::string& title, const std::vector<CollectiveRow>& rows,
                                       const CollectiveDamage& damage);

/// What the passages do, the worst first: whether and how long the rail lasts, rolling contact fatigue, wear.
std::vector<ReportAnswer> collective_answers(const std::vector<CollectiveRow>& rows, const CollectiveDamage& damage);

/// What the vehicle code has for the same wheels, mean over those that give it; no text: none does.
ReportAnswer comparison_answer(const std::vector<CollectiveRow>& rows);

/// What stands first on the page of a collective that was followed through its traffic; empty: it was not.
struct CollectiveFront {
  std::vector<ReportAnswer> answers;
  std::vector<ReportChart> charts;
  std::vector<ReportTable> tables;
};

/// A page over all rows; `looked_at` is the result folder of the row that it shows whole, by the name `shown`. With a
/// front without the rail's sums and answers of the unworn profile, which that replaces.
ReportVerdict write_collective_page(const std::filesystem::path& page, const std::string& title,
                                    const std::vector<CollectiveRow>& rows, const CollectiveDamage& damage,
                                    const std::filesystem::path& looked_at, const std::string& shown,
                                    const CollectiveFront& front = {});

/// Points of the rail's profile moved along its normal by so much [m], outwards positive.
ReportSeries beside_profile(const std::string& name, const RailDamage& d, const std::vector<double>& outwards);
/// Round factor by which the largest value [m] is drawn some 5 mm long; 0 where none is above zero.
double magnification(const std::vector<double>& values);

/// A depth of the cells that is known everywhere.
struct KnownWear {
  WearLaw law;
  std::string key, words;
};
std::vector<KnownWear> known_wear(const RailDamage& damage);
std::vector<KnownWear> known_wear(const WheelDamage& damage);

}  // namespace railstrata
