#pragma once
// What is not the profile carried along: a height of the running surface, as a case has it. A kind is a struct here,
// with its formula, and a row of options/irregularity_options.cpp.
//
// z(x, y) is a height along the surface's normal, positive out of the body; x the way from the first contact (of the
// wheel the arc of its circumference, which comes again after a turn), y the distance to the field side from there.
// Each shape is z(x, y) = h(x - at) c(y - offset), c = (1 + cos(2 pi y/width))/2 within the width and 0 beyond, 1
// without a width.
//
// A kind has
//   height(at, R)          z of x and y, for a wheel of radius R; keys that are needed have a value by then
//   extent(at)             where along the body it is
//   shortest_wave(R)       m, or the whole of a single shape (a step is half a wave); infinite of points
//   steepest_slope(R)      the largest |dz/dx|; of kinds without a formula `sampled` gives where it is sought
//   kOnRail, kOnWheel      bodies that may have it; kJoint: the track takes part in its forces
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/body_id.hpp"

namespace railstrata {

struct SurfaceHeight {
  double z = 0;      ///< m
  double along = 0;  ///< dz/dx
};
inline SurfaceHeight operator*(double a, SurfaceHeight h) { return {a * h.z, a * h.along}; }
using Heights = std::function<SurfaceHeight(double x, double y)>;

/// Where along the body a shape is, m; infinite where it has no ends.
struct Extent {
  double from, to;
};

/// a cos(k x).
SurfaceHeight cosine_wave(double amplitude, double number, double x);
/// -d/2 (1 + cos(2 pi x/L)) within L/2.
SurfaceHeight cosine_hollow(double depth, double length, double x);
/// From 0 to 1 over a length, from x = 0 on: half a wave.
SurfaceHeight cosine_rise(double x, double length);

struct AnyKind {
  static constexpr bool kOnRail = true, kOnWheel = true, kJoint = false;
};

/// The hollow of a cosine.
struct Indentation : AnyKind {
  std::optional<double> length, depth;

  Heights height(double at, double) const {
    return [*this, at](double x, double) { return cosine_hollow(*depth, *length, x - at); };
  }
  Extent extent(double at) const { return {at - 0.5 * length.value_or(0), at + 0.5 * length.value_or(0)}; }
  double shortest_wave(double) const { return *length; }
  double steepest_slope(double) const { return std::numbers::pi * *depth / *length; }
};

/// Waves along a stretch, without ends where from and to are not given.
struct WaveStretch : AnyKind {
  std::optional<double> from, to;

  Extent extent(double) const {
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    return {from.value_or(-kEndless), to.value_or(kEndless)};
  }
  /// A wave that begins and ends within the stretch.
  SurfaceHeight eased(double x, double over, SurfaceHeight h) const;
};

/// d/2 cos(2 pi x/l), eased in and out over one wave.
struct Corrugation : WaveStretch {
  std::optional<double> wavelength, depth;

  Heights height(double at, double) const {
    return [*this, at](double x, double) {
      return eased(x, *wavelength, cosine_wave(0.5 * *depth, 2 * std::numbers::pi / *wavelength, x - at));
    };
  }
  double shortest_wave(double) const { return *wavelength; }
  double steepest_slope(double) const { return std::numbers::pi * *depth / *wavelength; }
};

enum class RampShape { parabola, line };

/// Ramps r that meet at the angle a: -(a r/4) (1 - |x|/r)^2, parabola, or -(a r/2) (1 - |x|/r), line.
struct Dip : AnyKind {
  static constexpr bool kOnWheel = false, kJoint = true;
  std::optional<double> angle;  ///< a, rad: of both ramps together
  double ramp = 1;              ///< r
  RampShape shape = RampShape::parabola;

  Heights height(double at, double) const {
    return [*this, at](double x, double) { return below(x - at); };
  }
  SurfaceHeight below(double x) const {
    const double left = 1 - std::abs(x) / ramp, half = 0.5 * *angle, side = x < 0 ? -1 : 1;
    if (!(left > 0)) return {};
    if (shape == RampShape::line) return {-half * ramp * left, x == 0 ? 0 : side * half};
    return {-0.5 * half * ramp * left * left, x == 0 ? 0 : side * half * left};
  }
  Extent extent(double at) const { return {at - ramp, at + ramp}; }
  double shortest_wave(double) const { return ramp; }
  double steepest_slope(double) const { return 0.5 * *angle; }
};

/// s/2 (1 + sin(pi x/L)) within L/2, 0 before and s behind: the next rail lies higher or lower.
struct Step : AnyKind {
  static constexpr bool kOnWheel = false, kJoint = true;
  std::optional<double> length, height_behind;

  Heights height(double at, double) const {
    return [*this, at](double x, double) { return *height_behind * cosine_rise(x - at + 0.5 * *length, *length); };
  }
  Extent extent(double at) const { return {at - 0.5 * length.value_or(0), at + 0.5 * length.value_or(0)}; }
  double shortest_wave(double) const { return 2 * *length; }
  double steepest_slope(double) const { return 0.5 * std::numbers::pi * std::abs(*height_behind) / *length; }
  /// m before it, from where a wheel would touch a sharp one.
  double reach(double radius) const { return std::sqrt(2 * radius * std::abs(*height_behind)); }
};

/// The chord -((L/2)^2 - x^2)/(2 R) within L/2; with a depth the indentation's shape, worn round.
struct Flat : AnyKind {
  static constexpr bool kOnRail = false;
  std::optional<double> length, depth;

  Heights height(double at, double radius) const {
    return [*this, at, radius](double x, double) {
      return depth ? cosine_hollow(*depth, *length, x - at) : chord(radius, x - at);
    };
  }
  SurfaceHeight chord(double radius, double x) const {
    const double half = 0.5 * *length;
    if (!(std::abs(x) < half)) return {};
    return {-(half - x) * (half + x) / (2 * radius), x / radius};
  }
  Extent extent(double at) const { return {at - 0.5 * length.value_or(0), at + 0.5 * length.value_or(0)}; }
  double shortest_wave(double) const { return *length; }
  double steepest_slope(double radius) const {
    return depth ? std::numbers::pi * *depth / *length : 0.5 * *length / radius;
  }
};

/// d/2 cos(n x/R).
struct OutOfRound : AnyKind {
  static constexpr bool kOnRail = false;
  std::optional<double> depth;
  int order = 1;  ///< n

  Heights height(double at, double radius) const {
    return [*this, at, radius](double x, double) { return cosine_wave(0.5 * *depth, order / radius, x - at); };
  }
  Extent extent(double) const { return WaveStretch().extent(0); }
  double shortest_wave(double radius) const { return 2 * std::numbers::pi * radius / order; }
  double steepest_slope(double radius) const { return 0.5 * *depth * order / radius; }
};

/// Where a slope without a formula is looked for.
struct Sampled {
  Extent range;
  std::vector<double> rows;  ///< y
};

/// A sum of cosines of the density S(k) ~ k^-e between the wave numbers 1/longest and 1/shortest, whose root mean
/// square is given, of random phases; eased over the longest wave.
struct Roughness : WaveStretch {
  std::optional<double> rms, shortest, longest;
  double exponent = 2;  ///< e
  int seed = 1;

  Heights height(double, double) const;
  double shortest_wave(double) const { return *shortest; }
  Sampled sampled(double at) const;
};

/// Roughness as it is measured: levels L of third-octave bands of the wavelength, 20 log10(r/1 µm) of the root mean
/// square r in the band [EN15610]. Ten cosines of random phases in each band, eased over the longest wave.
struct RoughnessLevels : WaveStretch {
  std::string file;                         ///< empty once it is read into the bands
  std::vector<double> wavelengths, levels;  ///< m, in the middle of a band; dB over 1 µm
  int seed = 1;

  Heights height(double, double) const;
  double shortest_wave(double) const;
  double longest_wave() const;
  Sampled sampled(double at) const;
};

/// Heights at points, in x by cubics through them (slopes of their neighbours), in y linear; beyond the first and the
/// last of them their heights go on.
struct HeightPoints : AnyKind {
  std::string file;             ///< empty once it is read into x, y and z
  double smoothing = 0;         ///< length of the mean with cosine weights along x; 0: as they are
  std::vector<double> x, y, z;  ///< y empty: the same across, else every x at every y

  Heights height(double at, double) const;
  Extent extent(double at) const;
  double shortest_wave(double) const { return std::numeric_limits<double>::infinity(); }
  Sampled sampled(double at) const;
};

using IrregularityShape =
    std::variant<Indentation, Corrugation, Dip, Step, Flat, OutOfRound, Roughness, RoughnessLevels, HeightPoints>;

/// One of them, as a case has it; lengths in metres.
struct Irregularity {
  BodyId on = BodyId::rail;
  std::optional<double> at;  ///< its middle, of waves a crest, of points x = 0
  std::optional<double> width;
  double offset = 0;
  IrregularityShape shape;
};

}  // namespace railstrata
