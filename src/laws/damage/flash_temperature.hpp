#pragma once
// Flash temperature: how hot friction makes the surfaces while they pass through the contact, streamline by streamline.
// [CarslawJaeger1959 ch. 2.9; ErtzKnothe2002]
//
// A body that moves fast through the heat flux q_f conducts in depth alone:
//   dT(t) = integral of q(t') G(t - t') dt',    G(t) = 1/(e sqrt(pi t)),    e = sqrt(lambda rho c)
// t = s/V the time since the leading edge. Where the surfaces touch they have one temperature, so that bodies without
// layers share the heat as their effusivities e, like bodies by halves. A layer of thickness h on a base adds images,
// with alpha = (e_layer - e_base)/(e_layer + e_base) and kappa of the layer [CarslawJaeger1959 ch. 12]:
//   G(t) = 1/(e_layer sqrt(pi t)) (1 + 2 sum over n of alpha^n exp(-n² h²/(kappa t)))
//
// Range: Peclet number V a/(2 kappa) > 10 (wheel and rail: some 1000), material data of one temperature, no heat of
// plastic work, no film between the surfaces, both bodies as warm when they come. Integrals of the kernel over a cell
// are exact for piecewise constant heat flux.
#include <span>
#include <vector>

namespace railstrata {

struct ThermalMaterial {
  double conductivity = 0;     ///< lambda [W/(m K)]
  double density = 0;          ///< kg/m³
  double heat_capacity = 0;    ///< c [J/(kg K)]
  double effusivity() const;   ///< J/(m² K sqrt(s))
  double diffusivity() const;  ///< kappa [m²/s]
};

struct ThermalBody {
  ThermalMaterial base;
  double layer_thickness = 0;                ///< m; 0: no layer
  ThermalMaterial layer;                     ///< of the surface
  std::vector<ThermalMaterial> deeper = {};  ///< of further layers between it and the base: for the bounds alone
};

/// Friction power q·s per area of a row of cells [W/m²], in the order in which the material passes them: the leading
/// edge (largest x) first.
struct HeatedLine {
  std::span<const double> flux;
  double dx = 0;     ///< m
  double speed = 0;  ///< m/s
};

inline constexpr double kLeastPeclet = 10;

struct FlashTemperature {
  std::vector<double> rise;  ///< K, at the end of every cell (its trailing side)
  double max = 0;            ///< K
};

/// Layers exact in the sense above: rail and wheel have the same temperature at the end of every cell, the share of the
/// heat is constant in a cell. Throws std::invalid_argument for data that are not positive.
FlashTemperature flash_temperature(const HeatedLine& line, const ThermalBody& rail, const ThermalBody& wheel);

/// The largest rise with each layered body taken as a half-space of its most and of its least effusive material. Of a
/// given heat flux a layer's surface temperature lies between those of its material and of its base: the kernel lies
/// between 1/(e_layer sqrt(pi t)), which it has at first, and 1/(e_base sqrt(pi t)), which it tends to. Of several
/// layers, from the base up, so does the answer to every growing flux (the impedance of each layer on the ones below is
/// between the two). The smaller effusivity gives the upper bound.
struct FlashBounds {
  double lower = 0, upper = 0;  ///< K
};
FlashBounds flash_bounds(const HeatedLine& line, const ThermalBody& rail, const ThermalBody& wheel);

}  // namespace railstrata
