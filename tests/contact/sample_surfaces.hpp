#pragma once
// A flat rail and a cylindrical wheel as bare surfaces, without bodies.
#include <cmath>
#include <numbers>

#include "contact/mortar.hpp"

namespace railstrata::contact_checks {

struct Surfaces {
  double h = 1e-3, width = 1e-3;  ///< facets of the rail
  double wheel_h, wheel_width;    ///< facets of the wheel below the axle
  double radius;
  ContactSurface rail, wheel;

  /// `ratio`: the wheel's facets over the rail's.
  explicit Surfaces(double ratio = 1.0, double radius_ = 0.43)
      : wheel_h(ratio * h), wheel_width(ratio * width), radius(radius_) {
    for (int j = -12; j <= 12; ++j) rail.stations.at.push_back(j * h);
    flat(rail, 11, width, 0.0, {0, 1});
    wheel.origin = {0, 0, radius};
    wheel.radius = radius;
    // a ring: fine facets below the axle, eight stations round the rest
    const int fine = static_cast<int>(std::ceil(40e-3 / wheel_h));
    for (int j = -fine; j <= fine; ++j) wheel.stations.at.push_back((j + 0.31) * wheel_h / radius);
    const double last = wheel.stations.at.back(), rest = wheel.stations.at.front() + 2 * std::numbers::pi - last;
    for (int k = 1; k <= 8; ++k) wheel.stations.at.push_back(last + rest * k / 9);
    wheel.stations.closed = true;
    flat(wheel, 2 * static_cast<int>(std::ceil(7e-3 / wheel_width)) + 2, wheel_width, -radius, {0, -1});
  }

  /// Equal stations all round the wheel, the first one at theta = 0; returns how many.
  int close_ring() {
    const int count = static_cast<int>(std::lround(2 * std::numbers::pi * radius / wheel_h));
    wheel.stations.at.clear();
    for (int j = 0; j < count; ++j) wheel.stations.at.push_back(2 * std::numbers::pi * j / count);
    wheel.stride = count + 8;
    return count;
  }

  /// Makes a ring of the rail: a cylinder of this radius below the contact.
  void bend_rail(double rail_radius) {
    rail.origin = {0, 0, -rail_radius};
    rail.contact_at = std::numbers::pi;
    rail.radius = rail_radius;
    rail.rises = true;
    for (double& x : rail.stations.at) x = std::numbers::pi + x / rail_radius;
    for (Vec2& n : rail.node) n.z = -rail_radius;
    for (Vec2& n : rail.outward) n.z = -1;
  }
  /// Displacements of its nodes when it has turned about its axle.
  Field turned_rail(double psi) const {
    Field u = rail_field();
    for (int c = 0; c < rail.columns; ++c)
      for (int j = 0; j < rail.stations.nodes(); ++j) {
        const double t = rail.stations.at[j], z = rail.node[c].z;
        u[rail.index(c, j)] = -z * (std::sin(t - psi) - std::sin(t));
        u[rail.index(c, j) + 2 * rail.stride] = z * (std::cos(t - psi) - std::cos(t));
      }
    return u;
  }

  Field rail_field() const { return Field(static_cast<std::size_t>(rail.columns) * 3 * rail.stride, 0.0); }
  Field wheel_field() const { return Field(static_cast<std::size_t>(wheel.columns) * 3 * wheel.stride, 0.0); }
  template <class F>
  Field rail_field(F&& f) const {
    Field u = rail_field();
    for (int c = 0; c < rail.columns; ++c)
      for (int j = 0; j < rail.stations.nodes(); ++j) {
        const Vec3 v = f(Vec3{rail.stations.at[j], rail.node[c].y, rail.node[c].z});
        u[rail.index(c, j)] = v.x;
        u[rail.index(c, j) + rail.stride] = v.y;
        u[rail.index(c, j) + 2 * rail.stride] = v.z;
      }
    return u;
  }
  /// Displacements of the wheel's nodes as a rigid body that has moved with the axle.
  Field rolled(const AxlePose& pose) const {
    Field u = wheel_field();
    const double cos_psi = std::cos(pose.psi), sin_psi = std::sin(pose.psi);
    for (int c = 0; c < wheel.columns; ++c)
      for (int j = 0; j < wheel.stations.nodes(); ++j) {
        const double t = wheel.stations.at[j], z = wheel.node[c].z, ax = -z * std::sin(t), az = z * std::cos(t);
        u[wheel.index(c, j)] = pose.x + (cos_psi - 1) * ax + sin_psi * az;
        u[wheel.index(c, j) + 2 * wheel.stride] = pose.z + (cos_psi - 1) * az - sin_psi * ax;
      }
    return u;
  }

 private:
  static void flat(ContactSurface& s, int columns, double width, double z, Vec2 outward) {
    s.columns = columns;
    for (int c = 0; c < columns; ++c) {
      s.node.push_back({(c - 0.5 * (columns - 1)) * width, z});
      s.outward.push_back(outward);
      s.s.push_back(s.node.back().y);
    }
    s.sagitta.assign(columns - 1, {});
    s.width.assign(columns - 1, width);
    s.first_line = 0;
    s.stride = s.stations.nodes() + 8;
  }
};

}  // namespace railstrata::contact_checks
