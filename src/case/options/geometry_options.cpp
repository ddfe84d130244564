#include "options/option_slots.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using C = CaseSpec;
using G = GeometrySpec;

std::vector<Option> shape_options() {
  return {option("rail_profile", at<&C::geometry, &G::rail_profile>,
                 "A built-in name (see `railstrata info`), an arc, or a file (two columns, Simpack, MiniProf), "
                 "relative to the case file"),
          option("wheel_profile", at<&C::geometry, &G::wheel_profile>,
                 "A built-in name, an arc, or a file (two columns, Simpack, MiniProf), relative to the case file"),
          option("rail_mirror", at<&C::geometry, &G::rail_mirror>,
                 "A rail from a file: y is mirrored first, for a right-hand rail with its gauge side at y > 0"),
          option("rail_offset", at<&C::geometry, &G::rail_offset>,
                 "Rail profile from a file: offset added to y. For points measured from the gauge face of a head 72 mm "
                 "wide, into the head: \"-36 mm\"",
                 kLength, {-0.2, 0.2}),
          option("wheel_mirror", at<&C::geometry, &G::wheel_mirror>, "A wheel from a file: y is mirrored first"),
          option("wheel_offset", at<&C::geometry, &G::wheel_offset>,
                 "Wheel profile from a file: offset added to y. For points measured from the flange back: \"-70 mm\"",
                 kLength, {-0.2, 0.2}),
          choice_at<&C::geometry, &G::rail_shape>(
              "rail_shape", "Whole rail section, or a block with the profile on top (verification)",
              {{"rail", RailShape::rail}, {"block", RailShape::block}}),
          choice_at<&C::geometry, &G::wheel_shape>("wheel_shape", "Rim, web and hub, or a plain disc (verification)",
                                                   {{"wheel", WheelShape::wheel}, {"disc", WheelShape::disc}}),
          choice_at<&C::geometry, &G::contact>("contact",
                                               "point: a closed patch; line: a cylinder on a plane in plane strain "
                                               "(both profiles \"flat\", half-space engine)",
                                               {{"point", ContactShape::point}, {"line", ContactShape::line}}),
          option("line_length", at<&C::geometry, &G::line_length>,
                 "contact = \"line\": length that bears the load evenly", kLength, {0.1 * kMilli, 10.0})};
}

constexpr std::string_view kInclination =
    "this is the inclination of the rail, e.g. \"1:40\"; enter the superelevation of the track as loads and shifts";

std::vector<Option> track_options() {
  return {
      choice_at<&C::geometry, &G::track>(
          "track",
          "Track standard that supplies the defaults of gauge, gauge_depth, back_to_back, cant, wheel_radius and "
          "flange_back_to_tape. "
          "by_profile: chosen by the wheel profile (S1002: EN, LMA: CN); for a wheel profile from a file by the rail "
          "profile (UIC60, UIC54: EN, CN60: CN); otherwise CN. EN: 14 mm, 1360 mm, 460 mm; CN: 16 mm, 1353 mm, 430 mm; "
          "AAR: 15.875 mm, 1349.375 mm, 457.2 mm (gauge_depth, back_to_back, wheel_radius); flange_back_to_tape 70 mm, "
          "AAR "
          "72.23 mm; cant 1:40 in all",
          {{"by_profile", TrackKind::by_profile},
           {"EN", TrackKind::EN},
           {"CN", TrackKind::CN},
           {"AAR", TrackKind::AAR}}),
      option("gauge", at<&C::geometry, &G::gauge>, "Track gauge between the gauge faces", kLength, {0.5, 2.0}),
      option("gauge_depth", at<&C::geometry, &G::gauge_depth>,
             "Depth below the top of the rail at which the gauge is measured", kLength, {1 * kMilli, 50 * kMilli}),
      option("back_to_back", at<&C::geometry, &G::back_to_back>, "Distance between the inner faces of the two wheels",
             kLength, {0.4, 2.0}),
      option("flange_back_to_tape", at<&C::geometry, &G::flange_back_to_tape>,
             "Distance from the flange back to the tape circle", kLength, {10 * kMilli, 200 * kMilli}),
      option("cant", at<&C::geometry, &G::cant>, "Inclination of the rail towards the track centre (a tangent)", kSlope,
             {-0.2, 0.2})
          .with_remedy(kInclination),
      option("lateral_shift", at<&C::geometry, &G::lateral_shift>,
             "Lateral shift of the wheel, positive to the field side", kLength, {-0.05, 0.05}),
      option("yaw", at<&C::geometry, &G::yaw>,
             "Angle of attack: the wheel's rolling direction, turned about the vertical through the middle of its "
             "tape circle, positive towards the field side",
             kSlope, {-0.05, 0.05}),
      option("roll", at<&C::geometry, &G::roll>,
             "Roll of the wheelset about the rolling direction, through the middle of the tape circle's tread; "
             "positive with the field side up (a tangent); half-space engine",
             kSlope, {-0.1, 0.1}),
      option("curve_radius", at<&C::geometry, &G::curve_radius>,
             "Curve radius of the track, positive with the centre on the field side (inner wheel); not given: straight "
             "track. It changes only the spin; half-space engine",
             kLength, {-1e6, 1e6}),
      option("wheel_radius", at<&C::geometry, &G::wheel_radius>, "Radius at the tape circle", kLength,
             {5 * kMilli, 2.0}),
      option("rail_radius", at<&C::geometry, &G::rail_radius>,
             "Radius of the rail along the rolling direction, at the origin of its profile: a roller of a rig or "
             "the lower disc of a twin-disc machine; negative: hollow. Its axle is horizontal and normal to the "
             "rolling direction, under the middle of the tape circle. Not given: a straight rail",
             kLength, {-1e4, 1e4})};
}

std::vector<Option> body_options() {
  return {option("block_width", at<&C::geometry, &G::block_width>, "rail_shape = \"block\": width of the block",
                 kLength, {kMilli, 2.0}),
          option("block_height", at<&C::geometry, &G::block_height>, "rail_shape = \"block\": height of the block",
                 kLength, {kMilli, 2.0}),
          option("rim_thickness", at<&C::geometry, &G::wheel_section, &WheelSection::rim_thickness>,
                 "Radial distance from the tape circle to the inner face of the rim", kLength, {5 * kMilli, 0.5}),
          option("web_thickness", at<&C::geometry, &G::wheel_section, &WheelSection::web_thickness>,
                 "Thickness of the wheel's plate", kLength, {5 * kMilli, 0.2}),
          option("web_offset", at<&C::geometry, &G::wheel_section, &WheelSection::web_offset>,
                 "Lateral position of the plate's middle from the tape circle", kLength, {-0.07, 0.07}),
          option("hub_radius", at<&C::geometry, &G::wheel_section, &WheelSection::hub_radius>,
                 "Outer radius of the hub", kLength, {0.01, 1.0}),
          option("hub_width", at<&C::geometry, &G::wheel_section, &WheelSection::hub_width>, "Lateral width of the hub",
                 kLength, {0.01, 0.5}),
          option("bore_radius", at<&C::geometry, &G::wheel_section, &WheelSection::bore_radius>,
                 "Radius of the axle seat", kLength, {0.005, 1.0})};
}

}  // namespace

OptionTable geometry_table() {
  OptionTable out{"geometry", "Profiles, track and wheel", shape_options()};
  append(out.options, track_options());
  append(out.options, body_options());
  return out;
}

}  // namespace railstrata
