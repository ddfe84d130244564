#pragma once

namespace railstrata {

/// How a section is carried along its stations: a rail straight along x, a wheel about its axle (mesh/swept.hpp).
enum class SweepKind { extrude, revolve };

}  // namespace railstrata
