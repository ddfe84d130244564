#pragma once
// The shakedown limit of traffic that rolls on one line, every passage over the same points of the section: Melan's
// theorem with every residual stress that rolling can leave.
//
// Nothing depends on x after many passages, so a residual stress in equilibrium consists of sigma_x(y, z), any
// function; sigma_y = phi,zz, sigma_z = phi,yy, tau_yz = -phi,yz; tau_xy = psi,z, tau_xz = -psi,y. The free surface
// asks for phi = phi,z = psi = 0. With u of damage/deviator.hpp
//
//   1/factor = min over sigma_x, phi, psi of max over y, z, x of |u(sigma) + u(rho)| / k,
//
// a convex program (cone_program.hpp). phi and psi are tensor products of cubic splines that vanish with their stresses
// outside of a box, so that equilibrium is exact everywhere and what is found is a limit on the safe side (Melan's
// static theorem), but for what happens between the points where stresses are looked at. The found stress is therefore
// checked on points twice as close in y, depth and x (where the program's own points come within 0.8 of the limit),
// sigma_x taken anew; what sticks out by more than 0.3 % joins the program, which is solved again, up to three times.
// `factor` is what the best checked stress allows. [Melan1938, NesterovTodd1998]
#include <array>
#include <functional>
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

/// Elastic stresses [Pa] at points (x, y, depth) of one depth, in the same order; at an interface those of the layer
/// above, or below it if asked. Called for one depth after the other, never from two threads at once.
using StressAt = std::function<std::vector<Sym3>(const std::vector<Vec3>& points, bool below_interface)>;

enum class TrackSides {
  both,
  symmetric,  ///< the mirror image of a stress at y = centre_y is its own: only one side is asked for
  endless     ///< nothing depends on y: a line contact
};

struct SingleTrackInput {
  StressAt stress;
  /// Pa, at a depth, at an interface above or below it. NaN or infinite: stays elastic, does not count.
  std::function<double(double depth, bool below_interface)> shear_strength;
  std::vector<double> interfaces;          ///< m, ascending, > 0: where material or strength jumps
  double half_length = 0, half_width = 0;  ///< m, of the patch along x and y
  double centre_x = 0, centre_y = 0;       ///< m
  TrackSides sides = TrackSides::both;
  /// m, where the patch begins and ends in x at a y, for samples close to them; empty: an ellipse.
  std::function<std::array<double, 2>(double y)> ends;
};

struct SingleTrackOptions {
  double cell = 0.1;       ///< of the splines within 1.4 half-widths and 1.2 half-lengths, in half-widths and in the
                           ///< smaller half-axis; outside of that growing by 1.3
  double box = 6;          ///< in half-widths to each side and half-lengths of depth: outside the residual stress is 0
  double accuracy = 1e-3;  ///< of the program, relative; smaller ones find rougher stresses, which the check punishes
};

/// A point at which the program looked.
struct TrackPoint {
  double y = 0, depth = 0;  ///< m
  bool below_interface = false;
  double utilisation = 0;  ///< largest |u + w| factor/k over x; 1 where it governs, on the program's own points
  double work = 0;         ///< share of the plastic work of the mechanism that a larger load sets off; sum 1
};

struct SingleTrack {
  double factor = 0;             ///< what the elastic stress may be multiplied by; checked
  double program_factor = 0;     ///< what the program believed; the difference is its discretisation
  double y = 0, depth = 0;       ///< m, where the checked factor is decided
  bool below_interface = false;  ///< at an interface: in the layer below it
  std::vector<TrackPoint> points;
  int iterations = 0;  ///< of the last round, and the sizes of its program
  int unknowns = 0, samples = 0, rounds = 0;
};

/// Some seconds on one core; parallel over points, the same bits for any number of threads. Throws
/// std::invalid_argument for a patch without extent, interfaces out of order or no strength anywhere, NumericalError
/// for stresses that are no numbers and if the program does not converge. Accuracy: 1 % at `cell` 0.1; the factor lies
/// between `wandering` and `upper` of shakedown.hpp on the same stresses. Beyond the box the stress is taken for small.
SingleTrack single_track(const SingleTrackInput& input, const SingleTrackOptions& options = {});

}  // namespace railstrata
