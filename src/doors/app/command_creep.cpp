#include <CLI/CLI.hpp>

#include <memory>

#include "app/common_options.hpp"
#include "app/creep_kinds.hpp"
#include "creep/creep_curve.hpp"
#include "usetab/usetab_file.hpp"

namespace railstrata {
namespace {

struct CreepOptions {
  CreepCurveOptions curve;
  CreepTableWords table;
  bool usetab = false;    ///< --usetab
  int usetab_cells = 20;  ///< --cells, along either axis of the ellipse
};

ExitCode command_creep(const CreepOptions& own, const CommandOptions& options) {
  if (own.usetab) return write_usetab(own.usetab_cells, options);
  if (options.case_file.empty())
    throw CaseError("creep: no case was named", "name a case file; --usetab alone takes none");
  return own.table.axes.empty() ? creep_curve_in_folder(own.curve, options) : creep_table_in_folder(own.table, options);
}

void declare_curve(CLI::App& sub, CreepCurveOptions& curve, CLI::Option* axis) {
  sub.add_option(
         "--of", curve.of,
         "What varies along a curve: creepage (longitudinal, default), lateral_creepage or spin; the rest is as "
         "in the case")
      ->check(CLI::IsMember(creep_curve_words()))
      ->excludes(axis);
  sub.add_option("--largest", curve.largest, "Of a curve: largest creepage (default: 0.02), or spin in 1/m (5)")
      ->check(CLI::Range(1e-6, 1000.0))
      ->check(finite())
      ->excludes(axis);
  sub.add_option("--points", curve.points,
                 "Of a curve: creepages, spaced geometrically over two and a half decades (default: 21)")
      ->check(CLI::Range(2, 1000))
      ->excludes(axis);
  sub.add_flag("--both-sides", curve.both_sides,
               "The curve through zero: driving and braking, slip to the gauge and to the field side")
      ->excludes(axis);
}

void declare_table(CLI::App& sub, CreepTableWords& table, CLI::Option* axis) {
  sub.add_option(
         "--scaled", table.scaled,
         "A table in scaled creepages, with so many angles of creepage, angles of spin and sizes (12:17:13); of "
         "the axes creepage_x, creepage_y and spin the ends count")
      ->type_name("ANGLES:SPINS:SIZES")
      ->needs(axis);
  sub.add_option("--places", table.places,
                 "Of a table: places where interpolation is compared with a solution (default: 200; 0: none)")
      ->check(CLI::Range(0, 100'000))
      ->needs(axis);
  sub.add_flag("--resume", table.resume, "Go on with a table that was stopped")->needs(axis);
}

CommandWork declare_creep(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<CreepOptions>();
  add_case(sub, options);
  sub.get_option("case")->required(false);
  auto* axis =
      add_repeated(sub, "--axis", own->table.axes, "WORD=VALUES",
                   "A table in place of a curve, over this axis: creepage_x, creepage_y, spin, load, friction, "
                   "lateral_shift, yaw or a key of the case; values \"v1,v2,...\", \"from:to:count\" or, dense about "
                   "0, \"+-largest:count\"; once for each axis");
  declare_curve(sub, own->curve, axis);
  declare_table(sub, own->table, axis);
  auto* usetab = sub.add_flag("--usetab", own->usetab,
                              "Kalker's table of ellipses of steel, as programs with a USETAB reader take it; no case")
                     ->excludes(axis);
  sub.add_option("--cells", own->usetab_cells, "Of --usetab: cells along either axis of the ellipse (default: 20)")
      ->check(CLI::Range(6, 100))
      ->needs(usetab);
  add_output(sub, options, "results/<case name>-creep-curve, -creep-table, results/usetab");
  add_cell(sub, options);
  add_no_report(sub, options);
  return [own, &options] { return command_creep(*own, options); };
}

}  // namespace

extern const Command kCreepCommand{
    "creep", "Creep forces: a curve against creepage or spin, or a table over axes of your choice for vehicle codes",
    "Examples:\n  railstrata creep cases/paper/base.toml\n  railstrata creep cases/paper/layer_3mm_2E0.toml --of "
    "lateral_creepage --both-sides --set drive.traction_coefficient=0\n  railstrata creep cases/paper/base.toml --axis "
    "creepage_x=+-0.02:21 --axis creepage_y=+-0.02:21 --axis load=\"40 kN,80 kN,120 kN\" --out results/table\n  "
    "railstrata creep cases/paper/base.toml --scaled 12:17:13 --axis creepage_x=-0.02,0.02 --axis "
    "creepage_y=-0.02,0.02 --axis spin=\"-0.5,0.5 1/m\" --out results/scaled-table\n  railstrata creep --usetab "
    "--out results/usetab\n\nCtrl-C: a table keeps what is solved, --resume goes on with it.\n",
    declare_creep};

}  // namespace railstrata
