#include "device/device_need.hpp"

#include "device/engine.hpp"

namespace railstrata::device {
namespace {

/// Memory that is counted and not there: for what makes arrays and copies tables into them.
class CountedDevice : public Device {
 public:
  void* allocate(std::size_t bytes) override {
    bytes_ += static_cast<double>(bytes);
    return &nowhere_;
  }
  void release(void*, std::size_t) override {}
  void upload(void*, const void*, std::size_t) override {}
  void download(void*, const void*, std::size_t) override {}
  void finish() override {}
  std::unique_ptr<Recording> record(const std::function<void()>&) override { return nullptr; }
  double bytes() const { return bytes_; }

 private:
  double bytes_ = 0;
  char nowhere_ = 0;
};

struct CardSheet {
  const char* name;
  double bandwidth;  // B/s
};
constexpr CardSheet kCards[] = {{"A100 80 GB", 2.04e12}, {"H100 SXM", 3.35e12}, {"H200", 4.8e12}};

// Estimates: a launch that waits for the one before it within a recording, and a barrier of 256 threads with what a row
// of the contact computes in between.
constexpr double kLaunch = 2e-6, kPhase = 0.7e-6;
constexpr int kSweeps = 3, kOtherPhases = 30;

double step_bytes(const RollingSystem& sys) {
  double out = 0;
  for (const Body& b : sys.bodies) {
    const double real = b.options.precision == Precision::single_precision ? sizeof(float) : sizeof(double);
    out += static_cast<double>(b.mesh.elements()) * (24 + 2 * kCornerRows * real + 2 * 48 + 8);
  }
  return out;
}

// Number of launches of a usual step: the mesh changes it only by the levels of ties and of sums.
int launches(const RollingSystem& sys) {
  int out = 24;
  for (const Body& b : sys.bodies) out += b.ties.lines().empty() ? 0 : 6;
  return out;
}

}  // namespace

DeviceNeed device_need(const RollingSystem& sys, StepPlan& plan) {
  DeviceNeed need;
  need.refused = not_on_a_device(sys);
  if (!need.refused.empty()) return need;
  const RollingBodies bodies{RollingBody(sys.rail(), sys.rail_surface(), plan.scaling[kRail], {}),
                             RollingBody(sys.wheel(), sys.wheel_surface(), plan.scaling[kWheel], {})};
  CountedDevice device;
  const Engine engine(device, sys, bodies, plan.limits.chosen);
  for (const RollingBody& b : bodies) {
    need.fields += 5.0 * sizeof(double) * static_cast<double>(b.body.layout.size);
    need.rows += engine.row_bytes(index_of(&b == &bodies[kRail] ? BodyId::rail : BodyId::wheel));
  }
  need.contact = engine.contact_bytes();
  need.tables = device.bytes() - need.fields - need.rows - need.contact;
  need.copied = sizeof(StepRecord);
  const int apart = mortar_law::independent_distance(sys.rail_surface(), sys.wheel_surface());
  const double fixed = launches(sys) * kLaunch + (apart * apart * (kSweeps + 2) + kOtherPhases) * kPhase;
  for (const CardSheet& c : kCards) need.cards.push_back({c.name, c.bandwidth, step_bytes(sys) / c.bandwidth + fixed});
  return need;
}

}  // namespace railstrata::device
