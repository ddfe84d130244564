#include "export/abaqus_deck.hpp"

#include <fmt/format.h>

#include "export/deck_text.hpp"

namespace railstrata {
namespace {

constexpr double kStiffness = 50;  // of the contact's springs, of Young's modulus over an element: penetrations of
                                   // some p/50 E h, a thousandth of the approach

class DeckWriter {
 public:
  DeckWriter(const SolidModel& model, const AbaqusDeckOptions& options) : model_(model), options_(options) {}

  std::string text() {
    heading();
    body(model_.rail, "RAIL", 0, 0);
    body(model_.wheel, "WHEEL", rail_nodes(), static_cast<long>(model_.rail.cells.size()));
    supports();
    contact();
    steps();
    return std::move(out_);
  }

 private:
  bool calculix() const { return options_.flavour == DeckFlavour::calculix; }
  long rail_nodes() const { return static_cast<long>(model_.rail.points.size()); }
  long axle() const { return rail_nodes() + static_cast<long>(model_.wheel.points.size()) + 1; }

  void heading() {
    add(out_, "*HEADING\nRailStrata: {}\n", one_line(model_.title));
    add(out_, "** units: mm, t, s, N, MPa; x rolling direction, y to the field side, z up\n");
    add(out_, "** static preload, {:.1f} N on the rail; README.txt lists what was not carried over\n",
        model_.static_load);
  }

  void body(const SolidBody& b, const char* name, long node0, long cell0) {
    add(out_, "*NODE, NSET=N_{}\n", name);
    for (std::size_t n = 0; n < b.points.size(); ++n) {
      const Vec3 p = kToMilli * b.points[n];
      add(out_, "{}, {:.9g}, {:.9g}, {:.9g}\n", node0 + static_cast<long>(n) + 1, p.x, p.y, p.z);
    }
    for (std::size_t m = 0; m < b.materials.size(); ++m) elements(b, name, static_cast<int>(m), node0, cell0);
    add(out_, "*SURFACE, NAME=S_{}, TYPE=ELEMENT\n", name);
    for (const SurfaceFace& f : b.face) add(out_, "{}, S{}\n", cell0 + f.cell + 1, 3 + f.edge);
    for (const HangingNode& h : b.hanging) equation(h, node0);
  }

  void elements(const SolidBody& b, const char* name, int material, long node0, long cell0) {
    const std::string set = material == 0 ? fmt::format("{}_MATRIX", name) : fmt::format("{}_LAYER_{}", name, material);
    add(out_, "** {}: {}\n*ELEMENT, TYPE={}, ELSET={}\n", name, one_line(b.material_names[material]),
        model_.one_point ? "C3D8R" : "C3D8I", set);
    for (std::size_t e = 0; e < b.cells.size(); ++e) {
      if (b.material[e] != material) continue;
      add(out_, "{}", cell0 + static_cast<long>(e) + 1);
      for (const long n : b.cells[e]) add(out_, ", {}", node0 + n + 1);
      out_ += '\n';
    }
    const Elastic& m = b.materials[material];
    add(out_, "*MATERIAL, NAME=M_{}\n*ELASTIC\n{:.9g}, {:.9g}\n*DENSITY\n{:.9g}\n", set, kToMega * young(m), poisson(m),
        kTonnesPerCubicMetre * m.density);
    add(out_, "*SOLID SECTION, ELSET={}, MATERIAL=M_{}\n", set, set);
  }

  void equation(const HangingNode& h, long node0) {
    for (int i = 1; i <= 3; ++i) {
      add(out_, "*EQUATION\n{}\n{}, {}, -1.", h.carriers.size() + 1, node0 + h.node + 1, i);
      int on_line = 1;
      for (const HangingNode::Carrier& c : h.carriers) {
        out_ += on_line++ % 4 == 0 ? "\n" : ", ";
        add(out_, "{}, {}, {:.12f}", node0 + c.node + 1, i, c.weight);
      }
      out_ += '\n';
    }
  }

  void supports() {
    add(out_, "*NSET, NSET=FIXED\n");
    for (const long n : model_.rail.prescribed) add(out_, "{}\n", n + 1);
    const Vec3 p = kToMilli * model_.axle;
    add(out_, "*NODE, NSET=AXLE\n{}, {:.9g}, {:.9g}, {:.9g}\n", axle(), p.x, p.y, p.z);
    add(out_, "*NSET, NSET=BORE\n");
    for (const long n : model_.wheel.prescribed) add(out_, "{}\n", rail_nodes() + n + 1);
    add(out_, "** the bore moves up and down with the axle\n");
    for (const long n : model_.wheel.prescribed)
      add(out_, "*EQUATION\n2\n{}, 3, -1., {}, 3, 1.\n", rail_nodes() + n + 1, axle());
    add(out_, "*BOUNDARY\nFIXED, 1, 3\nBORE, 1, 2\nAXLE, 1, 2\n");
    add(out_, "*ELSET, ELSET=ALL\n");
    for (const auto& [body, name] : {std::pair{&model_.rail, "RAIL"}, std::pair{&model_.wheel, "WHEEL"}})
      for (std::size_t m = 0; m < body->materials.size(); ++m)
        out_ += m == 0 ? fmt::format("{}_MATRIX\n", name) : fmt::format("{}_LAYER_{}\n", name, m);
  }

  void contact() {
    add(out_, "*SURFACE INTERACTION, NAME=RUNNING\n");
    const double modulus = kToMega * young(model_.rail.materials.front()),
                 stiffness = kStiffness * modulus / (kToMilli * model_.element_size);
    if (calculix())
      add(out_, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{:.6g}\n", stiffness);
    else
      add(out_, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n");
    if (options_.friction) {
      add(out_, "*FRICTION\n");
      if (calculix())
        add(out_, "{:.6g}, {:.6g}\n", model_.friction, 0.1 * stiffness);
      else
        add(out_, "{:.6g}\n", model_.friction);
    }
    add(out_, "** the rail is the slave (secondary) surface\n");
    add(out_, "*CONTACT PAIR, INTERACTION=RUNNING, TYPE={}\nS_RAIL, S_WHEEL\n",
        calculix() ? "MORTAR" : "SURFACE TO SURFACE");
  }

  void steps() {
    const double push = kFirstPush * kToMilli * model_.approach;
    add(out_, "** 1: the axle is moved down until the bodies touch\n*STEP, NLGEOM\n*STATIC\n1., 1.\n");
    add(out_, "*BOUNDARY\nAXLE, 3, 3, {:.9g}\n*END STEP\n", -push);
    add(out_, "** 2: it carries the load\n*STEP, NLGEOM, INC=200\n*STATIC\n1., 1.\n");
    add(out_, "*BOUNDARY, OP=NEW\nFIXED, 1, 3\nBORE, 1, 2\nAXLE, 1, 2\n");
    add(out_, "*CLOAD\nAXLE, 3, {:.9g}\n", -model_.axle_load);
    add(out_, "*DLOAD\nALL, GRAV, {:.9g}, 0., 0., -1.\n", kToMilli * kGravity);
    output();
    add(out_, "*END STEP\n");
  }

  void output() {
    if (calculix()) {
      add(out_, "*NODE FILE\nU\n*EL FILE\nS\n*CONTACT FILE\nCDIS, CSTR\n");
      add(out_, "*NODE PRINT, NSET=AXLE\nU\n*NODE PRINT, NSET=FIXED, TOTALS=ONLY\nRF\n");
      return;
    }
    add(out_, "*OUTPUT, FIELD, VARIABLE=PRESELECT\n*CONTACT OUTPUT\nCSTRESS, CDISP\n*OUTPUT, HISTORY\n");
    add(out_, "*NODE OUTPUT, NSET=AXLE\nU3\n");
  }

  const SolidModel& model_;
  const AbaqusDeckOptions& options_;
  std::string out_;
};

}  // namespace

std::string abaqus_deck(const SolidModel& model, const AbaqusDeckOptions& options) {
  return DeckWriter(model, options).text();
}

}  // namespace railstrata
