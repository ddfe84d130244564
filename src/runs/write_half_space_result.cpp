#include "runs/run_bem.hpp"

#include <fmt/format.h>

#include "case/units.hpp"
#include "core/faults.hpp"
#include "io/geometry_json.hpp"
#include "io/placed_surfaces.hpp"
#include "io/result_files.hpp"
#include "io/summary_json.hpp"
#include "post/bem_summary.hpp"
#include "report/view.hpp"

namespace railstrata {
namespace {

constexpr double kSmallestCell = 0.02e-3, kLargestCell = 5e-3;

double length_of(const std::string& text) {
  try {
    return parse_quantity(text, dimension::kLength);
  } catch (const UnitError& e) {
    throw CaseError(fmt::format("--cell \"{}\": {}", text, e.what()), e.remedy);
  }
}

}  // namespace

CaseSpec half_space_case(CaseSpec spec) {
  if (!spec.run.rolling) spec.drive.traction_coefficient = spec.drive.friction_coefficient = 0;
  return spec;
}

double cell_size(const std::string& text) {
  if (text.empty()) return BemOptions{}.cell;
  const double cell = length_of(text);
  if (!(cell >= kSmallestCell && cell <= kLargestCell))
    throw CaseError(fmt::format("--cell \"{}\" is out of range", text), "write a length from 0.02 mm to 5 mm");
  return cell;
}

void write_bem_result(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                      const BemResult& result, const Summary& summary) {
  write_patch_tables(folder, provenance, result.field);
  const StressMaximum& deepest = summary.rail.subsurface->von_mises;
  write_depth_line(folder / "depth_line.csv", provenance,
                   rail_depth_line(result, deepest.x, deepest.y, depth_of_interest(result.rail, summary.contact)));
  const double centre_y = centre_line(result.field).y;
  write_sections(folder, "rail", provenance,
                 rail_sections(result, deepest.x, centre_y, depth_of_interest(result.rail, summary.contact)));
  write_sections(folder, "wheel", provenance,
                 wheel_sections(result, summary.wheel.subsurface->von_mises.x, centre_y,
                                depth_of_interest(result.wheel, summary.contact)));
  write_vtp(folder / "patch.vtp", patch_mesh(result.field, summary.position));
  write_summary(folder / "summary.json", summary);
}

void write_bem_geometry(const std::filesystem::path& folder, const CaseSpec& spec, const Placement& placement,
                        double wheel_x) {
  write_geometry(folder / "geometry.json", spec, placement);
  write_placed_surfaces(folder, placement, wheel_x);
  write_view_script(folder);
}

}  // namespace railstrata
