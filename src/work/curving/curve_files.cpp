#include "curving/curve_files.hpp"

#include <fmt/format.h>

#include <string>

#include "many/case_row.hpp"
#include "record/csv.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

struct CurvingRow {
  const BogieInCurve* bogie;
  std::size_t axle, side;
  const WheelsetInCurve& wheelset() const { return bogie->wheelsets[axle]; }
  const WheelForces& wheel() const { return wheelset().forces.wheels[side]; }
};

const char* axle_word(std::size_t axle) { return axle == 0 ? "leading" : "trailing"; }
/// Guiding force, of the wheel on the rail outwards.
double guiding(const WheelForces& wheel) { return -wheel.force.y; }

std::vector<CurvingRow> rows_of(const std::vector<BogieInCurve>& bogies) {
  std::vector<CurvingRow> out;
  for (const BogieInCurve& bogie : bogies)
    for (std::size_t axle : {0, 1})
      for (std::size_t side : {kLeft, kRight})
        if (bogie.fault.empty()) out.push_back({&bogie, axle, side});
  return out;
}

std::vector<TextColumn<CurvingRow>> columns() {
  using R = CurvingRow;
  return {{"bogie", [](const R& r) { return Json(r.bogie->name); }},
          {"axle", [](const R& r) { return Json(axle_word(r.axle)); }},
          {"rail", [](const R& r) { return Json(r.side == kLeft ? "outer" : "inner"); }},
          {"y_mm", [](const R& r) { return Json(1e3 * r.wheelset().state.y); }},
          {"yaw_mrad", [](const R& r) { return Json(1e3 * r.wheelset().state.yaw); }},
          {"roll_mrad", [](const R& r) { return Json(1e3 * r.wheelset().forces.roll); }},
          {"Q_kN", [](const R& r) { return Json(1e-3 * r.wheel().force.z); }},
          {"Y_kN", [](const R& r) { return Json(1e-3 * guiding(r.wheel())); }},
          {"creepage", [](const R& r) { return Json(r.wheelset().creepage[r.side]); }},
          {"contact_angle_mrad", [](const R& r) { return Json(1e3 * r.wheel().contact_angle); }},
          {"patches", [](const R& r) { return Json(std::to_string(r.wheel().patches)); }},
          {"friction_energy_N", [](const R& r) { return Json(r.wheel().dissipation / r.wheelset().state.speed); }}};
}

}  // namespace

void write_curving(const std::filesystem::path& file, const std::vector<std::string>& origin,
                   const std::vector<BogieInCurve>& bogies) {
  write_whole_file(file, csv_remarks(origin) + csv_lines(columns(), rows_of(bogies)));
}

Json curving_json(const std::vector<BogieInCurve>& bogies) {
  Json out{{"wheels", json_rows(columns(), rows_of(bogies))}, {"bogies", Json::array()}};
  for (const BogieInCurve& b : bogies) {
    Json one{{"name", b.name}, {"deficiency_m_s2", b.deficiency}, {"iterations", b.iterations}};
    if (b.fault.empty())
      one.update({{"frame_y_mm", 1e3 * b.frame_y}, {"frame_yaw_mrad", 1e3 * b.frame_yaw}});
    else
      one["fault"] = b.fault;
    out["bogies"].push_back(one);
  }
  return out;
}

ReportTable curving_table(const std::vector<BogieInCurve>& bogies) {
  ReportTable out{.id = "curving",
                  .title = "Where the wheelsets stand in the curve",
                  .note =
                      "Equilibrium at constant speed on smooth track. y and yaw from the track's axis, outwards "
                      "positive; Y: force of the wheel on the rail, outwards.",
                  .columns = {},
                  .rows = {}};
  add_rows(out, rows_of(bogies), columns());
  return out;
}

std::vector<std::string> curving_lines(const std::vector<BogieInCurve>& bogies) {
  std::vector<std::string> out{fmt::format("{:26} {:>7} {:>9}  {:>29}  {:>29}", "wheelset", "y mm", "yaw mrad",
                                           "outer: Q kN   Y kN  friction N", "inner: Q kN   Y kN  friction N")};
  for (const BogieInCurve& b : bogies) {
    if (!b.fault.empty()) {
      out.push_back(fmt::format("{}: {}", b.name, b.fault));
      continue;
    }
    for (std::size_t axle : {0, 1}) {
      const WheelsetInCurve& set = b.wheelsets[axle];
      std::string line = fmt::format("{:26} {:7.2f} {:9.2f}", fmt::format("{}, {}", b.name, axle_word(axle)),
                                     1e3 * set.state.y, 1e3 * set.state.yaw);
      for (const WheelForces& w : set.forces.wheels)
        line += fmt::format("  {:11.1f} {:6.1f} {:11.1f}", 1e-3 * w.force.z, 1e-3 * guiding(w),
                            w.dissipation / set.state.speed);
      out.push_back(line);
    }
  }
  return out;
}

}  // namespace railstrata
