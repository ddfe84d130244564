#include "result/rolling_mean.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/patch_extent.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

/// Values of a field that are means over the samples.
constexpr std::array kMeans{&ContactField::x,   &ContactField::p,      &ContactField::q_x,
                            &ContactField::q_y, &ContactField::slip_x, &ContactField::slip_y};

template <class Slips>
void set_states(ContactField& f, Slips&& slips) {
  const double p_max = f.p.empty() ? 0 : *std::max_element(f.p.begin(), f.p.end());
  f.p_noise = kPressureNoise * p_max;
  for (int i = 0; i < f.size(); ++i)
    f.state[i] = f.p[i] <= 0 ? ContactState::separated : slips(i) ? ContactState::slip : ContactState::stick;
}

/// Slip and friction power between the samples, at the points of the moving field.
struct Passage {
  std::vector<double> slip_share;                    ///< of the time in contact
  std::vector<double> friction_power, pressed_slip;  ///< W/m², ContactField
};

/// From one sample to the next each node passes an element, from one point of the moving field to another: of the
/// element around a point there are half of the way to it and half of the way from it. The power of the way to it is
/// its own; summed over the points it is what the nodes have taken up between the samples. Empty of a single sample.
Passage passage(const std::vector<RollingSample>& samples, int columns) {
  if (samples.size() < 2) return {};
  const auto points = static_cast<std::ptrdiff_t>(samples.front().tractions.size());
  std::vector<double> slipped(points, 0.0), touched(points, 0.0), work(points, 0.0), pressed(points, 0.0);
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const RollingSample &before = samples[k - 1], &after = samples[k];
    const std::ptrdiff_t moved = static_cast<std::ptrdiff_t>(after.first_station - before.first_station) * columns;
    for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, -moved); i < std::min(points, points - moved); ++i) {
      const NodeTraction &from = before.tractions[i + moved], &to = after.tractions[i];
      for (const std::ptrdiff_t point : {i + moved, i}) {
        slipped[point] += to.slip_time - from.slip_time;
        touched[point] += to.contact_time - from.contact_time;
      }
      const std::ptrdiff_t passed = std::max<std::ptrdiff_t>(moved / columns, 1);
      for (std::ptrdiff_t way = 0; way < passed; ++way) {
        const std::ptrdiff_t point = std::min(i + way * columns, points - 1);
        work[point] += (to.friction_work - from.friction_work) / static_cast<double>(passed);
        pressed[point] += (to.pressed_slip - from.pressed_slip) / static_cast<double>(passed);
      }
    }
  }
  const double time = samples.back().time - samples.front().time;
  for (std::ptrdiff_t i = 0; i < points; ++i) {
    slipped[i] = touched[i] > 0 ? slipped[i] / touched[i] : 0.0;
    work[i] /= time;
    pressed[i] /= time;
  }
  return {std::move(slipped), std::move(work), std::move(pressed)};
}

void add(BandSample& sum, const BandSample& s, double weight) {
  if (sum.stress.empty()) {
    sum = s;
    for (double& v : sum.along) v = 0;
    for (Sym3& v : sum.stress) v = {};
    for (ElementPlasticity& v : sum.plastic) v = {};
    for (Vec3& v : sum.displacement) v = {};
    for (Vec3& v : sum.below) v = {};
  }
  for (std::size_t i = 0; i < sum.along.size(); ++i) sum.along[i] += weight * s.along[i];
  for (std::size_t i = 0; i < sum.stress.size(); ++i) sum.stress[i] = sum.stress[i] + weight * s.stress[i];
  for (std::size_t i = 0; i < sum.plastic.size(); ++i) {
    sum.plastic[i].strain = sum.plastic[i].strain + weight * s.plastic[i].strain;
    sum.plastic[i].backstress = sum.plastic[i].backstress + weight * s.plastic[i].backstress;
    sum.plastic[i].accumulated += weight * s.plastic[i].accumulated;
  }
  for (std::size_t i = 0; i < sum.displacement.size(); ++i) sum.displacement[i] += weight * s.displacement[i];
  for (std::size_t i = 0; i < sum.below.size(); ++i) sum.below[i] += weight * s.below[i];
}

}  // namespace

ContactField contact_field(const RollingSystem& sys, const RollingSample& s) {
  ContactField f;
  const ContactSurface& surface = sys.rail_surface();
  f.resize(surface.columns, s.rail.stations + 1);
  f.at_points = true;
  auto tributary = [](auto&& width, int i, int n) {
    return 0.5 * ((i > 0 ? width(i - 1) : 0.0) + (i + 1 < n ? width(i) : 0.0));
  };
  for (int j = 0; j < f.stations; ++j)
    for (int c = 0; c < f.columns; ++c) {
      const std::size_t i = static_cast<std::size_t>(j) * f.columns + c;
      const NodeTraction& t = s.tractions[i];
      f.x[i] = s.rail.along[j];
      f.y[i] = surface.at_contact(c).y;
      f.z[i] = surface.at_contact(c).z;
      f.area[i] = tributary([&](int k) { return surface.width[k]; }, c, f.columns) *
                  tributary([&](int k) { return s.rail.along[k + 1] - s.rail.along[k]; }, j, f.stations);
      f.p[i] = t.p;
      f.q_x[i] = t.q1;
      f.q_y[i] = t.q2;
      f.slip_x[i] = t.slip1;
      f.slip_y[i] = t.slip2;
    }
  set_states(f, [&](int i) { return s.tractions[i].slips(); });
  return f;
}

MeanContact mean_contact(const RollingSystem& sys, const PositionSamples& group) {
  if (group.samples.empty()) throw NumericalError("no sample was taken: the run ended before the requested position");
  MeanContact m;
  m.position = group.position;
  const double weight = 1.0 / static_cast<double>(group.samples.size());
  double p_sum = 0, p_square = 0;
  for (const RollingSample& s : group.samples) {
    const ContactField f = contact_field(sys, s);
    const PatchMeasures patch = measure_patch(f);
    p_sum += patch.p_max;
    p_square += patch.p_max * patch.p_max;
    if (m.field.size() == 0) {
      m.field = f;
      for (const auto values : kMeans) std::fill((m.field.*values).begin(), (m.field.*values).end(), 0.0);
    }
    if (f.size() != m.field.size())
      throw NumericalError(
          fmt::format("the samples cannot be averaged: one surface has {} points, another {} (a fault of the program: "
                      "please report it with the case file)",
                      m.field.size(), f.size()));
    for (const auto values : kMeans)
      for (int i = 0; i < f.size(); ++i) (m.field.*values)[i] += weight * (f.*values)[i];
    m.F_x += weight * s.forces.x;
    m.F_y += weight * s.forces.y;
    m.F_z += weight * s.forces.z;
    m.creepage += weight * s.creepage;
    m.lateral_creepage += weight * s.lateral_creepage;
    if (sys.start_spin > 0) m.spin_per_m += weight * (1 - s.creepage) * wheel_spin(sys.model.reference);
    add(m.rail, s.rail, weight);
    add(m.wheel, s.wheel, weight);
  }
  if (Passage found = passage(group.samples, m.field.columns); !found.slip_share.empty()) {
    m.field.friction_power = std::move(found.friction_power);
    m.field.pressed_slip = std::move(found.pressed_slip);
    set_states(m.field, [&](int i) { return found.slip_share[i] >= 0.5; });
  }
  m.patch = measure_patch(m.field);
  m.patch.q_max = shear_at_front_of_slip(m.field);
  const double mean = p_sum * weight;
  m.p_max_scatter = mean > 0 ? std::sqrt(std::max(0.0, p_square * weight - mean * mean)) / mean : 0;
  return m;
}

}  // namespace railstrata
