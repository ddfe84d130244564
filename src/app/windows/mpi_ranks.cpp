// There are no ranks on Windows.
#include "app/mpi_ranks.hpp"

namespace railstrata {

MpiRanks::MpiRanks() = default;

Ranks MpiRanks::ranks() { return {}; }

void MpiRanks::leave() {}

bool MpiRanks::any_asked(bool this_one) { return this_one; }

void MpiRanks::let_rank_0_speak() const {}

void refuse_ranks(const std::string&) {}

void leave_words_to_rank_0() {}

void start_children_alone() {}

}  // namespace railstrata
