#include "spec/layer_spec.hpp"

#include <algorithm>

namespace railstrata {

std::vector<double> layer_tops(const std::vector<LayerSpec>& layers) {
  std::vector<double> tops;
  for (const LayerSpec& layer : layers) {
    double top = 0;
    for (std::size_t i = 0; i < tops.size(); ++i) {
      const LayerSpec& above = layers[i];
      if (above.on == layer.on && above.begin() < layer.end() && layer.begin() < above.end())
        top = std::max(top, tops[i] + above.thickness);
    }
    tops.push_back(top);
  }
  return tops;
}

std::vector<LayerSpec> layers_at(const std::vector<LayerSpec>& layers, double x) {
  const std::vector<double> tops = layer_tops(layers);
  std::vector<LayerSpec> out;
  double above[] = {0, 0};
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (!(layers[i].begin() <= x && x < layers[i].end())) continue;
    double& top = above[index_of(layers[i].on)];
    out.push_back(layers[i]);
    out.back().thickness += tops[i] - top;
    out.back().from.reset();
    out.back().to.reset();
    top = tops[i] + layers[i].thickness;
  }
  return out;
}

std::vector<LayerSpec> layers_across(std::vector<LayerSpec> layers, double rail_y, double wheel_y) {
  for (LayerSpec& layer : layers) layer.thickness = layer.thickness_at(layer.on == BodyId::rail ? rail_y : wheel_y);
  return layers;
}

}  // namespace railstrata
