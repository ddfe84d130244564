#pragma once
// Curves beside each other as one SVG: loops of a material, a fit and what it was fitted to.
#include <string>
#include <vector>

namespace railstrata {

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
