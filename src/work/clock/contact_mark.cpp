#include "clock/contact_mark.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace railstrata {
namespace {

constexpr double kMost = 4;

/// The farthest of the fewer patches from the nearest of the others.
double apart(const std::vector<double>& one, const std::vector<double>& other) {
  if (one.size() > other.size()) return apart(other, one);
  double out = 0;
  for (const double at : one) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double beside : other) nearest = std::min(nearest, std::abs(at - beside));
    out = std::max(out, nearest);
  }
  return out;
}

}  // namespace

double change_between(const ContactMark& one, const ContactMark& other, const MarkLimits& limits) {
  const double larger = std::max(one.p_max, other.p_max);
  if (!(larger > 0)) return 0;
  const double pressure = std::abs(one.p_max - other.p_max) / (limits.change * larger),
               place = apart(one.at, other.at) / limits.moved, patches = one.at.size() != other.at.size() ? 1 : 0;
  return std::min(kMost, std::max({pressure, place, patches}));
}

}  // namespace railstrata
