#pragma once
// A step of the interfaces below layers that have come off their base (mesh/swept.hpp, SplitInterface). Outside their
// stretches both nodes of a pair have one acceleration, that of both their forces on both their masses; within them
// they meet by fem/interface_law.hpp.
#include <vector>

#include "body/body.hpp"
#include "fem/interface_law.hpp"

namespace railstrata {

/// J, dissipated.
struct InterfaceLosses {
  double friction = 0;
  double normal = 0;  ///< by nodes that meet
};

/// Largest of all pairs of nodes, m.
struct InterfaceGap {
  double opening = 0;
  double slip = 0;  ///< relative shift along the interface, of open pairs too
};

class InterfaceStep {
 public:
  explicit InterfaceStep(const Body& rail);

  bool none() const { return lines_.empty(); }
  /// Outside the stretches: shares the forces of each pair by its masses. f: like internal forces, positive against the
  /// motion.
  void join(Field& f) const;
  /// Adds the forces of contact to f. u: of the beginning of the step, v: of the half step before; damping_rate [1/s]:
  /// of the rail's run-up damping, which the update is to add.
  InterfaceLosses press(const Field& u, const Field& v, double dt, double damping_rate, Field& f);
  InterfaceGap gap(const Field& u) const;

 private:
  struct Line {
    std::ptrdiff_t above, below;  // of component x at the first station
    int stride;
    Vec3 normal;
    double friction;
    std::vector<StationRange> open, joined;
  };
  void add_line(const Body& rail, const SplitInterface& interface, int above, int below);
  InterfaceLosses press_line(const Line& line, const Field& u, const Field& v, double dt, double damping_rate,
                             Field& f) const;

  const Field& mass_;
  std::vector<Line> lines_;
  std::vector<InterfaceLosses> losses_;  // by line
};

}  // namespace railstrata
