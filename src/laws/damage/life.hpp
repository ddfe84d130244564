#pragma once
// From damage of one wheel to a life: a sigma-N line, the sum over kinds of wheels, and removal, by wear and grinding,
// that takes the damaged skin away.
//
// A point that has seen n_i wheels of every kind is damaged by D = sum of n_i/N_i and fails at D = 1. [Miner1945]
//
// Removal: a point at depth z0 of the new surface lies at z = z0 - removed(t) when t units of traffic have passed, and
// gathers there what the table of depths says of z. So with wear w a unit
//   D(z0, t) = 1/w integral of rate over z from z0 - w t to z0,
// and nothing ever fails where w is above the integral of the rate over all depths: the magic wear rate.
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

namespace railstrata {

/// A life by the scatter of what it rests on; infinite: never, NaN: not known.
struct LifeRange {
  double low = std::numeric_limits<double>::quiet_NaN(), best = low, high = low;
  bool known() const { return best == best; }
};

/// Cycles of a sigma-N line: N = cycles (limit/stress)^exponent.
struct SigmaN {
  double exponent = 0;  ///< above 1
  double cycles = 0;    ///< at the limit
};
/// How the line goes on below the limit: not at all, with the exponent 2k - 1 [Haibach2006], or as above it.
enum class BelowLimit { endures, flatter, as_above };
/// used: stress over limit.
double cycles_to_failure(double used, const SigmaN& line, BelowLimit below);
/// Miner's sum of one cycle over the sum at failure, for short (0), middle (1) and long (2) lives: the line as above
/// its limit, flatter or none, sums of 1/3, 1 and 3. [Haibach2006]
double fatigue_rate(double used, const SigmaN& line, std::size_t variant);

/// Damage of one kind of wheels at a place of the surface, by depth.
struct KindDamage {
  double wheels = 1;           ///< of this kind in a unit of traffic
  std::vector<double> rate{};  ///< at every depth, of one wheel
};

/// m, removed by the first t units of traffic: wear, and grinding after every so many units.
struct Removal {
  double wear = 0;   ///< m a unit
  double depth = 0;  ///< m, ground off each time
  double every = 0;  ///< units; 0: nothing is ground
  double after(double t) const;
  double mean() const { return wear + (every > 0 ? depth / every : 0); }
  /// Units until so much is removed; infinite without removal.
  double until(double removed) const;
};

/// A place of the surface: depths of the table below the surface, ascending, and what the wheels do there; above the
/// first depth its value holds, below the last one nothing happens.
struct DamagedPlace {
  std::vector<double> depth;  ///< m
  std::vector<KindDamage> kinds;
  double top = 0, bottom = 0;  ///< m, between which the zone lies below the new surface
};

/// The first failure of a point that then lies between two depths below the surface of that time.
struct Failure {
  double traffic = std::numeric_limits<double>::infinity();  ///< units; infinite: never
  double depth = 0;                                          ///< m, of the point below the surface of that time
};
Failure first_failure(const DamagedPlace& place, const Removal& removal, double from_depth, double to_depth);

/// When points fail while what lies above them is removed, by their depth below the new surface [m]; without those that
/// do not fail before `end`.
std::map<double, double> failures_until(const DamagedPlace& place, const Removal& removal, double end);

/// Units of traffic after which each depth fails if nothing is removed.
std::vector<double> failures_by_depth(const DamagedPlace& place);

}  // namespace railstrata
