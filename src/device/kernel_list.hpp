#pragma once
// Every kernel that is launched, for those who compile launch_on_card for it.
#include "device/body_kernels.hpp"
#include "device/element_kernels.hpp"

/// X(kernel) for all of them.
#define RAILSTRATA_EVERY_KERNEL(X)                  \
  RAILSTRATA_KERNELS_OF_KIND(X, SweepKind::extrude) \
  RAILSTRATA_KERNELS_OF_KIND(X, SweepKind::revolve) \
  X(ApplyTies)                                      \
  X(GatherTies)                                     \
  X(ClearTies)                                      \
  X(ScaleForces)                                    \
  X(AddSurfaceForces)                               \
  X(AbsorbAtEnds)                                   \
  X(HoldEnds)                                       \
  X(BoreForces)                                     \
  X(MoveBore)                                       \
  X(PackBand)                                       \
  X(SumLevel)
#define RAILSTRATA_KERNELS_OF_KIND(X, kind)     \
  RAILSTRATA_KERNELS_OF_NUMBER(X, kind, double) \
  RAILSTRATA_KERNELS_OF_NUMBER(X, kind, float)  \
  X(WaitingNodes<kind, false>)                  \
  X(WaitingNodes<kind, true>)                   \
  X(ElementEnergies<kind>)                      \
  X(NodeHeights<kind>)                          \
  X(ChainEnergy<kind, false>)                   \
  X(ChainEnergy<kind, true>)
#define RAILSTRATA_KERNELS_OF_NUMBER(X, kind, Real) \
  X(ElementForces<kind, Real>)                      \
  X(NodeForces<kind, Real, false, false>)           \
  X(NodeForces<kind, Real, true, false>)            \
  X(NodeForces<kind, Real, true, true>)
