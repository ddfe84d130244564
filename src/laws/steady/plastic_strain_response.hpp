#pragma once
// The strain with which a body of elastic layers answers to plastic strain: div S = 0, S = C : (e(u) - E^p), no
// tractions on the surface, at rest far below, periodic along x and y, no mean strain along them (an endless rail).
//
// Fourier series along x and y turn it into one problem over depth for every pair of wave numbers, and in the axes n
// along the wave and m across it into two with real matrices: u_n and u_z (2 x 2 blocks), u_m alone. Over depth linear
// elements with one point each; rows below those of the plastic strain grow until the longest wave has died away. They
// carry no load and are eliminated first, so that a solution walks through the plastic rows alone. Derivatives along x
// and y are those of cells with one point, i k -> i (2/dx) tan(k dx/2), which the shortest waves find infinitely stiff:
// second order, as the depth. [Willot2015]
#include <complex>
#include <memory>
#include <vector>

#include "core/array.hpp"
#include "fft/fft.hpp"
#include "steady/steady_grid.hpp"

namespace railstrata {

/// Lamé's constants, Pa.
struct RowModuli {
  double lambda = 0, mu = 0;
};

class PlasticStrainResponse {
 public:
  /// rows: of the grid's rows; below: of everything under them.
  PlasticStrainResponse(SteadyGrid grid, std::vector<RowModuli> rows, RowModuli below);
  ~PlasticStrainResponse();
  PlasticStrainResponse(const PlasticStrainResponse&) = delete;
  PlasticStrainResponse& operator=(const PlasticStrainResponse&) = delete;

  const SteadyGrid& grid() const { return grid_; }
  const std::vector<RowModuli>& rows() const { return moduli_; }

  /// strain (SteadyGrid::size(), tensor shears) of the plastic strain given in the same order, whose trace is zero.
  /// `field` holds the plastic strain and then the strain. The same bits for any number of threads; one call at a time.
  /// surface, if not null: displacement of the surface along x, y and z (down), m, a plane each; along y and z from
  /// rest far below, periodic as the rest, each value the mean around its station and column as the strains are.
  /// rows, if not empty: those that count; the others have no plastic strain and stay as they are.
  void apply(Field& field, Field* surface = nullptr, const std::vector<bool>& rows = {}) const;

 private:
  struct Wave;
  void factorize(int kx, int ky);
  void solve(int kx, int ky, bool with_surface, const std::vector<int>& rows) const;

  SteadyGrid grid_;
  std::vector<RowModuli> moduli_;
  RowModuli below_;
  int width_;                  // wave numbers along y
  std::vector<double> deep_;   // m, thickness of the rows below
  std::vector<Wave> factors_;  // (nx/2 + 1) * width_ * (rows + 1)
  mutable std::vector<std::complex<double>> spectrum_;
  std::unique_ptr<RealPlaneFft> fft_;
};

}  // namespace railstrata
