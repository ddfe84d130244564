#pragma once
// The metal of a rail under a mixture of wheels: what has yielded, by arc length across the rail and depth below the
// surface of the day, and what one wheel of the mixture changes in it.
//
// Every patch of every kind of wheels rolls over its part of the same columns and rows (passes/rail_passes.hpp) from
// one state of the metal, and what it changes counts by the kind's share of all wheels: kinds feel what the others have
// done, a kind that is cut in two gives the same sum, and no kind has a number of passes or a trend of its own.
//
// Plastic strain that is compatible (of an endless rail: a displacement u(y, z)) leaves no stress, so passes do not
// depend on it; it is what ratchetting adds. Between two calls of roll() the state has the incompatible part alone,
// which together with the backstresses settles.
#include <array>
#include <memory>
#include <vector>

#include "damage/low_cycle.hpp"
#include "passes/rail_passes.hpp"
#include "steady/settle.hpp"

namespace railstrata {

/// A patch of a kind of wheels.
struct MetalWheel {
  RailPasses rail;   ///< of the patch alone, on the lattice of the metal
  int column = 0;    ///< of the metal, where its own first one is; may be outside
  double share = 1;  ///< of all wheels
};

/// Per point of the metal (row * columns + column), by one wheel of the mixture.
struct MetalFlow {
  std::vector<double> net;                    ///< equivalent plastic strain that stays: √(2/3 E:E), E of all kinds
  std::vector<std::array<double, 3>> cycles;  ///< Miner's sum of closed cycles, exponents of kLowCycleExponents
  std::vector<std::vector<double>> flowed;    ///< of each wheel: plastic strain p of its own pass
};

/// Columns and rows of the metal.
struct MetalGrid {
  double from = 0, apart = 0;  ///< m, of columns, arc length of the unworn rail
  int columns = 0;
  std::vector<double> thickness;  ///< m, of rows
  double s(int column) const { return from + column * apart; }
  std::size_t nearest(double s) const;  ///< column
  std::vector<double> depths() const;   ///< m, middles of rows
  std::size_t points() const { return thickness.size() * static_cast<std::size_t>(columns); }
};
/// Rows from `first` [m] on that grow by a quarter of their depth, at most 1 mm, down to `deepest`.
MetalGrid metal_grid(double from, double to, double apart, double first, double deepest);

class Metal {
 public:
  /// ductility: of Coffin and Manson; 0: no closed cycles are counted.
  Metal(MetalGrid grid, double ductility);
  ~Metal();
  Metal(Metal&&) noexcept;
  Metal& operator=(Metal&&) noexcept;

  const MetalGrid& grid() const { return grid_; }
  /// As PassState::history.
  const std::vector<double>& state() const { return state_; }
  /// Of the wheels at the present state.
  const MetalFlow& flow() const { return flow_; }

  /// The state of the same metal before; wheels must be put then.
  void stand(std::vector<double> state) { state_ = std::move(state); }
  /// Pa, residual stress of a column by rows, S = λ tr e I + 2µ (e - E^p), e the strain that the section answers with
  /// (steady/plastic_strain_response.hpp), a half of it and a quarter of either neighbour's:
  /// equilibrium lets stress alternate from column to column. Zero without wheels.
  std::vector<Sym3> residual(std::size_t column) const;
  /// Other wheels from now on.
  void put(std::vector<MetalWheel> wheels);
  /// The state after so many wheels of the mixture, in one implicit step (steady/settle.hpp).
  SettledState roll(double wheels, const SettleLimits& limits);
  /// The surface has sunk by so much [m], a number per column: what was below is nearer to it.
  void sink(const std::vector<double>& removed);

 private:
  struct Kind;
  StateChange change(const std::vector<double>& given);
  void pass(Kind& kind, const std::vector<double>& state, const std::vector<double>& strain) const;
  std::vector<double> compatible(const std::vector<double>& state) const;
  void strip(std::vector<double>& state) const;
  void add_pace(const std::vector<double>& state, const std::vector<double>& flowing, StateChange& change) const;
  double two_mu(std::size_t point) const;

  MetalGrid grid_;
  double ductility_;
  std::vector<double> state_;
  MetalFlow flow_;
  std::vector<std::unique_ptr<Kind>> kinds_;
  std::vector<SteadyRow> rows_;
  std::unique_ptr<PlasticStrainResponse> section_;
  StateChange first_;         ///< at state_
  std::vector<double> pace_;  ///< largest of the wheels there, of the last step
};

}  // namespace railstrata
