#include "export/export_readme.hpp"

#include "export/deck_text.hpp"

namespace railstrata {
namespace {

bool has_strength(const CaseSpec& spec) {
  const auto known = [](const MaterialSpec& m) {
    const StrengthSpec& s = m.strength;
    return !s.grade.empty() || s.yield_strength || s.hardness || !s.strength_table.empty() || !s.hardness_table.empty();
  };
  return known(spec.rail_material) || known(spec.wheel_material);
}

void add_deck_losses(std::vector<std::string>& out, const CaseSpec& spec) {
  if (spec.run.rolling) {
    out.emplace_back("the rolling: drive, run-up, time steps, absorbers at the ends of the rail, damping");
    out.emplace_back("the centrifugal forces of the rolling wheel, which the preload of a rolling case has");
    out.emplace_back("the suspension: its springs and dashpots; the sprung mass is a load on the axle");
  }
  out.emplace_back("the exact profiles between the nodes: here gaps are those of the profiles, there of the facets");
  for (const LayerSpec& layer : spec.layers)
    if (layer.graded())
      out.push_back("the modulus of layer \"" + one_line(layer.name) +
                    "\" within a row of elements: each has its mean");
}

void add_contact_losses(std::vector<std::string>& out, const CaseSpec& spec) {
  out.emplace_back("the bodies' shape away from the patch, which half-spaces do not have");
  out.emplace_back("displacement differences UN, UX, UY of the table: their columns are 0");
  if (!spec.layers.empty()) out.emplace_back("the layers: there is no case file for CONTACT; the results have them");
  if (spec.friction.law != FrictionForm::coulomb || spec.third_body.thickness)
    out.emplace_back("friction that falls with slip, or a film: the table's MU is the static coefficient");
  out.emplace_back("where the leading edge cuts a cell: CONTACT takes whole cells (bem.leading_edge)");
}

const char* how_to_run(ExportTarget target) {
  switch (target) {
    case ExportTarget::calculix:
      return "ccx preload          (CalculiX 2.20; Debian's package calculix-ccx)\n"
             "The contact is CalculiX's dual mortar method, as this program's.";
    case ExportTarget::abaqus:
      return "abaqus job=preload input=preload.inp\nNot run by this program's tests: CalculiX runs the same deck but "
             "for "
             "its output requests and contact stiffness.";
    case ExportTarget::lsdyna:
      return "i=preload.k, implicit, double precision. No solver has run it: its structure alone is checked.";
    case ExportTarget::contact:
      return "CONTACT: contact 2 rail. MATLAB or Octave with CONTACT's scripts: s = loadcase('rail', 1); plot3d(s)";
  }
  return "";
}

/// CalculiX's elements of mesh.element = "full", C3D8I, have three modes of their own for each component.
long equations(const SolidModel& m) {
  long out = 0;
  for (const SolidBody* b : {&m.rail, &m.wheel})
    out += 3 * static_cast<long>(b->points.size() - b->hanging.size() - b->prescribed.size()) +
           (m.one_point ? 0 : 9 * static_cast<long>(b->cells.size()));
  return out;
}

}  // namespace

std::vector<std::string> not_carried_over(const CaseSpec& spec, ExportTarget target) {
  std::vector<std::string> out;
  if (target == ExportTarget::contact)
    add_contact_losses(out, spec);
  else
    add_deck_losses(out, spec);
  if (spec.run.plasticity)
    out.emplace_back("run.plasticity: the materials are elastic, here they yield");
  else if (has_strength(spec))
    out.emplace_back("strengths and hardness: the materials are elastic, as in `run` and `bem` of this case");
  if (!spec.loads.empty()) out.emplace_back("the load collective: the files have the case without it");
  return out;
}

std::string export_readme(const CaseSpec& spec, ExportTarget target, const std::vector<std::string>& files,
                          bool friction, const std::string& comparison) {
  std::string out;
  add(out, "{}\n\nFiles\n", one_line(spec.title));
  for (const std::string& file : files) add(out, "  {}\n", file);
  add(out, "\nUnits: mm, N, MPa, s, tonnes. To run it:\n{}\n\nCarried over\n", how_to_run(target));
  if (target == ExportTarget::contact) {
    out += "  the solution of `railstrata bem`: grid, pressure, tractions, stick and slip, creepages, normal force\n";
  } else {
    out +=
        "  both meshes, the elastic material of every row of elements, hanging nodes as linear equations\n"
        "  the static preload: base of the rail fixed, axle guided, weight of both bodies, load on the axle\n";
    add(out, "  friction: {}\n", friction ? "the case's coefficient" : "none, as in the preload of this program");
  }
  out += "\nNot carried over\n";
  for (const std::string& line : not_carried_over(spec, target)) add(out, "  {}\n", line);
  out += "\nTo compare with\n" + comparison;
  return out;
}

std::string deck_comparison(const SolidModel& m, ExportTarget target) {
  std::string out =
      "  `railstrata run` of the same case with --set run.rolling=false, node by node: x_mm, y_mm, p_MPa of "
      "patch.csv.\n";
  if (target == ExportTarget::calculix)
    add(out,
        "  {} equations, as CalculiX prints them. By one thread 40905 took 9 s of processor time and 0.3 GB, 71478 "
        "took "
        "70 s\n  and 0.9 GB. Fewer: --set mesh.element=one_point, --set run.rolling=false, a larger mesh.largest or "
        "mesh.coarse_ratio,\n  a shorter mesh.end_length.\n",
        equations(m));
  if (target == ExportTarget::calculix)
    out +=
        "  Pressures are CSTR in preload.frd. Expect 0.4 % at the node of the largest one and 1 % of it elsewhere, "
        "which "
        "is what\n  was found with 4 to 8 elements over the patch.\n";
  add(out,
      "  Not the largest nodal pressure with p_max of summary.json: that is the top of a parabola through the nodes. "
      "The "
      "largest\n  node lies up to {:.1f} % below it here, where some {:.0f} elements along and {:.0f} across lie in "
      "the "
      "patch (Hertz).\n",
      100 * missed_by_nodes(m), 2 * m.a / m.element_size, 2 * m.b / m.element_size);
  return out;
}

std::string contact_comparison() { return "  `railstrata bem` of the same case and cells: patch.csv, summary.json\n"; }

}  // namespace railstrata
