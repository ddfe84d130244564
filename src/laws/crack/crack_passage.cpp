#include "crack/crack_passage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crack/crack_faces.hpp"

namespace railstrata {
namespace {

/// The fluid's pressure that keeps the volume between the faces: it grows with the pressure.
double trapped_pressure(const CrackFaces& faces, const std::vector<LineTraction>& applied, double friction,
                        double volume) {
  const auto volume_at = [&](double pressure) {
    CrackFaces trial = faces;
    return trial.load(applied, friction, pressure).volume;
  };
  if (!(volume > 0) || volume_at(0) >= volume) return 0;
  double low = 0, high = 1e6;
  while (volume_at(high) < volume && high < 1e11) high *= 2;
  for (int i = 0; i < 40 && high - low > 1e-4 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (volume_at(middle) < volume ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

CrackPassage pass_over(const CrackLine& line, const LayeredHalfSpace& body, const PlaneOfRolling& plane,
                       const PassageOptions& options) {
  CrackFaces faces(line, body, options.points);
  const std::vector<double> points = faces.places();
  const double end = plane.along(line.x(line.length)), from = std::min(0.0, end) - plane.ahead(),
               to = std::max(0.0, end) - plane.behind();
  struct Place {
    double wheel = 0, over_mouth = 0;
    std::vector<LineTraction> applied = {};
  };
  std::vector<Place> places;
  for (int i = 0; i < options.places; ++i) {
    Place& now = places.emplace_back(Place{.wheel = from + (to - from) * i / (options.places - 1)});
    for (const double r : points)
      now.applied.push_back(traction_on(plane.at(line.x(r), line.z(r), now.wheel), line.angle));
    now.over_mouth = std::max(0.0, -plane.at(0, 0, now.wheel).zz);
  }
  CrackPassage out;
  StressIntensity before;
  for (bool repeats = false; !repeats && out.passes < options.most_passes;) {
    const int passes = out.passes + 1;
    out = {};
    out.modulus = faces.modulus();
    out.passes = passes;
    double volume = 0;
    bool covered = false;
    for (const Place& place : places) {
      double fluid = options.fluid == CrackFluid::mouth ? place.over_mouth : 0;
      if (options.fluid == CrackFluid::trapped) {
        if (covered && place.over_mouth > 0) fluid = trapped_pressure(faces, place.applied, options.friction, volume);
        covered = place.over_mouth > 0;
      }
      const CrackFaces::Faces now = faces.load(place.applied, options.friction, fluid);
      if (!covered) volume = now.volume;
      out.place.push_back(place.wheel);
      out.end.push_back(now.end);
      if (now.start) out.start.push_back(*now.start);
      out.open.push_back(now.open);
      out.slipping.push_back(now.slipping);
      out.fluid.push_back(fluid);
      out.settled = out.settled && now.settled;
    }
    const StressIntensity range = range_of(out.end);
    repeats = std::hypot(range.I - before.I, range.II - before.II) <= options.repeats * std::hypot(range.I, range.II);
    before = range;
    out.settled = out.settled && (repeats || passes < options.most_passes);
  }
  return out;
}

Release release_at(const CrackPassage& passage, std::size_t place) {
  Release out;
  for (const std::vector<StressIntensity>* tip : {&passage.end, &passage.start}) {
    if (tip->empty()) continue;
    const StressIntensity& k = (*tip)[place];
    const double rate = (k.I * k.I + k.II * k.II) / passage.modulus;
    if (rate > out.rate) out = {rate, std::atan2(k.II, k.I)};
  }
  return out;
}

StressIntensity range_of(const std::vector<StressIntensity>& passage) {
  double opened = 0, closed = passage.empty() ? 0 : std::max(0.0, passage.front().I), most = -1e300, least = 1e300;
  for (const StressIntensity& k : passage) {
    opened = std::max(opened, k.I);
    closed = std::min(closed, std::max(0.0, k.I));
    most = std::max(most, k.II);
    least = std::min(least, k.II);
  }
  return passage.empty() ? StressIntensity{} : StressIntensity{opened - closed, most - least};
}

Kink worst_kink(const std::vector<StressIntensity>& passage) {
  constexpr int kAngles = 75;  // degrees to either side
  Kink out;
  for (int degrees = -kAngles; degrees <= kAngles; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const double by_I = 0.25 * (3 * std::cos(angle / 2) + std::cos(1.5 * angle)),
                 by_II = -0.75 * (std::sin(angle / 2) + std::sin(1.5 * angle));
    std::vector<StressIntensity> kinked;
    for (const StressIntensity& k : passage) kinked.push_back({by_I * std::max(0.0, k.I) + by_II * k.II, 0});
    const double range = range_of(kinked).I;
    if (range > out.range) out = {range, angle};
  }
  return out;
}

}  // namespace railstrata
