#pragma once
// How long the parts of a step take. Measured only on request (bench/roofline.cpp).
#include <array>
#include <chrono>
#include <cstddef>

namespace railstrata {

/// In the order of a step.
enum class StepPart {
  begin,        ///< ghosts, carried frames, elements that may yield
  elements,     ///< with the updates on the way
  exchange,     ///< with other ranks
  planes,       ///< between chains
  tie_forces,   ///< of slaves, to their masters
  ends,         ///< of the rail; bore; added mass
  rows,         ///< of the contact
  contact,      ///< its solution and forces
  waiting,      ///< update of nodes that waited for the contact
  constraints,  ///< axle, bore and slaves
};
inline constexpr std::size_t kStepParts = 10;
inline constexpr std::array<const char*, kStepParts> kStepPartNames = {"begin: ghosts, frames",
                                                                       "elements and updates on the way",
                                                                       "exchange with other ranks",
                                                                       "planes between chains",
                                                                       "ties: forces",
                                                                       "ends of the rail, bore",
                                                                       "rows of the contact",
                                                                       "contact: solution and forces",
                                                                       "update of waiting nodes",
                                                                       "axle; ties: displacements"};

class StepLaps {
 public:
  void start() { last_ = Clock::now(); }
  /// This part ends now.
  void lap(StepPart part) {
    const Clock::time_point now = Clock::now();
    seconds_[static_cast<std::size_t>(part)] = std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  /// s, of the last step.
  const std::array<double, kStepParts>& seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_;
  std::array<double, kStepParts> seconds_{};
};

}  // namespace railstrata
