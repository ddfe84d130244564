#include "runs/write_half_space_result.hpp"

#include <nlohmann/json.hpp>

#include "ask/judge.hpp"
#include "io/damage_files.hpp"
#include "io/geometry_json.hpp"
#include "io/result_files.hpp"
#include "io/summary_json.hpp"
#include "judge/bem_summary.hpp"
#include "report/assets.hpp"
#include "result/stress_sections.hpp"

namespace railstrata {

void write_half_space_result(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                             const CaseSpec& spec, const Placement& placement, const Answer& answer) {
  const BemResult& result = answer.result;
  const Summary& summary = answer.summary;
  std::vector<LoadedContact> contacts;
  std::vector<const ContactField*> fields;
  for (const BemPatch* p : patches_of(result)) {
    contacts.push_back({p->place, p->force.normal});
    fields.push_back(&p->field);
  }
  CaseSpec loaded = spec;
  if (answer.moment) loaded.vehicle.set_load(answer.moment->load);
  write_geometry(folder / "geometry.json", loaded, placement, contacts);
  write_placed_surfaces(folder, placement, summary.position);
  write_view_script(folder);
  write_patch_tables(folder, provenance, fields);
  const StressMaximum& deepest = summary.rail.subsurface->von_mises;
  const double rail_depth = depths_of_interest(result.rail, summary.contact).deepest;
  const double wheel_depth = depths_of_interest(result.wheel, summary.contact).deepest;
  write_depth_line(folder / "depth_line.csv", provenance, rail_depth_line(result, deepest.x, deepest.y, rail_depth));
  const double centre_y = centre_line(result.field).y;
  write_sections(folder, "rail", provenance, rail_sections(result, deepest.x, centre_y, rail_depth));
  write_sections(folder, "wheel", provenance,
                 wheel_sections(result, summary.wheel.subsurface->von_mises.x, centre_y, wheel_depth));
  write_vtp(folder / "patch.vtp", patch_mesh(fields, summary.position));
  write_streamlines(folder / "streamlines.csv", provenance, streamlines_of(answer.wear));
  write_shakedown(folder, provenance, summary, answer.shakedown);
  write_sliding_maps(folder, provenance, answer.sliding);
  if (answer.crack) write_crack(folder, provenance, *answer.crack);
  if (result.interface_slip) write_interface_slip(folder, provenance, *result.interface_slip);
  write_summary(folder / "summary.json", summary);
}

}  // namespace railstrata
