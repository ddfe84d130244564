#pragma once
// The narrow waist: what a contact solution is, whichever engine made it.
#include <cstdint>
#include <vector>

namespace railstrata {

enum class ContactState : std::uint8_t { separated = 0, stick = 1, slip = 2 };

/// A contact solution on a grid of points of the rail's surface. Tractions act ON THE RAIL; p >= 0 in compression. x is
/// measured from the wheel's axle in the rolling direction (leading edge x > 0), y in the model frame. Index i = column
/// + columns * station; columns run with y, stations with x. A driving wheel pulls the rail backwards: q_x < 0. Slip is
/// the velocity of the wheel's surface relative to the rail's, m/s.
struct ContactField {
  int columns = 0, stations = 0;
  std::vector<double> x, y, z;         ///< m, position of the points (z: model frame)
  std::vector<double> area;            ///< m², of the surface each point stands for
  std::vector<double> p, q_x, q_y;     ///< Pa
  std::vector<double> slip_x, slip_y;  ///< m/s, or m: see slip_is_distance
  std::vector<ContactState> state;
  /// W/m², of the element ahead of a point, means over the time in which it is passed: q·slip, and p over the path of
  /// the slips. Empty: of q, p and slip above, which are states of single moments in finite elements.
  std::vector<double> friction_power, pressed_slip;
  std::vector<double> bound;      ///< Pa, what a sticking point carries at most; empty: in proportion to p
  bool at_points = false;         ///< values are those of points (finite elements), not means over cells
  bool slip_is_distance = false;  ///< of a shift, which has no speed: m, over its last increment
  double p_noise = 0;             ///< Pa, points with p below this count as separated in areas and ratios
  double line_length = 0;         ///< m, of a line contact: its columns are equal; 0: none

  int size() const { return columns * stations; }
  void resize(int columns_, int stations_) {
    columns = columns_;
    stations = stations_;
    const auto n = static_cast<std::size_t>(size());
    for (auto* a : {&x, &y, &z, &area, &p, &q_x, &q_y, &slip_x, &slip_y}) a->assign(n, 0.0);
    state.assign(n, ContactState::separated);
  }
};

}  // namespace railstrata
