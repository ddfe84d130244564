#include "bem/load_history.hpp"

#include <algorithm>
#include <limits>

#include "model/drive_at_contact.hpp"
#include "model/rolling_start.hpp"

namespace railstrata {
namespace {

/// Rows of a shift stand for themselves: as many as its columns have.
std::size_t rows_of(const TransientSpec& t) {
  for (const auto* column : {&t.tractive_force, &t.traction_coefficient, &t.displacement, &t.lateral_force,
                             &t.lateral_traction_coefficient, &t.lateral_displacement})
    if (!column->empty()) return column->size();
  return 1;
}

}  // namespace

LoadHistory::LoadHistory(const CaseSpec& spec, const RigidContact& contact)
    : spec_(spec),
      static_load_(spec.vehicle.load()),
      spin_(spin_at(spec, contact)),
      lateral_creepage_(spec.drive.lateral_creepage.value_or(yaw_creepage(contact))),
      rolls_(spec.transient.kind == TransientKind::rolling) {
  const TransientSpec& t = spec.transient;
  if (rolls_) {
    places_ = t.at_distance;
    for (const double time : t.at_time) places_.push_back(time * spec.drive.speed);
    end_ = end_of_way(spec);
  } else {
    for (std::size_t row = 1; row <= rows_of(t); ++row) places_.push_back(static_cast<double>(row));
    end_ = places_.back();
  }
}

double LoadHistory::value(const Column& column, double place, double otherwise) const {
  if (column.empty()) return otherwise;
  const auto after = std::lower_bound(places_.begin(), places_.end(), place);
  if (after == places_.begin()) return column.front();
  if (after == places_.end()) return column.back();
  const auto k = static_cast<std::size_t>(after - places_.begin());
  const double part = (place - places_[k - 1]) / (places_[k] - places_[k - 1]);
  return column[k - 1] + part * (column[k] - column[k - 1]);
}

CreepOrForce LoadHistory::along(double place) const {
  const TransientSpec& t = spec_.transient;
  if (!t.tractive_force.empty()) return {0, -value(t.tractive_force, place, 0)};
  if (!t.traction_coefficient.empty()) return {0, -static_load_ * value(t.traction_coefficient, place, 0)};
  if (!rolls_) return {value(t.displacement, place, 0), {}};
  if (!t.creepage.empty()) return {value(t.creepage, place, 0), {}};
  const std::optional<double> traction = spec_.drive.traction();
  return traction ? CreepOrForce{0, -static_load_ * *traction} : CreepOrForce{*spec_.drive.creepage, {}};
}

CreepOrForce LoadHistory::across(double place) const {
  const TransientSpec& t = spec_.transient;
  if (!t.lateral_force.empty()) return {0, -value(t.lateral_force, place, 0)};
  if (!t.lateral_traction_coefficient.empty())
    return {0, -static_load_ * value(t.lateral_traction_coefficient, place, 0)};
  if (!rolls_) return {value(t.lateral_displacement, place, 0), {}};
  const std::optional<double>& traction = spec_.drive.lateral_traction_coefficient;
  if (t.lateral_creepage.empty() && traction) return {lateral_creepage_, -static_load_ * *traction};
  return {value(t.lateral_creepage, place, lateral_creepage_), {}};
}

LoadedMoment LoadHistory::at(double place) const {
  const TransientSpec& t = spec_.transient;
  LoadedMoment out;
  out.load = value(t.wheel_load, place, static_load_ * value(t.load_factor, place, 1));
  out.x = along(place);
  out.y = across(place);
  if (rolls_) {
    out.spin = value(t.spin, place, spin_);
    return out;
  }
  const double risen = std::min(place, 1.0);  // nothing sideways at 0, the first row at 1
  for (CreepOrForce* c : {&out.x, &out.y}) {
    c->creepage *= risen;
    if (c->force) *c->force *= risen;
  }
  return out;
}

double LoadHistory::time(double place) const {
  const TransientSpec& t = spec_.transient;
  if (rolls_) return place / spec_.drive.speed;
  if (t.at_time.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::min(place, 1.0) * value(t.at_time, place, 0);
}

double LoadHistory::largest_load() const {
  const TransientSpec& t = spec_.transient;
  double most = t.wheel_load.empty() && t.load_factor.empty() ? static_load_ : 0.0;
  for (const double load : t.wheel_load) most = std::max(most, load);
  for (const double factor : t.load_factor) most = std::max(most, factor * static_load_);
  return most;
}

CaseSpec case_of_moment(const CaseSpec& spec, const LoadedMoment& moment) {
  CaseSpec out = spec;
  out.transient = {};
  out.vehicle.set_load(moment.load);
  DriveSpec& drive = out.drive;
  drive.creepage = drive.lateral_creepage = drive.lateral_traction_coefficient = std::nullopt;
  if (moment.x.force)
    drive.traction_coefficient = -*moment.x.force / moment.load;
  else
    drive.creepage = moment.x.creepage;
  if (moment.y.force)
    drive.lateral_traction_coefficient = -*moment.y.force / moment.load;
  else
    drive.lateral_creepage = moment.y.creepage;
  drive.spin = moment.spin;
  return out;
}

}  // namespace railstrata
