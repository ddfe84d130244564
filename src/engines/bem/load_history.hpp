#pragma once
// The history of a case's [transient] table: load, forces and motions at any place of its course, linear between rows.
//
// Rows of a rolling history are at rolled distances, from 0 on (times are distances at the case's speed). At a jump
// (two rows at one place) the first row holds up to there; beyond the end the last row holds. A shift has no length:
// row k ends at k, and at 0 the bodies are pressed together by the first row's load, with nothing sideways.
#include <vector>

#include "bem/tangential_problem.hpp"
#include "geometry/placement.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// Forces act on the rail. Creepages of what rolls; of a shift the displacement since the start [m].
struct LoadedMoment {
  double load = 0;  ///< N, vertical
  CreepOrForce x, y;
  double spin = 0;  ///< 1/m; of a shift 0
};

class LoadHistory {
 public:
  LoadHistory(const CaseSpec& spec, const RigidContact& contact);

  bool rolls() const { return rolls_; }
  double end() const { return end_; }  ///< m, rolled; of a shift the number of rows
  LoadedMoment at(double place) const;
  const std::vector<double>& places() const { return places_; }  ///< of the rows
  /// s; NaN where it is not known.
  double time(double place) const;
  double largest_load() const;

 private:
  using Column = std::vector<double>;
  double value(const Column& column, double place, double otherwise) const;
  CreepOrForce along(double place) const;
  CreepOrForce across(double place) const;

  const CaseSpec& spec_;
  double static_load_, spin_, lateral_creepage_;
  bool rolls_;
  Column places_;
  double end_ = 0;
};

/// The case in steady rolling under what holds at a moment: what its checks and pictures refer to.
CaseSpec case_of_moment(const CaseSpec& spec, const LoadedMoment& moment);

}  // namespace railstrata
