#include "io/summary_json.hpp"

#include <cmath>

#include "io/output_file.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

Json number(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }

Json maximum(const StressMaximum& m) {
  if (!std::isfinite(m.value)) return nullptr;
  return {{"value_Pa", m.value}, {"x_m", number(m.x)}, {"y_m", number(m.y)}, {"depth_m", number(m.depth)}};
}

Json pair(const std::optional<StressPair>& p) {
  if (!p) return nullptr;
  return {{"von_mises_max", maximum(p->von_mises)}, {"sigma1_max", maximum(p->sigma1)}};
}

Json stress(const StressSummary& s) {
  return {{"surface", pair(s.surface)},
          {"subsurface", pair(s.subsurface)},
          {"layer", pair(s.layer)},
          {"interface", pair(s.interface)},
          {"matrix", pair(s.matrix)}};
}

}  // namespace

Json summary_json(const Summary& s) {
  const ContactSummary& c = s.contact;
  const RunSummary& r = s.run;
  Json out;
  out["title"] = s.title;
  out["position_m"] = number(s.position);
  out["contact"] = {{"p_max_Pa", number(c.p_max)},
                    {"q_max_Pa", number(c.q_max)},
                    {"patch_length_m", number(c.patch_length)},
                    {"patch_width_m", number(c.patch_width)},
                    {"patch_area_m2", number(c.patch_area)},
                    {"slip_area_fraction", number(c.slip_area_fraction)},
                    {"F_x_N", number(c.F_x)},
                    {"F_y_N", number(c.F_y)},
                    {"F_z_N", number(c.F_z)},
                    {"contact_angle_rad", number(c.contact_angle)},
                    {"normal_force_N", number(c.normal_force)},
                    {"lateral_force_N", number(c.lateral_force)},
                    {"creepage_x", number(c.creepage_x)},
                    {"creepage_y", number(c.creepage_y)},
                    {"spin_per_m", number(c.spin_per_m)},
                    {"approach_m", number(c.approach)},
                    {"penetration_max_m", number(c.penetration_max)},
                    {"p_max_scatter", number(c.p_max_scatter)}};
  out["stress"] = {{"rail", stress(s.rail)}, {"wheel", stress(s.wheel)}};
  out["energy"] = {{"closure", number(s.energy.closure)}, {"hourglass_share", number(s.energy.hourglass_share)}};
  out["run"] = {{"engine", r.engine},
                {"wall_s", number(r.wall_s)},
                {"preload_wall_s", number(r.preload_wall_s)},
                {"output_wall_s", number(r.output_wall_s)},
                {"elements", r.elements},
                {"nodes", r.nodes},
                {"steps", r.steps},
                {"dt_s", number(r.dt_s)},
                {"stable_step_s", number(r.stable_step)},
                {"unscaled_step_s", number(r.unscaled_step)},
                {"added_mass_kg", number(r.added_mass)},
                {"local_stages", number(r.local_stages)},
                {"fine_elements", number(r.fine_elements)},
                {"element_steps_per_s", number(r.element_steps_per_s)},
                {"threads", r.threads},
                {"peak_memory_bytes", number(r.peak_memory_bytes)},
                {"commit", r.commit}};
  out["checks"] = Json::array();
  for (const Check& k : s.checks)
    out["checks"].push_back({{"name", k.name}, {"ok", k.ok}, {"value", number(k.value)}, {"limit", number(k.limit)}});
  out["warnings"] = Json::array();
  for (const Warning& w : s.warnings)
    out["warnings"].push_back(
        {{"name", w.name}, {"value", number(w.value)}, {"limit", number(w.limit)}, {"text", w.text}});
  return out;
}

void write_summary(const std::filesystem::path& file, const Summary& summary) {
  write_whole_file(file, summary_json(summary).dump(2) + "\n");
}

}  // namespace railstrata
