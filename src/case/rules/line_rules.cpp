#include "rules/line_rules.hpp"

#include <fmt/format.h>

#include <string>

#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

class LineRules {
 public:
  LineRules(const CaseSpec& spec, CaseSource& source) : spec_(spec), source_(source) {}

  void check() {
    if (!spec_.geometry.line_length)
      source_.complain("geometry.contact", "geometry.contact = \"line\" needs geometry.line_length",
                       "give the length that bears the load, e.g. line_length = \"20 mm\"");
    check_surfaces();
    check_drive();
    check_transient();
    refuse(!spec_.passes.lateral_positions.empty(), "passes.lateral_positions", "is the same at every place across",
           "leave it out, or give contact = \"point\"");
    refuse(spec_.passes.lateral_deviation.has_value(), "passes.lateral_deviation", "is the same at every place across",
           "leave it out, or give contact = \"point\"");
  }

 private:
  void refuse(bool asked, const char* key, const std::string& what, const char* remedy) {
    if (asked) source_.complain(key, fmt::format("{}: a line contact {}", key, what), remedy);
  }

  void check_surfaces() {
    const GeometrySpec& g = spec_.geometry;
    constexpr const char *kFlat = "give wheel_profile = \"flat\" and rail_profile = \"flat\", or contact = \"point\"",
                         *kLevel = "give 0, or contact = \"point\"";
    refuse(!is_flat(g.wheel_profile), "geometry.wheel_profile", "is that of a cylinder", kFlat);
    refuse(!is_flat(g.rail_profile), "geometry.rail_profile", "is that of a cylinder on a plane", kFlat);
    const std::string level = "lies level along the whole line";
    refuse(g.cant != 0, "geometry.cant", level, kLevel);
    refuse(g.roll != 0, "geometry.roll", level, kLevel);
    refuse(g.yaw != 0, "geometry.yaw", "rolls straight on", kLevel);
    refuse(g.lateral_shift != 0, "geometry.lateral_shift", "is the same at every place across", kLevel);
    refuse(g.curve_radius.has_value(), "geometry.curve_radius", "has no spin", "leave it out");
  }

  void check_drive() {
    const DriveSpec& d = spec_.drive;
    constexpr const char* kWithout = "leave it out, or give contact = \"point\"";
    const std::string straight = "is driven along the rail alone";
    refuse(d.lateral_creepage.has_value(), "drive.lateral_creepage", straight, kWithout);
    refuse(d.lateral_traction_coefficient.has_value(),
           source_.has("drive.lateral_force") ? "drive.lateral_force" : "drive.lateral_traction_coefficient", straight,
           kWithout);
    refuse(d.spin.has_value(), "drive.spin", "has no spin", kWithout);
    refuse(spec_.vehicle.approach.has_value(), "vehicle.approach",
           "has no approach: its distant points come together without end", "give a load");
  }

  /// In plane strain a force that changes moves distant points by any amount: creepages and displacements of a history
  /// have no meaning.
  void check_transient() {
    const TransientSpec& t = spec_.transient;
    if (t.kind == TransientKind::none) return;
    constexpr const char* kForce = "give transient.tractive_force or traction_coefficient";
    const std::string unknown = "follows a history of forces alone: displacements of distant points are not known",
                      straight = "is driven along the rail alone";
    refuse(!t.creepage.empty(), "transient.creepage", unknown, kForce);
    refuse(!t.displacement.empty(), "transient.displacement", unknown, kForce);
    refuse(t.kind == TransientKind::rolling && spec_.drive.creepage && t.tractive_force.empty() &&
               t.traction_coefficient.empty(),
           "drive.creepage", unknown, kForce);
    for (const auto& [column, key] :
         {std::pair(&t.lateral_force, "transient.lateral_force"),
          std::pair(&t.lateral_traction_coefficient, "transient.lateral_traction_coefficient"),
          std::pair(&t.lateral_creepage, "transient.lateral_creepage"),
          std::pair(&t.lateral_displacement, "transient.lateral_displacement"), std::pair(&t.spin, "transient.spin")})
      refuse(!column->empty(), key, straight, "leave it out");
  }

  static bool is_flat(const std::string& profile) {
    return profile == "flat" || profile == "Flat" || profile == "FLAT";
  }

  const CaseSpec& spec_;
  CaseSource& source_;
};

}  // namespace

void check_line_contact(const CaseSpec& spec, CaseSource& source) {
  if (spec.geometry.in_line()) return LineRules(spec, source).check();
  if (spec.geometry.line_length)
    source.complain("geometry.line_length", "geometry.line_length has no meaning with geometry.contact = \"point\"",
                    "take it out, or give contact = \"line\"");
}

}  // namespace railstrata
