#include "result/layer_worst.hpp"

#include <cmath>

namespace railstrata {
namespace {

void take_larger(double value, double& out) {
  if (std::isfinite(value) && !(value <= out)) out = value;
}
void take_smaller(double value, double& out) {
  if (std::isfinite(value) && !(value >= out)) out = value;
}

}  // namespace

LayerWorst layer_worst(const Summary& summary) {
  LayerWorst out;
  for (const BodyFatigue& body : summary.fatigue) {
    for (const BrittleSummary& z : body.brittle) {
      if (z.zone == body.body) continue;  // rail and wheel themselves are no layers
      take_larger(z.sigma1, out.sigma_1);
      take_larger(z.share_of_tensile, out.share_of_tensile);
      take_smaller(z.critical_flaw, out.critical_flaw);
    }
    for (const InterfaceSummary& i : body.interfaces) {
      take_larger(i.tension, out.interface_tension);
      take_larger(i.shear, out.interface_shear);
      take_larger(i.shear_range, out.shear_range);
      take_larger(i.delamination, out.delamination);
    }
  }
  return out;
}

}  // namespace railstrata
