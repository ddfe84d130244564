#pragma once
// A contact above an interface of the rail's layers that slides (interface_march.hpp), passage after passage, until
// what a passage leaves behind repeats. Contact and slip in turn: the slip moves the surface that the contact meets.
#include <functional>
#include <optional>
#include <vector>

#include "bem/interface_march.hpp"
#include "bem/solve_bem.hpp"

namespace railstrata {

struct SlidingInterface {
  std::size_t layer = 0;  ///< of the half-space, whose lower side slides
  double depth = 0;       ///< m
  ShearLimit limit;
};
/// None: no interface of the rail has a limit.
std::optional<SlidingInterface> sliding_interface(const CaseSpec& spec);

/// A place of the interface in the frame of the patch.
struct InterfacePlace {
  double x = 0;                     ///< m
  double slip_x = 0, slip_y = 0;    ///< m, with what earlier passages left
  double shear_x = 0, shear_y = 0;  ///< Pa
};

/// What the passages of a wheel do to an interface.
struct InterfaceSlip {
  std::vector<InterfacePassage> passages;   ///< from the first over a fresh interface on
  bool repeats = false;                     ///< the last one leaves behind what the one before left
  std::vector<InterfacePlace> first, last;  ///< of these passages, along the row with the largest slip
};

/// The contact of the last passage, and its interface.
struct ContactOverInterface {
  BemResult contact;
  InterfaceSlip slip;
};
/// solve: the contact with these options. Stresses inside are those of the elastic interface below that contact. Throws
/// CaseError: the wheel touches at several places.
ContactOverInterface solve_over_interface(const SlidingInterface& sliding, const BemOptions& options,
                                          const std::function<BemResult(const BemOptions&)>& solve);

}  // namespace railstrata
