#pragma once
// Interface of a plug-in that joins the processes of one run (extras/mpi/plug_in.cpp). C on both sides: plug-in and
// program may be of different compilers. A returned text describes a fault; null: no fault.
#include <cstddef>

extern "C" {

struct RailstrataRanks {
  int count, rank;
  int on_this_machine;  ///< ranks
  /// As Ranks::gather_parts (core/ranks.hpp).
  const char* (*gather)(double* all, const std::ptrdiff_t* sizes);
  /// Waits, asleep, until all ranks have come here, and parts from them. Nothing else is called afterwards.
  const char* (*leave)();
};

/// Joins the other processes.
using RailstrataJoin = const char* (*)(RailstrataRanks*);

}  // extern "C"

namespace railstrata {

/// The plug-in's one symbol, of type RailstrataJoin; it carries the version of this interface.
inline constexpr const char* kJoinSymbol = "railstrata_join_ranks_1";
inline constexpr const char* kRankPlugIn = "railstrata_mpi.so";  ///< beside the program, or in its lib/railstrata

}  // namespace railstrata
