#include "export/dyna_deck.hpp"

#include <fmt/format.h>

#include "core/faults.hpp"
#include "export/deck_text.hpp"

namespace railstrata {
namespace {

constexpr long kMostNumbers = 99'999'999;
constexpr int kFixedSet = 1, kBoreSet = 2, kRailSurface = 1, kWheelSurface = 2;
constexpr int kTouch = 1, kLoad = 2;  // curves

class DynaWriter {
 public:
  DynaWriter(const SolidModel& model, bool friction) : model_(model), friction_(friction) {}

  std::string text() {
    if (axle() > kMostNumbers)
      throw CaseError("the mesh has more nodes than LS-DYNA's standard columns can number",
                      "make it coarser: mesh.element_size");
    add(out_, "*KEYWORD\n*TITLE\nRailStrata: {:.60}\n", one_line(model_.title));
    add(out_, "$ units: mm, t, s, N, MPa; x rolling direction, y to the field side, z up\n");
    add(out_, "$ static preload, {:.1f} N on the rail; README.txt lists what was not carried over\n",
        model_.static_load);
    nodes();
    body(model_.rail, "rail", 0, 0);
    body(model_.wheel, "wheel", rail_nodes(), static_cast<long>(model_.rail.cells.size()));
    surface(model_.rail, kRailSurface, 0);
    surface(model_.wheel, kWheelSurface, rail_nodes());
    supports();
    contact();
    control();
    out_ += "*END\n";
    return std::move(out_);
  }

 private:
  long rail_nodes() const { return static_cast<long>(model_.rail.points.size()); }
  long axle() const { return rail_nodes() + static_cast<long>(model_.wheel.points.size()) + 1; }

  void node(long number, Vec3 at) {
    const Vec3 p = kToMilli * at;
    add(out_, "{:8}{:16.8e}{:16.8e}{:16.8e}\n", number, p.x, p.y, p.z);
  }
  void nodes() {
    out_ += "*NODE\n";
    long n = 0;
    for (const SolidBody* b : {&model_.rail, &model_.wheel})
      for (const Vec3& p : b->points) node(++n, p);
    node(axle(), model_.axle);
  }

  void body(const SolidBody& b, const char* name, long node0, long cell0) {
    const int first_part = parts_ + 1;
    for (std::size_t m = 0; m < b.materials.size(); ++m) {
      const int part = ++parts_;
      const Elastic& e = b.materials[m];
      add(out_, "*PART\n{} {:.60}\n{:10}{:10}{:10}\n", name, one_line(b.material_names[m]), part, part, part);
      add(out_, "*SECTION_SOLID\n{:10}{:10}\n", part, model_.one_point ? 1 : -1);
      add(out_, "*MAT_ELASTIC\n{:10}{:10.4g}{:10.6g}{:10.6g}\n", part, kTonnesPerCubicMetre * e.density,
          kToMega * young(e), poisson(e));
    }
    out_ += "*ELEMENT_SOLID\n";
    for (std::size_t e = 0; e < b.cells.size(); ++e) {
      add(out_, "{:8}{:8}", cell0 + static_cast<long>(e) + 1, first_part + b.material[e]);
      for (const long n : b.cells[e]) add(out_, "{:8}", node0 + n + 1);
      out_ += '\n';
    }
    for (const HangingNode& h : b.hanging)
      for (int i = 1; i <= 3; ++i) {
        add(out_, "*CONSTRAINED_LINEAR_GLOBAL\n{:10}\n{:10}{:10}{:10.6f}\n", ++constraints_, node0 + h.node + 1, i,
            -1.0);
        for (const HangingNode::Carrier& c : h.carriers)
          add(out_, "{:10}{:10}{:10.7f}\n", node0 + c.node + 1, i, c.weight);
      }
  }

  void surface(const SolidBody& b, int set, long node0) {
    add(out_, "*SET_SEGMENT\n{:10}\n", set);
    for (const SurfaceFace& f : b.face) {
      for (const long n : f.nodes) add(out_, "{:10}", node0 + n + 1);
      out_ += '\n';
    }
  }

  void node_set(int set, const std::vector<long>& members, long node0) {
    add(out_, "*SET_NODE_LIST\n{:10}\n", set);
    for (std::size_t k = 0; k < members.size(); ++k)
      add(out_, "{:10}{}", node0 + members[k] + 1, k % 8 == 7 || k + 1 == members.size() ? "\n" : "");
  }

  void supports() {
    node_set(kFixedSet, model_.rail.prescribed, 0);
    add(out_, "*BOUNDARY_SPC_SET\n{:10}{:10}{:10}{:10}{:10}\n", kFixedSet, 0, 1, 1, 1);
    std::vector<long> bore = model_.wheel.prescribed;
    bore.push_back(static_cast<long>(model_.wheel.points.size()));
    node_set(kBoreSet, bore, rail_nodes());
    // the rigid bore moves along z alone: no x, no y, no rotation
    add(out_, "*CONSTRAINED_NODAL_RIGID_BODY_SPC\n{:10}{:10}{:10}{:10}\n{:10.1f}{:10}{:10}\n", parts_ + 1, 0, kBoreSet,
        axle(), 1.0, 4, 7);
    add(out_, "*DEFINE_CURVE\n{:10}\n{:20.6f}{:20.6f}\n{:20.6f}{:20.6f}\n", kTouch, 0.0, 0.0, 1.0, 1.0);
    add(out_, "*DEFINE_CURVE\n{:10}\n{:20.6f}{:20.6f}\n{:20.6f}{:20.6f}\n{:20.6f}{:20.6f}\n", kLoad, 0.0, 0.0, 1.0, 0.0,
        2.0, 1.0);
    out_ += "$ the axle is moved down until the bodies touch, from time 1 on it carries the load\n";
    add(out_, "*BOUNDARY_PRESCRIBED_MOTION_RIGID\n{:10}{:10}{:10}{:10}{:10.3g}{:10}{:10.3f}{:10.3f}\n", parts_ + 1, 3,
        2, kTouch, -kFirstPush * kToMilli * model_.approach, 0, 1.0, 0.0);
    add(out_, "*LOAD_RIGID_BODY\n{:10}{:10}{:10}{:10.7g}\n", parts_ + 1, 3, kLoad, -model_.axle_load);
    add(out_, "*LOAD_BODY_Z\n{:10}{:10.7g}\n", kLoad, kToMilli * kGravity);
  }

  void contact() {
    add(out_, "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n{:10}{:10}{:10}{:10}\n", kRailSurface, kWheelSurface, 0, 0);
    const double f = friction_ ? model_.friction : 0.0;
    add(out_, "{:10.4f}{:10.4f}\n{:10.1f}{:10.1f}\n", f, f, 1.0, 1.0);
  }

  void control() {
    add(out_, "*CONTROL_IMPLICIT_GENERAL\n{:10}{:10.3f}\n", 1, 0.25);
    add(out_, "*CONTROL_IMPLICIT_AUTO\n{:10}\n", 1);
    add(out_, "*CONTROL_TERMINATION\n{:10.3f}\n", 2.0);
    add(out_, "*DATABASE_BINARY_D3PLOT\n{:10.3f}\n", 1.0);
    add(out_, "*DATABASE_RCFORC\n{:10.3f}\n", 0.25);
  }

  const SolidModel& model_;
  bool friction_;
  int parts_ = 0;
  long constraints_ = 0;
  std::string out_;
};

}  // namespace

std::string dyna_deck(const SolidModel& model, bool friction) { return DynaWriter(model, friction).text(); }

}  // namespace railstrata
