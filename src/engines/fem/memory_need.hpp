#pragma once
// Whether a mesh fits into the machine, found before any of its fields is made.
#include "model/model.hpp"

namespace railstrata {

/// Bytes that a run of the model needs at its peak, a checkpoint, from the number of its nodes; rounded up.
double memory_needed(const Model& model);

/// Throws EnvironmentError that names both and what to change if the run does not fit.
void require_memory(const Model& model);

}  // namespace railstrata
