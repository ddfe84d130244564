#pragma once
// The page of a wear loop: the rail before and after, how deep it has worn, how the contact moves.
#include <filesystem>
#include <string>
#include <vector>

#include "jobs/state_table.hpp"
#include "wear/wear_loop.hpp"

namespace railstrata {

/// One load of a step, on the rail before it: a row of wear_loads.csv, in its units.
struct WearLoad {
  double step = 0;
  double passages = 0;  ///< of the whole collective before the step
  double load = 0;      ///< its number in the collective, from 1
  double y = 0;         ///< mm, of the first contact, from the rail's axis
  double pressure = 0;  ///< MPa, the largest
  double t_gamma = 0;   ///< N
};
std::vector<WearLoad> wear_loads(const WearStep& step, double passages_before);
const StateColumns<WearLoad>& wear_load_columns();

/// m, of every point the distance to the worn profile: how deep it has worn, along its normal. The two are of one
/// loop: nearly the same points, from the same beginning; outside of what has worn it is zero to round-off.
std::vector<double> worn_depth(const std::vector<Vec2>& unworn, const std::vector<Vec2>& worn);

struct WearLoopHistory {
  std::string title;
  std::vector<std::string> loads;  ///< names
  std::vector<Vec2> unworn;        ///< m
  std::vector<WornRail> profiles;  ///< after each step, in order
  std::vector<WearLoad> contacts;
  double traffic = 0;  ///< kg, gross
};
void write_wear_loop_page(const std::filesystem::path& page, const WearLoopHistory& history);

}  // namespace railstrata
