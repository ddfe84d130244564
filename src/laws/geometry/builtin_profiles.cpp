#include "geometry/builtin_profiles.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace railstrata {
namespace {

/// Millimetres, z down as on the drawings. A segment ends where the next begins.
struct DrawnSegment {
  double y, z, centre_y = 0, centre_z = 0, radius = 0;
};

constexpr Vec2 from_drawing(double y, double z) { return {1e-3 * y, -1e-3 * z}; }

constexpr DrawnSegment kLma[] = {
    {-70.0, 6.6191684803531405, -45.0, 6.6191684803531405, 25.0},
    {-62.30769230769231, 24.65922909505864, -54.0, 16.0, 12.0},
    {-52.55737075287149, 27.912968599611496, -54.36065731178213, 13.021757850097128, 15.0},
    {-40.265267999993505, 18.15205999998216},
    {-38.05334547459508, 12.074852807866968, -24.897648783592366, 16.86313481442633, 14.0},
    {-28.470899875306753, 3.326817862036279, -5.5, 90.34599827025797, 90.0},
    {-10.75, 0.4992537549445615, 15.5, 449.7329763315116, 450.0},
    {4.253513977908618, -0.12646455214365915},
    {30.0, -0.7701267026959437},
    {60.0, -2.7701267026959435},
    {65.0, -7.7701267026959435},
};

// Field-side halves, from the crown out; the last entry ends the flank.
constexpr DrawnSegment kCn60[] = {
    {0.0, 0.0, 0.0, 300.0, 300.0},
    {9.950786119532653, 0.16507565728215923, 7.297243154323945, 80.12105548200694, 80.0},
    {25.349752336728805, 2.1844985127695224, 22.416219594588014, 14.849189020270599, 13.0},
    {35.4, 14.2},
    {36.19, 30.0},
};
constexpr DrawnSegment kUic60[] = {
    {0.0, 0.0, 0.0, 300.0, 300.0},
    {10.228, 0.1744040012593473, 7.500533333333332, 80.12789626759019, 80.0},
    {26.0265, 2.30252406118467, 23.016030416666666, 14.949147044725564, 13.0},
    {35.99981082207864, 14.299958024454964},
    {36.7848129208559, 30.0},
};
constexpr DrawnSegment kUic54[] = {
    {0.0, 0.0, 0.0, 300.0, 300.0},
    {10.012000000000002, 0.16711345150940815, 7.342133333333335, 80.12254986444023, 80.0},
    {24.863500000000002, 2.0648679226081157, 22.016277916666667, 14.749241238155832, 13.0},
    {35.000058322078644, 14.100052217885233},
    {35.79505571118438, 30.0},
};

std::vector<ProfileSegment> segments(std::span<const DrawnSegment> drawn) {
  std::vector<ProfileSegment> out;
  for (std::size_t i = 0; i + 1 < drawn.size(); ++i) {
    const DrawnSegment &a = drawn[i], &b = drawn[i + 1];
    out.push_back(
        {from_drawing(a.y, a.z), from_drawing(b.y, b.z), from_drawing(a.centre_y, a.centre_z), 1e-3 * a.radius});
  }
  return out;
}

constexpr Vec2 mirrored(Vec2 p) { return {-p.y, p.z}; }

Profile symmetric_rail(const char* name, std::span<const DrawnSegment> half) {
  const std::vector<ProfileSegment> field = segments(half);
  std::vector<ProfileSegment> all;
  for (auto g = field.rbegin(); g != field.rend(); ++g)
    all.push_back({mirrored(g->p1), mirrored(g->p0), mirrored(g->centre), g->radius});
  all.insert(all.end(), field.begin(), field.end());
  return Profile::from_segments(ProfileKind::rail, name, std::move(all));
}

double polynomial(std::span<const double> coefficients, double x) {
  double sum = 0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) sum = sum * x + *c;
  return sum;
}

double circle(double y, double centre_y, double centre_z, double radius, double side) {
  return centre_z + side * std::sqrt(std::max(0.0, radius * radius - (y - centre_y) * (y - centre_y)));
}

constexpr double kZoneB[] = {0.0,
                             -3.358537058e-2,
                             1.565681624e-3,
                             -2.810427944e-5,
                             5.844240864e-8,
                             -1.562379023e-8,
                             5.309217349e-15,
                             -5.957839843e-12,
                             2.646656573e-13};
constexpr double kZoneC[] = {-4.320221063e3,  -1.038384026e3,  -1.065501873e2,  -6.051367875,
                             -2.054332446e-1, -4.169739389e-3, -4.687195829e-5, -2.252755540e-7};

/// Zone C as published ends 3.7e-5 mm below zone B and 1.2e-4 mm below zone D; a straight line added closes both steps.
double closing_zone_c(double y) {
  const double at_b = polynomial(kZoneB, -26.0) - polynomial(kZoneC, -26.0),
               at_d = circle(-35.0, -26.210665, 16.446, 13.0, -1) - polynomial(kZoneC, -35.0);
  return at_b + (at_d - at_b) * (y + 26.0) / -9.0;
}

/// The point a chord further along the curve.
double march(double y, double end, double chord) {
  const auto distance = [&](double to) { return std::hypot(to - y, s1002_height_mm(to) - s1002_height_mm(y)); };
  double near = y, far = std::min(end, y + chord);
  if (distance(far) <= chord) return far;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (near + far);
    (distance(middle) < chord ? near : far) = middle;
  }
  return far;
}

}  // namespace

double s1002_height_mm(double y) {
  if (y > 32.15796) return 1.364323640 - 0.066666667 * y;
  if (y > -26.0) return polynomial(kZoneB, y);
  if (y > -35.0) return polynomial(kZoneC, y) + closing_zone_c(y);
  if (y > -38.426669071) return circle(y, -26.210665, 16.446, 13.0, -1);
  if (y > -39.764473993) return -93.576667419 - 2.747477419 * y;
  if (y > -49.662510381) return circle(y, -58.558326413, 8.834924130, 20.0, 1);
  if (y > -62.764705882) return circle(y, -55.0, 16.0, 12.0, 1);
  return circle(y, -49.5, 9.519259302, 20.5, 1);
}

Profile s1002_wheel() {
  constexpr double begin = -70.0, end = 60.0, chord = 0.25;
  std::vector<Vec2> points;
  double y = begin;
  for (; end - y > 0.5 * chord; y = march(y, end, chord)) points.push_back(from_drawing(y, s1002_height_mm(y)));
  points.push_back(from_drawing(end, s1002_height_mm(end)));
  return Profile::from_points(ProfileKind::wheel, "S1002", points);
}

Profile lma_wheel() { return Profile::from_segments(ProfileKind::wheel, "LMA", segments(kLma)); }
Profile cn60_rail() { return symmetric_rail("CN60", kCn60); }
Profile uic60_rail() { return symmetric_rail("UIC60", kUic60); }
Profile uic54_rail() { return symmetric_rail("UIC54", kUic54); }

}  // namespace railstrata
