#pragma once
// The meshed rail of a model as a beam.
#include "model/model.hpp"
#include "track/beam_receptance.hpp"

namespace railstrata {

RailBeam rail_beam(const Model& model);

}  // namespace railstrata
