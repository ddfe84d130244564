#include "bem/contact_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/faults.hpp"

namespace railstrata {

double along_plane(const RigidContact& contact, Vec2 point) {
  return dot(point - contact.point, {std::cos(contact.angle), std::sin(contact.angle)});
}

std::vector<ContactPlace> places_of(const Placement& p, double descent) {
  std::vector<ContactPlace> out{{p.contact, 0}};
  for (const RigidContact& c : further_contacts(p.wheel, p.rail, p.track, p.contact, descent)) {
    const auto with = std::find_if(out.begin(), out.end(), [&](const ContactPlace& other) {
      return std::abs(c.angle - other.contact.angle) <= kAngleOfOnePlane &&
             ridge_between(p.wheel, p.rail, p.track, c, other.contact).gap < descent - p.contact.wheel_offset_z;
    });
    out.push_back({c, with != out.end() ? with->patch : out.size()});
  }
  return out;
}

void put_in_order(std::vector<ContactPlace>& places) {
  std::map<std::size_t, std::size_t> number;
  for (const ContactPlace& p : places) number[p.patch];
  std::size_t next = 0;
  for (auto& [old, now] : number) now = next++;
  for (ContactPlace& p : places) p.patch = number[p.patch];
  std::sort(places.begin(), places.end(),
            [](const ContactPlace& a, const ContactPlace& b) { return a.contact.rail_s < b.contact.rail_s; });
}

std::vector<RigidContact> contacts_of(const std::vector<ContactPlace>& places, std::size_t patch) {
  std::vector<RigidContact> out;
  for (const ContactPlace& p : places)
    if (p.patch == patch) out.push_back(p.contact);
  return out;
}

RigidContact plane_of(const Placement& p, const std::vector<RigidContact>& contacts, double descent) {
  if (contacts.size() == 1) return contacts.front();
  return common_contact(p.wheel, p.rail, p.track, contacts, p.contact.wheel_offset_z - descent);
}

void require_one_plane(const Placement& p, double approach, const std::string& key, const std::string& remedy) {
  for (const RigidContact& c :
       further_contacts(p.wheel, p.rail, p.track, p.contact, approach / std::cos(p.contact.angle)))
    if (std::abs(c.angle - p.contact.angle) > kAngleOfOnePlane)
      throw CaseError(
          fmt::format("the wheel touches at y = {:.1f} mm and, under an approach of {:.3g} mm, at another angle at y = "
                      "{:.1f} mm",
                      1e3 * p.contact.point.y, 1e3 * approach, 1e3 * c.point.y),
          remedy, key);
}

}  // namespace railstrata
