#include "fatigue/half_space_track.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "fatigue/one_track.hpp"
#include "result/patch.hpp"
#include "result/stress_of_half_space.hpp"

namespace railstrata {
namespace {

constexpr double kBox = 6;  // half-widths and half-lengths that the residual stress reaches

/// First and last place with pressure of every column of a patch.
class PatchEnds {
 public:
  explicit PatchEnds(const BemPatch& patch) : grid_(patch.grid) {
    for (int j = 0; j < grid_.ny; ++j) {
      ends_.push_back({0, 0});
      bool touched = false;
      for (int i = 0; i < grid_.nx; ++i) {
        if (!(patch.field.p[grid_.index(i, j)] > 0)) continue;
        if (!touched) ends_.back()[0] = grid_.x(i) - 0.5 * grid_.dx;
        ends_.back()[1] = grid_.x(i) + 0.5 * grid_.dx;
        touched = true;
      }
    }
  }
  std::array<double, 2> operator()(double y) const {
    const double v = std::clamp((y - grid_.y0) / grid_.dy, 0.0, grid_.ny - 1.001);
    const auto j = static_cast<std::size_t>(v);
    const double t = v - static_cast<double>(j);
    return {(1 - t) * ends_[j][0] + t * ends_[j + 1][0], (1 - t) * ends_[j][1] + t * ends_[j + 1][1]};
  }

 private:
  PatchGrid grid_;
  std::vector<std::array<double, 2>> ends_;
};

SingleTrackInput track_input(const CaseSpec& spec, const BemResult& r, const SectionShakedown& section) {
  const BemPatch& patch = section.patch == 0 ? r : r.further.at(section.patch - 1);
  const LayeredHalfSpace& body = section.body == BodyId::rail ? r.rail : r.wheel;
  const PatchMeasures m = measure_patch(patch.field);
  SingleTrackInput in;
  in.half_length = 0.5 * m.length;
  in.half_width = 0.5 * m.width;
  in.centre_x = 0.5 * (section.x_first + section.x_last);
  in.centre_y = 0.5 * (section.y.front() + section.y.back());
  for (const LayerExtent& layer : layer_extents(body)) in.interfaces.push_back(layer.bottom);
  const auto stress = std::make_shared<StressOfHalfSpace>(
      section.body == BodyId::rail ? rail_interior(body, patch) : wheel_interior(body, patch), in.interfaces,
      4.2 * in.half_length + std::abs(in.centre_x), kBox * in.half_width + std::abs(in.centre_y));
  in.stress = [stress](const std::vector<Vec3>& points, bool below) { return (*stress)(points, below); };
  in.shear_strength = shear_strength_by_depth(spec, section.body);
  in.ends = PatchEnds(patch);
  return in;
}

}  // namespace

void add_single_track(const CaseSpec& spec, const BemResult& result, std::vector<SectionShakedown>& sections) {
  for (SectionShakedown& section : sections) {
    if (!section.strength.any()) continue;
    section.single_track = result.grid.line
                               ? section.found.wandering.value
                               : one_track(section.found, [&] { return track_input(spec, result, section); });
  }
}

}  // namespace railstrata
