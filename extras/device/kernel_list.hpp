#pragma once
// Every kernel that is launched, for those who compile launch_on_card for it.
#include "device/body_kernels.hpp"
#include "device/contact_kernels.hpp"
#include "device/element_kernels.hpp"
#include "device/step_kernels.hpp"

/// X(kernel) for all of them.
#define RAILSTRATA_EVERY_KERNEL(X)                  \
  RAILSTRATA_KERNELS_OF_KIND(X, SweepKind::extrude) \
  RAILSTRATA_KERNELS_OF_KIND(X, SweepKind::revolve) \
  X(GatherTies)                                     \
  X(ScaleForces)                                    \
  X(AbsorbAtEnds)                                   \
  X(HoldEnds)                                       \
  X(BoreForces)                                     \
  X(MoveBore)                                       \
  X(EndWork)                                        \
  X(TestNodes)                                      \
  X(ChooseFacets)                                   \
  X(UpdateHits)                                     \
  X(FreeBand)                                       \
  X(MakeRows)                                       \
  X(TestRows)                                       \
  X(RecordRows)                                     \
  X(LoadRail)                                       \
  X(LoadWheel)                                      \
  X(SumLevel)
#define RAILSTRATA_KERNELS_OF_KIND(X, kind)     \
  RAILSTRATA_KERNELS_OF_NUMBER(X, kind, double) \
  RAILSTRATA_KERNELS_OF_NUMBER(X, kind, float)  \
  X(WaitingNodes<kind, false>)                  \
  X(WaitingNodes<kind, true>)                   \
  X(ElementEnergies<kind>)                      \
  X(NodeHeights<kind>)                          \
  X(ApplyTies<kind>)                            \
  X(ClearTies<kind>)                            \
  X(ChainEnergy<kind, false>)                   \
  X(ChainEnergy<kind, true>)
#define RAILSTRATA_KERNELS_OF_NUMBER(X, kind, Real) \
  X(ElementForces<kind, Real>)                      \
  X(NodeForces<kind, Real, false, false>)           \
  X(NodeForces<kind, Real, true, false>)            \
  X(NodeForces<kind, Real, true, true>)
/// Kernels that run as one group of threads.
#define RAILSTRATA_EVERY_GROUP_KERNEL(X) \
  X(BeginStep)                           \
  X(PushRows)                            \
  X(SweepRows)                           \
  X(AddUpRows)                           \
  X(FinishStep)
