#pragma once
// The arrays behind ContactTables: made once for a system and a step.
#include "device/body_tables.hpp"
#include "device/contact_kernels.hpp"
#include "fem/rolling_state.hpp"

namespace railstrata::device {

/// A running surface on a device.
class SurfaceArrays {
 public:
  SurfaceArrays(Device& device, const ContactSurface& surface);
  SurfaceView view() const;

 private:
  Vec3 origin_;
  Rotation<double> yaw_;
  int columns_, stride_;
  std::ptrdiff_t first_line_;
  DeviceArray<Vec2> node_, outward_, sagitta_;
  DeviceArray<double> at_, width_, sine_, cosine_;
};

class ContactArrays {
 public:
  ContactArrays(Device& device, const RollingSystem& system, double dt);

  const ContactTables& tables() const { return tables_; }
  /// Copies to and from a state what each step takes over from the one before.
  void load(const RestartState& state);
  void store(RestartState& state) const;

  std::ptrdiff_t slots() const { return static_cast<std::ptrdiff_t>(tables_.window) * tables_.inner; }
  std::ptrdiff_t facets() const { return static_cast<std::ptrdiff_t>(active_.size()); }
  std::ptrdiff_t hits() const { return static_cast<std::ptrdiff_t>(hits_.size()); }
  std::ptrdiff_t band_nodes() const { return static_cast<std::ptrdiff_t>(tables_.band) * tables_.wheel.columns; }

 private:
  SurfaceArrays rail_, wheel_;
  ContactTables tables_{};
  DeviceArray<NodeTraction> tractions_;
  DeviceArray<Tangential> corrections_;
  DeviceArray<int> active_, near_, edge_, slips_;
  DeviceArray<mortar_law::Hit> hits_;
  DeviceArray<RowRecord> rows_;
  DeviceArray<RowStart> starts_;
  DeviceArray<double> weights_, changes_, numbers_, parts_;
  struct Nodes {
    DeviceArray<Vec3> before, after, force;
    DeviceArray<double> answer;
  };
  Nodes rail_nodes_, wheel_nodes_;
};

}  // namespace railstrata::device
