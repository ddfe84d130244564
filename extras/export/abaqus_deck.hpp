#pragma once
// The meshed case as an input deck of Abaqus/Standard or CalculiX: the static preload.
//
// Units mm, t, s, N, MPa. Elements C3D8I, the twin of this program's `full` (the incompatible modes of Wilson and
// Taylor), or C3D8R. Hanging nodes are *EQUATIONs. Two steps: the axle is moved down to a part of Hertz's approach, so
// that the bodies touch; then it carries the load.
#include <string>

#include "export/solid_model.hpp"

namespace railstrata {

enum class DeckFlavour { abaqus, calculix };

struct AbaqusDeckOptions {
  DeckFlavour flavour = DeckFlavour::calculix;
  bool friction = false;  ///< with the case's friction coefficient
};

/// The whole deck as text. Elements and nodes count from 1, the rail's first, then the wheel's; the axle is the last
/// node.
std::string abaqus_deck(const SolidModel& model, const AbaqusDeckOptions& options);

}  // namespace railstrata
