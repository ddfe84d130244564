#pragma once
// The state of a rail between two stretches of its traffic: all that run_clock needs to go on to the same bits, as one
// file of exact numbers (CBOR, RFC 8949).
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "clock/clock.hpp"
#include "clock/rail_crack.hpp"
#include "reader/case_file.hpp"

namespace railstrata {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

struct ClockState {
  MetalGrid grid;
  std::vector<double> metal;          ///< Metal::state
  std::vector<double> metal_removed;  ///< m, of columns, when the metal's rows were laid
  WornSurface surface;
  Gathered damage;
  double kilograms = 0;           ///< gross, by a wheel of the mixture
  double wheels = 0;              ///< so far, of all loads
  double next_grinding = kNever;  ///< kg, gross traffic
  RailCrack crack;
  bool followed = false;        ///< the metal, under any load
  std::set<std::string> noted;  ///< loads whose note has been made
  ClockResult out;              ///< so far, without lives and profile
};

/// All that the numbers of a state depend on but for the horizon, a key a line: the case with the content of its files,
/// the options, the version of results.
std::string clock_identity(const LoadedCase& loaded, const ClockOptions& options);

/// Whole or not there; throws EnvironmentError.
void write_clock_state(const std::filesystem::path& file, const std::string& identity, const ClockState& state);
/// Throws CaseError: there is none, it is damaged, of another identity (naming the keys that differ) or beyond the
/// horizon [kg].
ClockState read_clock_state(const std::filesystem::path& file, const std::string& identity, double horizon);

}  // namespace railstrata
