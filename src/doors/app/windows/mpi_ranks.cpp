// There are no ranks on Windows.
#include "app/mpi_ranks.hpp"

namespace railstrata {

MpiRanks::MpiRanks() = default;

Ranks MpiRanks::ranks() { return {}; }

void MpiRanks::leave() {}

bool MpiRanks::any_asked(bool this_one) { return this_one; }

void MpiRanks::wait_for_rank_0() const {}

void refuse_ranks(const std::string&) {}

void log_on_rank_0_only() {}

void start_children_alone() {}

}  // namespace railstrata
