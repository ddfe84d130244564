#include "crack/crack_passage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

PlaneStress plane_of(const Sym3& s) { return {s.xx, s.zz, s.xz}; }
PlaneStress mixed(const PlaneStress& a, const PlaneStress& b, double share) {
  return {a.xx + share * (b.xx - a.xx), a.zz + share * (b.zz - a.zz), a.xz + share * (b.xz - a.xz)};
}

/// The interval of ascending values that holds one, and how far in it; ends stand for what is beyond.
struct Between {
  std::size_t low = 0;
  double share = 0;
};
Between between(const std::vector<double>& of, double value) {
  if (of.size() < 2 || value <= of.front()) return {};
  const auto high = std::min<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(of.begin(), of.end(), value) - of.begin()), of.size() - 1);
  const double width = of[high] - of[high - 1];
  return {high - 1, width > 0 ? std::min(1.0, (value - of[high - 1]) / width) : 1};
}

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

PlaneOfRolling::PlaneOfRolling(const StressHistory& history, double y, ResidualRows residual)
    : x_(history.x), depth_(history.depth) {
  check_residual(history, residual);
  const Between column = between(history.y, y);
  const int first = static_cast<int>(column.low), second = std::min(first + 1, history.columns() - 1);
  for (int r = 0; r < history.rows(); ++r) {
    residual_.push_back(plane_of(residual_of(residual, r)));
    const Sym3 *a = history.cycle(r, first), *b = history.cycle(r, second);
    for (int s = 0; s < history.samples(); ++s)
      stress_.push_back(mixed(plane_of(a[s]), plane_of(b[s]), column.share));
  }
}

PlaneStress PlaneOfRolling::in_row(std::size_t row, double x) const {
  const PlaneStress* of = stress_.data() + row * x_.size();
  const Between at = between(x_, x);
  PlaneStress out = mixed(of[at.low], of[std::min(at.low + 1, x_.size() - 1)], at.share);
  const double middle = 0.5 * (x_.front() + x_.back()), half = 0.5 * (x_.back() - x_.front());
  const double away = std::abs(x - middle);
  const double fall = away > half ? half * half / (away * away) : 1;
  out = {fall * out.xx, fall * out.zz, fall * out.xz};
  return {out.xx + residual_[row].xx, out.zz + residual_[row].zz, out.xz + residual_[row].xz};
}

PlaneStress PlaneOfRolling::at(double x, double depth) const {
  const Between row = between(depth_, depth);
  return mixed(in_row(row.low, x), in_row(std::min(row.low + 1, depth_.size() - 1), x), row.share);
}

CrackPassage pass_over(CrackFaces& faces, const PlaneOfRolling& plane, const PassageOptions& options) {
  const CrackLine& line = faces.line();
  const std::vector<double> places = faces.places();
  const double end = line.x(line.length), from = std::min(0.0, end) - plane.ahead(),
               to = std::max(0.0, end) - plane.behind();
  faces.forget();
  CrackPassage out;
  StressIntensity before;
  for (bool repeats = false; !repeats && out.passes < options.most_passes;) {
    const int passes = out.passes + 1;
    out = {};
    out.passes = passes;
    double volume = 0;
    bool covered = false;
    for (int i = 0; i < options.places; ++i) {
      const double wheel = from + (to - from) * i / (options.places - 1);
      std::vector<LineTraction> applied;
      for (const double r : places) applied.push_back(traction_on(plane.at(line.x(r) - wheel, line.z(r)), line.angle));
      const double over_mouth = std::max(0.0, -plane.at(-wheel, 0).zz);
      double fluid = options.fluid == CrackFluid::mouth ? over_mouth : 0;
      if (options.fluid == CrackFluid::trapped) {
        if (covered && over_mouth > 0) fluid = trapped_pressure(faces, applied, options.friction, volume);
        covered = over_mouth > 0;
      }
      const CrackFaces::Faces now = faces.load(applied, options.friction, fluid);
      if (!covered) volume = now.volume;
      out.place.push_back(wheel);
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
