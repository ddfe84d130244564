#pragma once
// Stress that is in a body's elements from the start, by quadrilateral, the same all along the sweep: what a process
// has left. It is the second Piola–Kirchhoff stress of the undeformed element, S = S0 + lambda tr(E) I + 2 mu E; the
// body deforms from there to its equilibrium.
//
// It enters as an eigenstress: the traversal takes -S0 off as it takes off what has yielded (body/plastic_pass.hpp),
// from rows of the same shape. Elements that are hot have it among their own numbers.
#include <array>
#include <functional>
#include <vector>

#include "core/array.hpp"

namespace railstrata {

struct SweptBody;

class InitialStress {
 public:
  /// Stress in the element's frame: 11 along the sweep, 22 lateral, 33 up, 12, 23, 13 [Pa].
  using Stress = std::array<double, 6>;
  using StressOf = std::function<Stress(int block, int quad)>;

  /// No initial stress.
  InitialStress() = default;
  InitialStress(const SweptBody& mesh, const StressOf& stress_of);

  bool empty() const { return kind_.empty(); }
  /// Eigenstress of a tile's elements, entry k at + k * kTile; null where there is no stress.
  const double* rows(int block, int quad) const {
    if (kind_.empty() || kind_[block][quad] < 0) return nullptr;
    return rows_[kind_[block][quad]].data();
  }

 private:
  std::vector<std::vector<int>> kind_;  ///< by block and quadrilateral, into rows_; -1: none
  std::vector<Field> rows_;             ///< of quadrilaterals with the same stress
};

}  // namespace railstrata
