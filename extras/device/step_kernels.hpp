#pragma once
// The scalars of a step: a thread books what the contact, the bore and the energies were and moves the axle on, another
// keeps a record and makes ready what the next step's kernels read.
#include "device/contact_tables.hpp"
#include "fem/step_record.hpp"

namespace railstrata::device {

/// Constants of a rolling.
struct RollingLaw {
  AxleLaw axle;
  double side_force = 0;                   ///< N
  double torque = 0, torque_ramp = 0;      ///< N m, s
  double run_up = 0, run_up_damping = 0;   ///< m, 1/s
  double dt = 0, gravity = 0;              ///< s, m/s²
  double free_mass = 0, free_inertia = 0;  ///< kg, kg m², of the wheel's free nodes
  ReferenceFrame rail, wheel;              ///< at any time
  int search_interval = 1;                 ///< steps
};

/// Where sums stand that kernels leave: of both bodies together, then by body.
enum Result : int {
  kBore = 0,  ///< force x, y, z [N] and moment [N m], the wheel's frame
  kAbsorbed = 4,
  kTieMoment = 5,
  kEndWork = 6,
  kOfBody = 8,
  // of a body
  kSums = 0,  ///< of UpdateSums, of nodes updated at once and of those that waited
  kStrain = 10,
  kHourglass = 11,
  kHeight = 12,
  kAddedKinetic = 13,
  kBodyResults = 16,
  kResults = 40
};
inline constexpr int kSumsOfNode = 5;
RAILSTRATA_POINTWISE constexpr int result_of(int body, int result) { return kOfBody + body * kBodyResults + result; }

/// Everything that a step reads of the axle and the clock.
RAILSTRATA_POINTWISE void make_ready(const RollingLaw& law, const ContactTables& contact, StepState& s) {
  s.rate = law.run_up > 0 ? law.run_up_damping * (1 - smooth_rise(s.axle.x / law.run_up)) : 0.0;
  s.torque = law.torque_ramp > 0 ? law.torque * smooth_rise(s.time / law.torque_ramp) : law.torque;
  ReferenceFrame rail = law.rail, wheel = law.wheel;
  rail.move_to(s.time);
  wheel.move_to(s.time);
  s.rail = node_step(rail, {}, law.dt, s.rate, law.gravity);
  s.wheel = node_step(wheel, s.mean, law.dt, s.rate, law.gravity);
  const Vec3 at = wheel.to_frame({s.axle.x - wheel.x, s.axle.y - wheel.y, s.axle.z});
  s.in_frame = {at.x, at.y, at.z, s.axle.psi - wheel.psi};
  s.turn = turn_of(s.in_frame.psi);
  s.pose = s.axle.pose();
  s.on_wheel = mortar_law::in_wheel_axes(contact.wheel, s.pose);
  s.turned = turn_of(s.on_wheel.psi);
  double weight = 0;
  constexpr int kMore = 3;
  const int ring = contact.wheel.stations.nodes();
  s.band_first =
      (mortar_law::wheel_station(contact.wheel, s.on_wheel.psi - contact.search.reach, weight) - kMore + ring) % ring;
  if (s.step % law.search_interval != 0) return;
  const double centre = contact.wheel.origin.x + s.pose.x - contact.rail.origin.x;
  const mortar_law::Window window = mortar_law::window_around(contact.rail, centre, contact.search.half_length);
  s.window_first = window.first;
  s.window = std::min(window.stations, contact.window);
  if (window.stations > contact.window) s.fault = static_cast<int>(Fault::window_too_large);
}

/// Between two steps, or before the first: the record of the one that was.
struct BeginStep {
  RollingLaw law;
  ContactTables contact;
  View<StepState> now;
  View<StepRecord> log;
  template <class Group>
  RAILSTRATA_POINTWISE void operator()(const Group& group) const {
    group.once([&] {
      StepState& s = now[0];
      if (s.step > 0) keep(s, log[(s.step - 1) % log.size()]);
      make_ready(law, contact, s);
    });
  }

 private:
  RAILSTRATA_POINTWISE void keep(const StepState& s, StepRecord& record) const {
    record.time = s.time;
    record.step = s.step;
    record.axle = s.axle;
    record.forces = s.contact.forces;
    record.largest_pressure = s.contact.largest_pressure;
    record.balance = s.balance;
    record.reached_edge = s.reached_edge != 0;
    record.fault = s.fault;
  }
};

/// After the nodes' updates.
struct FinishStep {
  RollingLaw law;
  View<StepState> now;
  View<MassGroup> groups;
  View<const double> results;
  int measured, energies;  ///< the updates' sums are known; the energies stored too

  template <class Group>
  RAILSTRATA_POINTWISE void operator()(const Group& group) const {
    group.once([&] { finish(now[0]); });
  }

 private:
  RAILSTRATA_POINTWISE double of(int body, int result) const { return results[result_of(body, result)]; }
  RAILSTRATA_POINTWISE void finish(StepState& s) const {
    constexpr int kRail = 0, kWheel = 1;  // BodyId
    const double dt = law.dt;
    EnergyBalance& book = s.balance;
    if (energies) {
      book.strain = of(kRail, kStrain) + of(kWheel, kStrain);
      book.hourglass = of(kRail, kHourglass) + of(kWheel, kHourglass);
      book.plastic = 0;
      const double height = of(kRail, kHeight) + of(kWheel, kHeight);
      book.weight = law.gravity * (height + law.axle.mass_z * s.axle.z) - results[kEndWork];
      book.spring = spring_energy(law.axle, s.axle.z, groups);
    }
    book.absorbed += dt * results[kAbsorbed];
    book.friction += dt * s.contact.losses.friction;
    book.contact_normal += dt * s.contact.losses.normal;
    double kinetic = 0;
    if (measured) {
      const UpdateSums rail = sums_of(kRail), wheel = sums_of(kWheel);
      book.damping += dt * (wheel.damping + rail.damping);
      s.mean = mean_motion(s.wheel.frame, wheel, law.free_mass, law.free_inertia);
      kinetic = wheel.kinetic + rail.kinetic;
      if (energies) kinetic += of(kRail, kAddedKinetic) + of(kWheel, kAddedKinetic);
    }
    const Vec3 bore = s.wheel.frame.to_model({results[kBore], results[kBore + 1], results[kBore + 2]});
    const AxleLoads loads{bore.x, bore.y, bore.z, results[kBore + 3] - results[kTieMoment]};
    kinetic += advance_axle(law.axle, loads, {s.torque, law.side_force}, dt, s.rate, s.axle, groups, book);
    if (energies) book.kinetic = kinetic;
    s.time += dt;
    ++s.step;
  }
  RAILSTRATA_POINTWISE UpdateSums sums_of(int body) const {
    UpdateSums out;
    for (int part = 0; part < 2; ++part) {
      const int k = result_of(body, kSums + part * kSumsOfNode);
      out += {results[k], results[k + 1], results[k + 2], results[k + 3], results[k + 4]};
    }
    return out;
  }
};

}  // namespace railstrata::device
