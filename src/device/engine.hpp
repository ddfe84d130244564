#pragma once
// The fields of a rolling on a device: elements, ties, added mass, ends, bore and node updates of every step. The
// contact, the axle and the energy book stay with the stepper, which gets the band around the contact (docs/gpu.md).
#include "device/body_tables.hpp"
#include "fem/step_engine.hpp"

namespace railstrata::device {

/// What a device cannot take of a system, in words for its user; empty: nothing. `local_steps`: of the step's plan.
std::string not_on_a_device(const RollingSystem& system, bool local_steps);

class Engine : public StepEngine {
 public:
  Engine(Device& device, const RollingSystem& system, const RollingBodies& bodies);

  void load(const BodyStates& states) override;
  void store(BodyStates& states) override;
  std::optional<Stored> stored_energy(const RollingBodies& bodies, const std::array<double, 2>& drift) override;
  Loads forces(const RollingBodies& bodies, const std::array<double, 2>& drift, const StepScope& scope,
               const AxlePose& pose, BodyStates& states) override;
  void add_forces(const std::array<std::vector<SurfaceForce>, 2>& forces) override;
  std::array<UpdateSums, 2> update(const RollingBodies& bodies, const StepScope& scope) override;
  void constrain(const AxlePose& pose) override;

  /// Bytes of the device's arrays.
  std::size_t bytes() const { return bytes_; }

  /// Internal forces alone, of all nodes: f at displacement u, turned by psi. For tests.
  void internal_force(std::size_t body, const Field& u, double psi, Field& f);

 private:
  /// A range of stations of a surface's lines.
  struct Band {
    int first = 0, count = 0;
  };
  struct State {
    State(Device& device, const RollingBody& body);
    BodyTables tables;
    DeviceArray<double> u, v, f;
    DeviceArray<double> node_sums, waiting_sums;  ///< of an update, [of NodeSums][lane]
    DeviceArray<SurfaceForceRecord> surface_forces;
    DeviceArray<double> energies;                ///< of elements, [strain, hourglass][lane]
    DeviceArray<double> stretch, added_kinetic;  ///< of the added mass: differences of v, a number a lane
  };
  /// Sums by trees of fixed shape.
  struct TreeSums {
    DeviceArray<double> even, odd;
  };
  /// Where numbers of the whole body stand in results_.
  enum Result {
    kBore = 0,
    kAbsorbed = 4,
    kMoment = 5,
    kSums = 6,
    kEnergies = 16,
    kHeight = 18,
    kAddedKinetic = 19,
    kResults = 24
  };
  static constexpr int kSumsOfNode = 5;

  template <SweepKind kind, class Real>
  void element_forces(State& s, const Rotation<double>& turn);
  template <SweepKind kind, class Real, bool updates, bool measured>
  void node_forces(State& s, const Rotation<double>& turn, const NodeStep& step);
  template <SweepKind kind, class Real>
  void forces_of(State& s, const RollingBody& body, const Rotation<double>& turn, const StepScope& scope);
  template <SweepKind kind>
  void forces_of(State& s, const RollingBody& body, const Rotation<double>& turn, const StepScope& scope);
  template <SweepKind kind>
  void energies_of(State& s, const RollingBody& body, const Rotation<double>& turn);
  template <SweepKind kind, bool before>
  void chain_energy(State& s, const RollingBody& body);
  std::span<const double> land_results();
  template <SweepKind kind>
  void update_waiting(State& s, const RollingBody& body, const StepScope& scope);
  void reduce_ties(State& s, const Rotation<double>& turn);
  void scale(State& s);
  void sum(const DeviceArray<double>& numbers, std::ptrdiff_t sums, std::ptrdiff_t count, int result);
  Band band(const RollingBody& body, double centre, double reach) const;
  std::ptrdiff_t pack(State& s, const RollingBody& body, const Band& band, std::ptrdiff_t at);
  const double* unpack(const RollingBody& body, const Band& band, const double* numbers, BodyState& state) const;

  Device& device_;
  double half_length_;  ///< m, of the band
  double radius_;       ///< m, rolling
  std::array<Vec3, 2> origin_;
  std::vector<State> state_;  ///< by BodyId
  DeviceArray<EndDashpotRecord> dashpots_;
  DeviceArray<EndLoadRecord> end_loads_;
  DeviceArray<BoreRecord> bore_;
  DeviceArray<double> dashpot_power_, bore_loads_, moments_;
  TreeSums tree_;
  DeviceArray<double> results_;  ///< kResults numbers, then the bands
  Staging<double> landed_;
  std::vector<SurfaceForceRecord> records_;
  bool energies_known_;         ///< of these bodies
  bool stretch_known_ = false;  ///< of this step
  std::size_t bytes_ = 0;
};

}  // namespace railstrata::device
