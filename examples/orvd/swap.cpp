// Takes the place of the contact of OpenRailVehicleDynamics where the program is linked with
//   -Wl,--wrap=<the mangled name of WheelRailContactModel::Evaluate>
// so that none of its files change. What it does is said by the environment:
//   RAILSTRATA_CASE    the case of the left wheel; without it their own contact goes on
//   RAILSTRATA_CELL    side of the cells, m (1e-3); RAILSTRATA_TOLERANCE (1e-8)
//   RAILSTRATA_REPORT  file of the calls, their processor time, and the energy of each wheel's last answer
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "rail_wheel.hpp"

// The member function as the linker knows it: a function of the model.
#define RAILSTRATA_EVALUATE                                                                           \
  "_ZNK4orvd18wheel_rail_contact21WheelRailContactModel8EvaluateERKNS0_21WheelRailContactInputERNS0_" \
  "25WheelRailContactWorkspaceE"

namespace railstrata_in_orvd {

using orvd_contact::WheelRailContactInput;
using orvd_contact::WheelRailContactModel;
using orvd_contact::WheelRailContactResult;
using orvd_contact::WheelRailContactWorkspace;

WheelRailContactResult their_evaluate(const WheelRailContactModel*, const WheelRailContactInput&,
                                      WheelRailContactWorkspace&) asm("__real_" RAILSTRATA_EVALUATE);
WheelRailContactResult evaluate(const WheelRailContactModel*, const WheelRailContactInput&,
                                WheelRailContactWorkspace&) asm("__wrap_" RAILSTRATA_EVALUATE);

namespace {

std::string text_of(const char* name, const char* otherwise) {
  const char* found = std::getenv(name);
  return found != nullptr ? found : otherwise;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What one workspace of theirs stands for.
struct Interface {
  std::unique_ptr<RailWheel> wheel;  ///< none: their contact
  long calls = 0, last_call = 0;
  double seconds = 0;
  double normal = 0, slid = 0, lost = 0;  ///< N, of the last answer: forces times creepages, with spin
  bool right = false;
};

void remember(Interface& interface, const WheelRailContactResult& result, double speed) {
  interface.normal = interface.slid = 0;
  for (std::size_t k = 0; k < result.count; ++k) {
    const auto& patch = result.patches[k];
    interface.normal += patch.normal.normal_force_newtons;
    interface.slid -= patch.tangential.longitudinal_force_newtons * patch.creepages.longitudinal +
                      patch.tangential.lateral_force_newtons * patch.creepages.lateral;
  }
  interface.lost = interface.wheel ? interface.wheel->last().dissipation / speed : interface.slid;
}

class Swap {
 public:
  Swap()
      : settings_{text_of("RAILSTRATA_CASE", ""), std::stod(text_of("RAILSTRATA_CELL", "1e-3")),
                  std::stod(text_of("RAILSTRATA_TOLERANCE", "1e-8"))},
        report_(text_of("RAILSTRATA_REPORT", "")) {}
  ~Swap() {
    if (!report_.empty()) write_report();
  }
  Swap(const Swap&) = delete;
  Swap& operator=(const Swap&) = delete;

  WheelRailContactResult answer(const WheelRailContactModel& model, const WheelRailContactInput& input,
                                WheelRailContactWorkspace& workspace) {
    Interface& interface = interface_of(model, workspace);
    const double begun = thread_seconds();
    WheelRailContactResult result =
        interface.wheel ? interface.wheel->evaluate(input) : their_evaluate(&model, input, workspace);
    interface.seconds += thread_seconds() - begun;
    ++interface.calls;
    remember(interface, result, input.wheel.arc_rate_meters_per_second);
    return result;
  }

 private:
  Interface& interface_of(const WheelRailContactModel& model, const WheelRailContactWorkspace& workspace) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Interface& interface = interfaces_[&workspace];
    const auto& geometry = model.geometry();
    interface.right = geometry.side() == orvd_contact::WheelSide::kRight;
    interface.last_call = ++calls_;
    if (!interface.wheel && !settings_.case_file.empty())
      interface.wheel =
          std::make_unique<RailWheel>(settings_, geometry.side(), geometry.configuration().rail_cant_radians);
    return interface;
  }

  /// The wheels asked last are those of the end of the run.
  void write_report() const {
    std::FILE* file = std::fopen(report_.c_str(), "w");
    if (file == nullptr) return;
    std::vector<const Interface*> order;
    double seconds = 0;
    for (const auto& [workspace, interface] : interfaces_) {
      order.push_back(&interface);
      seconds += interface.seconds;
    }
    std::sort(order.begin(), order.end(), [](const auto* a, const auto* b) { return a->last_call < b->last_call; });
    std::fprintf(file, "calls %ld\nseconds %.6f\nworkspaces %zu\n", calls_, seconds, order.size());
    for (const Interface* i : order)
      std::fprintf(file, "wheel %s %.6f %.6f %.6f\n", i->right ? "right" : "left", i->normal, i->slid, i->lost);
    std::fclose(file);
  }

  Settings settings_;
  std::string report_;
  std::mutex mutex_;
  std::unordered_map<const void*, Interface> interfaces_;
  long calls_ = 0;
};

}  // namespace

WheelRailContactResult evaluate(const WheelRailContactModel* model, const WheelRailContactInput& input,
                                WheelRailContactWorkspace& workspace) {
  static Swap swap;
  return swap.answer(*model, input, workspace);
}

}  // namespace railstrata_in_orvd
