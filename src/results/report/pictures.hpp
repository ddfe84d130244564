#pragma once
// Pictures as SVG files of their own.
#include <string>
#include <vector>

#include "contact/contact_field.hpp"
#include "result/compare.hpp"

namespace railstrata {

// ---- two results side by side: pressure and traction along the centre lines, maps of both pressures and of their
// difference
struct PictureSide {
  std::string name;
  const ContactField& field;
};

std::string comparison_svg(const PictureSide& a, const PictureSide& b, const FieldComparison& comparison);

// ---- curves beside each other: loops of a material, a fit and what it was fitted to
struct PlotCurve {
  std::string name;
  std::vector<double> x, y;
  bool points = false;  ///< dots instead of a line
};

struct Plot {
  std::string x_label, y_label;
  std::vector<PlotCurve> curves;
};

/// The title on top, the plots from left to right, the remarks below them, a line each.
std::string plots_svg(const std::string& title, const std::vector<Plot>& plots,
                      const std::vector<std::string>& remarks);

}  // namespace railstrata
