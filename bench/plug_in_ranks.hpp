#pragma once
// The ranks that mpirun has started, joined as the program joins them (src/doors/app/mpi_ranks.cpp).
#include <dlfcn.h>

#include "core/rank_plug_in.hpp"

namespace railstrata {

/// Whether `plug_in`, build/railstrata_mpi.so, could be loaded and has joined them.
inline bool join_ranks(const char* plug_in, RailstrataRanks& out) {
  void* const library = dlopen(plug_in, RTLD_NOW | RTLD_GLOBAL);
  void* const symbol = library == nullptr ? nullptr : dlsym(library, kJoinSymbol);
  const auto join = reinterpret_cast<RailstrataJoin>(symbol);
  return join != nullptr && join(&out) == nullptr;
}

}  // namespace railstrata
