#include "collective/measured_wear.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/faults.hpp"
#include "geometry/read_profile.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

/// Where wheels roll, with some room on either side for wear that has moved.
std::vector<ProfileStretch> rolled_stretches(const RailDamage& damage) {
  constexpr double kRoom = 2e-3;  // m
  std::vector<ProfileStretch> out;
  for (std::size_t i = 0; i < damage.s.size(); ++i) {
    if (!(damage.passages[i] > 0)) continue;
    const double from = damage.s[i] - 0.5 * damage.cell - kRoom, to = damage.s[i] + 0.5 * damage.cell + kRoom;
    if (!out.empty() && from <= out.back().to)
      out.back().to = to;
    else
      out.push_back({from, to});
  }
  return out;
}

}  // namespace

MeasuredWear measured_wear(const std::vector<CollectiveRow>& rows, const RailDamage& damage,
                           const std::filesystem::path& before, const std::filesystem::path& after, double tonnes) {
  const CollectiveSpec& collective = rows.front().spec.collective;
  const Profile first = read_profile(ProfileKind::rail, before), second = read_profile(ProfileKind::rail, after);
  MeasuredWear out{.change = profile_change(first, second, rolled_stretches(damage)),
                   .tonnes = tonnes,
                   .own_factor = collective.wear_factor,
                   .law = collective.wear_law};
  double all = 0;
  for (const CollectiveRow& row : rows)
    if (row.sound()) all += row.tonnes();
  out.computed = worn_area(damage, damage.depth(out.law)) * tonnes / all;
  if (!(out.computed > 0))
    throw CaseError("the wear law of the case computes no wear, so there is no factor",
                    "give what collective.wear_law needs: for kth the rail's hardness, for archard its "
                    "wear_coefficient too");
  if (!(out.change.area > 0))
    throw CaseError(fmt::format("the second profile has {:.2f} mm² more metal than the first",
                                -unit::kSquareMillimetres.factor * out.change.area),
                    "give the older profile first, both of the same place and the same rail");
  return out;
}

std::string measured_text(const MeasuredWear& m) {
  constexpr double kFewOfWheels = 3;  // deviations
  const double mm2 = unit::kSquareMillimetres.factor, mm = unit::kMillimetres.factor;
  std::string text = fmt::format(
      "{:.3g} ± {:.2g} mm² worn in {:.3g} MGT (deepest {:.3g} mm at y = {:.1f} mm), {:.3g} mm² computed: factor {:.3g} "
      "± "
      "{:.2g}; write wear_factor = {:.3g} into [collective]; aligned over {:.0f} mm where no wheel rolls, {:.0f} µm "
      "left "
      "there",
      mm2 * m.change.area, mm2 * m.change.area_error, 1e-6 * m.tonnes, mm * m.change.deepest, mm * m.change.deepest_y,
      mm2 * m.computed, m.factor(), m.factor_error(), m.own_factor * m.factor(), mm * m.change.length,
      unit::kMicrometres.factor * m.change.left);
  if (m.change.area < kFewOfWheels * m.change.area_error)
    text += "; the wear is not far above what the measurements leave open: wait for more traffic";
  return text;
}

nlohmann::ordered_json measured_json(const MeasuredWear& m) {
  return {{"worn_area_m2", m.change.area},
          {"worn_area_error_m2", m.change.area_error},
          {"deepest_m", m.change.deepest},
          {"deepest_rail_y_m", m.change.deepest_y},
          {"tonnes_t", m.tonnes},
          {"computed_area_m2", m.computed},
          {"factor", m.factor()},
          {"factor_error", m.factor_error()},
          {"wear_factor", m.own_factor * m.factor()},
          {"aligned_m", m.change.length},
          {"left_m", m.change.left},
          {"shift_y_m", m.change.shift_y},
          {"shift_z_m", m.change.shift_z},
          {"turn_rad", m.change.turn}};
}

}  // namespace railstrata
