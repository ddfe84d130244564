#include "damage/hardness.hpp"

#include <stdexcept>

#include "damage/positive.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

constexpr double kTensilePerVickers = 3.2 * kMega, kBrinellPerVickers = 0.95;

double share_of_tensile(double share) {
  if (!(share > 0 && share <= 1)) throw std::invalid_argument("yield over tensile strength must lie in (0, 1]");
  return share;
}

}  // namespace

double vickers_from_brinell(double brinell) { return positive(brinell, "hardness") / kBrinellPerVickers; }
double tensile_from_vickers(double vickers) { return positive(vickers, "hardness") * kTensilePerVickers; }
double vickers_from_tensile(double tensile) { return positive(tensile, "tensile strength") / kTensilePerVickers; }
double yield_from_vickers(double vickers, double yield_to_tensile) {
  return share_of_tensile(yield_to_tensile) * tensile_from_vickers(vickers);
}

}  // namespace railstrata
