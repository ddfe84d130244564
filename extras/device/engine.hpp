#pragma once
// The steps of a rolling on a device: elements, ties, added mass, ends, bore, contact, axle, suspension, node updates
// and the energy book. Between the records of a few steps nothing is copied (README.md).
#include "device/contact_arrays.hpp"
#include "device/step_kernels.hpp"
#include "fem/step_engine.hpp"

namespace railstrata::device {

/// Part of a system that a device cannot take, as a text for the user; empty: none.
std::string not_on_a_device(const RollingSystem& system);

class Engine : public StepEngine {
 public:
  Engine(Device& device, const RollingSystem& system, const RollingBodies& bodies, double dt);

  void load(const RestartState& state) override;
  void store(RestartState& state) override;
  std::span<const StepRecord> take(int count, bool energies) override;

  /// Internal forces alone, of all nodes: f at displacement u, turned by psi. For tests.
  void internal_force(std::size_t body, const Field& u, double psi, Field& f);

 private:
  struct State {
    State(Device& device, const RollingBody& body);
    SurfaceFields surface() const;
    SurfaceChains chains() const;
    BodyTables tables;
    DeviceArray<double> u, v, f;
    DeviceArray<double> node_sums, waiting_sums;  ///< of an update, [of UpdateSums][lane]
    DeviceArray<double> energies;                 ///< of elements, [strain, hourglass][lane]
    DeviceArray<double> stretch, added_kinetic;   ///< of the added mass: differences of v, a number a lane
  };
  /// Sums by trees of fixed shape.
  struct TreeSums {
    DeviceArray<double> even, odd;
  };
  /// Optional work of a step.
  struct StepKind {
    bool searches = false;  ///< the contact anew
    bool measured = false;  ///< the sums of its updates
    bool energies = false;
  };

  void step(const StepKind& kind);
  void start_step(const StepKind& kind);
  template <SweepKind kind, class Real>
  void element_forces(State& s);
  template <SweepKind kind, class Real, bool updates, bool measured>
  void node_forces(State& s);
  template <SweepKind kind, class Real>
  void forces_of(State& s, bool measured);
  template <SweepKind kind>
  void forces_of(State& s, bool measured);
  template <SweepKind kind>
  void energies_of(State& s, int body);
  template <SweepKind kind, bool before>
  void chain_energy(State& s, int body);
  void store_energies();
  template <SweepKind kind>
  void reduce_ties(State& s);
  void hold_ends();
  void bore_forces();
  void scale(State& s);
  void contact(bool searches);
  template <SweepKind kind>
  void update_waiting(State& s, bool measured);
  void add_up_updates(bool energies);
  template <SweepKind kind>
  void apply_ties(State& s);
  void sum(const DeviceArray<double>& numbers, std::ptrdiff_t sums, std::ptrdiff_t count, int result);
  View<const StepState> now() const { return now_.view(); }

  Device& device_;
  RollingLaw law_;
  std::vector<State> state_;  ///< by BodyId
  ContactArrays contact_;
  DeviceArray<EndDashpotRecord> dashpots_;
  DeviceArray<EndLoadRecord> end_loads_;
  DeviceArray<BoreRecord> bore_;
  DeviceArray<double> dashpot_power_, end_work_, bore_loads_, moments_;
  TreeSums tree_;
  DeviceArray<double> results_;
  DeviceArray<StepState> now_;
  DeviceArray<MassGroup> groups_;
  DeviceArray<StepRecord> log_;
  std::array<std::unique_ptr<Recording>, 4> recorded_;  ///< steps without energies, by StepKind
  // of the host
  std::vector<StepRecord> records_;
  double position_ = 0;  ///< m
  long step_ = 0;
};

}  // namespace railstrata::device
