#pragma once
// Stretches of rail and wheel in which their materials are stiffer or stronger.
#include "model/model.hpp"

namespace railstrata {

/// Gives the elements of a case's stretches materials of their own, for every material and pair of factors one: their
/// moduli in the model, their strengths in the bodies. Where the case has none, nothing changes.
void add_stretches(Model& model);

}  // namespace railstrata
