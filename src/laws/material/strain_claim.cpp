#include "material/strain_claim.hpp"

#include <fmt/format.h>

#include <cmath>

#include "material/plastic.hpp"
#include "record/unit.hpp"

namespace railstrata {

double equivalent_strain(const double* plastic) { return std::sqrt(2.0 / 3 * double_contraction(plastic, plastic)); }

std::string strain_warning(double largest) {
  if (largest > kNoClaimStrain)
    return fmt::format(
        "No claim of accuracy: plastic strain reaches {:.1f} %, but the material law is valid for small strains only.",
        kToPercent * largest);
  if (largest > kLargeStrain)
    return fmt::format(
        "Plastic strain reaches {:.1f} %: the material law assumes small strains, so the numbers are some percent off.",
        kToPercent * largest);
  return {};
}

}  // namespace railstrata
