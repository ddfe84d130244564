#include "bem/contact_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/faults.hpp"

namespace railstrata {

double along_plane(const RigidContact& contact, Vec2 point) {
  return dot(point - contact.point, {std::cos(contact.angle), std::sin(contact.angle)});
}

double fade(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

namespace {

/// The contacts under a descent, the first one first, and the links of each to those before it.
struct LinkedContacts {
  std::vector<RigidContact> contacts;
  std::vector<std::vector<double>> links;

  /// Links that reach the threshold hold.
  std::vector<ContactPlace> grouped(double threshold) const {
    std::vector<ContactPlace> out;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const auto with = std::find_if(links[k].begin(), links[k].end(), [&](double link) { return link >= threshold; });
      const bool joins = with != links[k].end();
      out.push_back({contacts[k], joins ? out[static_cast<std::size_t>(with - links[k].begin())].patch : k});
    }
    return out;
  }
};

double link_between(const Placement& p, const RigidContact& a, const RigidContact& b, double level) {
  const double by_angle = fade(1 + (kAngleOfOnePlane - std::abs(a.angle - b.angle)) / kFadingAngle);
  if (by_angle == 0) return 0;
  return by_angle * fade(1 + (level - ridge_between(p.wheel, p.rail, p.track, a, b).gap) / kFadingGap);
}

LinkedContacts linked_contacts(const CaseSpec& spec, const Placement& p, double descent) {
  LinkedContacts out{{p.contact}, {{}}};
  if (spec.geometry.in_line() || p.contact.settled) return out;
  for (const RigidContact& c : further_contacts(p.wheel, p.rail, p.track, p.contact, descent)) {
    std::vector<double> links;
    for (const RigidContact& other : out.contacts)
      links.push_back(link_between(p, c, other, descent - p.contact.wheel_offset_z));
    out.contacts.push_back(c);
    out.links.push_back(std::move(links));
  }
  return out;
}

bool same_patches(const std::vector<ContactPlace>& a, const std::vector<ContactPlace>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const ContactPlace& x, const ContactPlace& y) { return x.patch == y.patch; });
}

}  // namespace

std::vector<ContactPlace> places_of(const CaseSpec& spec, const Placement& placement, double descent) {
  return linked_contacts(spec, placement, descent).grouped(1);
}

std::vector<Grouping> groupings_of(const CaseSpec& spec, const Placement& placement, double descent) {
  const LinkedContacts linked = linked_contacts(spec, placement, descent);
  std::vector<double> thresholds{1};
  for (const std::vector<double>& links : linked.links)
    for (const double link : links)
      if (link > 0) thresholds.push_back(link);
  std::sort(thresholds.begin(), thresholds.end(), std::greater<>());
  std::vector<Grouping> out;
  for (std::size_t k = 0; k < thresholds.size(); ++k) {
    const double share = thresholds[k] - (k + 1 < thresholds.size() ? thresholds[k + 1] : 0.0);
    if (share == 0) continue;
    std::vector<ContactPlace> places = linked.grouped(thresholds[k]);
    if (!out.empty() && same_patches(out.back().places, places))
      out.back().share += share;
    else
      out.push_back({share, std::move(places)});
  }
  return out;
}

bool agrees(const std::vector<ContactPlace>& first, const std::vector<ContactPlace>& second) {
  const auto in_first = [&](const ContactPlace& place) {
    return std::find_if(first.begin(), first.end(),
                        [&](const ContactPlace& p) { return same_place(p.contact, place.contact); });
  };
  for (const ContactPlace& a : second)
    for (const ContactPlace& b : second) {
      const auto x = in_first(a), y = in_first(b);
      if (x == first.end() || y == first.end() || (x->patch == y->patch) != (a.patch == b.patch)) return false;
    }
  return true;
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

const RigidContact& PatchPlace::first() const {
  return *std::max_element(contacts.begin(), contacts.end(), [](const RigidContact& a, const RigidContact& b) {
    return a.wheel_offset_z < b.wheel_offset_z;
  });
}

std::vector<PatchPlace> patch_places(const Placement& p, const std::vector<ContactPlace>& places) {
  std::vector<PatchPlace> out;
  for (const ContactPlace& place : places) {
    if (place.patch >= out.size()) out.resize(place.patch + 1);
    out[place.patch].contacts.push_back(place.contact);
  }
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const std::size_t left = places[i].patch, right = places[i + 1].patch;
    if (left == right) continue;
    const Ridge ridge = ridge_between(p.wheel, p.rail, p.track, places[i].contact, places[i + 1].contact);
    out[left].stretch.high = out[right].stretch.low = ridge.rail_s;
    out[left].beside_high = right;
    out[right].beside_low = left;
    out[left].touched_high = out[right].touched_low = ridge.gap + p.contact.wheel_offset_z;
  }
  return out;
}

bool PatchPlace::same_as(const PatchPlace& other) const {
  return std::equal(contacts.begin(), contacts.end(), other.contacts.begin(), other.contacts.end(), same_place) &&
         stretch.low == other.stretch.low && stretch.high == other.stretch.high;
}

PatchPlace first_place(const CaseSpec& spec, const Placement& placement, double descent) {
  std::vector<ContactPlace> places = places_of(spec, placement, descent);
  put_in_order(places);
  return patch_places(placement, places).front();
}

PatchPlace whole_place(const CaseSpec& spec, const Placement& placement, double descent) {
  std::vector<ContactPlace> places = places_of(spec, placement, descent);
  for (ContactPlace& place : places) place.patch = 0;
  put_in_order(places);
  return patch_places(placement, places).front();
}

RigidContact plane_of(const Placement& p, const PatchPlace& place, double descent) {
  return overlap_place(p.wheel, p.rail, p.track, place.first(), place.stretch, p.contact.wheel_offset_z - descent);
}

PatchRoom room_of(const Placement& p, const PatchPlace& place, const RigidContact& plane, double descent) {
  PatchRoom out;
  for (const RigidContact& c : place.contacts) {
    const double t = along_plane(plane, c.point);
    out.held_low = std::min(out.held_low, t);
    out.held_high = std::max(out.held_high, t);
  }
  const auto along = [&](double s) { return along_plane(plane, rail_to_model(p.track, p.rail.at(s).position)); };
  if (place.beside_low) out.low = along(place.stretch.low);
  if (place.beside_high) out.high = along(place.stretch.high);
  if (place.touched_low < descent) out.held_low = std::min(out.held_low, out.low);
  if (place.touched_high < descent) out.held_high = std::max(out.held_high, out.high);
  return out;
}

RigidContact reference_of(const Placement& p, double descent) {
  return overlap_place(p.wheel, p.rail, p.track, p.contact, {}, p.contact.wheel_offset_z - descent);
}

double descent_of(const Placement& p, double approach) {
  constexpr int kMostRounds = 30;
  constexpr double kClose = 1e-13;  // of it
  double descent = approach / std::cos(p.contact.angle);
  for (int round = 0; round < kMostRounds; ++round) {
    const double before = descent;
    descent = approach / std::cos(reference_of(p, descent).angle);
    if (std::abs(descent - before) <= kClose * descent) break;
  }
  return descent;
}

bool same_place(const RigidContact& a, const RigidContact& b) {
  return a.rail_s == b.rail_s && a.wheel_s == b.wheel_s && a.x == b.x && a.yaw == b.yaw && a.roll == b.roll &&
         a.angle == b.angle;
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
