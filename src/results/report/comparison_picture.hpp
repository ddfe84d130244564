#pragma once
// Two results side by side as one SVG: pressure and traction along the centre lines, maps of both pressures and of
// their difference.
#include <string>

#include "contact/contact_field.hpp"
#include "result/compare.hpp"

namespace railstrata {

struct PictureSide {
  std::string name;
  const ContactField& field;
};

std::string comparison_svg(const PictureSide& a, const PictureSide& b, const FieldComparison& comparison);

}  // namespace railstrata
