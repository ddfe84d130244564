#pragma once
// Needs of a rolling on a card, counted without one: the bytes of every array that it would make there, and the
// time of a step by a model of it, which is not measured:
//
//   T = e B/b + n l + c p
//
// e: elements; B: bytes that an element and step moves (docs/gpu.md); b: the card's memory bandwidth, from its data
// sheet; n launches of l each; c barriers of the contact's group of threads of p each.
#include <string>
#include <vector>

#include "fem/rolling_system.hpp"
#include "fem/step_plan.hpp"

namespace railstrata::device {

struct DeviceNeed {
  std::string refused;  ///< what a device does not take, in words for its user; empty: nothing
  double fields = 0;    ///< bytes: displacements, velocities, forces, masses
  double rows = 0;      ///< what elements leave for their corners
  double tables = 0;    ///< of the meshes, ties and added mass
  double contact = 0;   ///< surfaces, rows and tractions
  double copied = 0;    ///< bytes a step that come to the host while nothing is sampled
  double memory() const { return fields + rows + tables + contact; }
  struct OnCard {
    std::string name;
    double bandwidth = 0;  ///< B/s
    double step = 0;       ///< s
  };
  std::vector<OnCard> cards;
};

/// Nothing but `refused` where that is not empty.
DeviceNeed device_need(const RollingSystem& system, StepPlan& plan);

}  // namespace railstrata::device
