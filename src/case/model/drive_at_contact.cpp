#include "model/drive_at_contact.hpp"

#include <cmath>

namespace railstrata {

double turn_about_vertical(const CaseSpec& spec, const RigidContact& contact) {
  if (spec.drive.spin) return (*spec.drive.spin - wheel_spin(contact)) / std::cos(contact.angle);
  return spec.geometry.curve_radius ? 1 / *spec.geometry.curve_radius : 0.0;
}

double spin_at(const CaseSpec& spec, const RigidContact& contact) {
  return spec.drive.spin.value_or(wheel_spin(contact) + std::cos(contact.angle) * turn_about_vertical(spec, contact));
}

DriveSpec drive_at_contact(const CaseSpec& spec, const RigidContact& contact) {
  DriveSpec drive = spec.drive;
  if (drive.creepage_of == CreepageOf::contact) return drive;
  drive.creepage_of = CreepageOf::contact;
  if (drive.creepage)
    drive.creepage = 1 - (1 - *drive.creepage) * contact.rolling_radius / spec.geometry.wheel_radius -
                     (contact.point.y - contact.wheel_offset_y) * turn_about_vertical(spec, contact);
  if (drive.lateral_creepage) *drive.lateral_creepage /= std::cos(contact.angle);
  return drive;
}

}  // namespace railstrata
