#pragma once
// A point of a material driven along a path: what a testing machine does to a specimen.
#include <array>
#include <vector>

#include "core/callable_ref.hpp"
#include "material/plastic.hpp"

namespace railstrata {

/// An elastic–plastic material (material/plastic.hpp) with its Lamé constants.
struct PlasticMaterial {
  double lambda = 0;  ///< Pa
  PlasticParameters<double> plastic{};
};

/// Limit of a uniaxial stress after much plastic strain, σ_y0 + Q + Σ C_i/γ_i [Pa]; infinite where a backstress
/// does not recall.
double largest_stress(const PlasticParameters<double>& p);

/// The difference of yield condition and zero over the yield stress, f/σ_y, of a state: < 0 in the elastic range, 0
/// while it flows. [Pa/Pa]
double yield_excess(const PlasticParameters<double>& p, const std::array<double, 6>& strain,
                    const std::array<double, kPlasticHistory<kMostBackstresses>>& history);

enum class Prescribed { strain, stress };

/// Components xx, yy, zz, xy, yz, xz (tensor shears). Straight between the points, from no strain and no stress at the
/// beginning to the first.
struct MaterialPath {
  std::array<Prescribed, 6> prescribed{};     ///< of each component
  std::vector<std::array<double, 6>> points;  ///< strain [-] or stress [Pa]
};

struct MaterialState {
  std::array<double, 6> strain{}, stress{};                          ///< -, Pa
  std::array<double, kPlasticHistory<kMostBackstresses>> history{};  ///< E^p, p, α_1 ..
  double dissipated = 0;                                             ///< J/m³ since the beginning
};

/// A point that the material cannot reach: no strain gives the stress.
struct BeyondMaterial {
  int point = 0;       ///< where the path goes to, counted from 0
  double reached = 0;  ///< share of the way to it from the point before
};

/// The states at the points, each reached in `increments` equal steps by backward Euler: the error falls with the first
/// power of the step. Stresses are met to 1e-9 of the yield stress by Newton's method on the strain. `at_increment`
/// sees every state, those at the points included. Throws BeyondMaterial, NumericalError where the law's fixed count of
/// iterations does not hold an increment this large.
std::vector<MaterialState> drive_path(const PlasticMaterial& material, const MaterialPath& path, int increments,
                                      CallableRef<void(const MaterialState&)> at_increment);

}  // namespace railstrata
