// Messages between two ranks of MPI: a ping-pong of plain sends (half of the way there and back), and the exchange that
// a run makes of them (extras/mpi/plug_in.cpp, loaded as the program loads it), in bytes that a rank gives. Quantiles
// of many, since other programs may have the cores.
//
// usage: mpirun -n 2 rank_messages PLUG_IN TIMES BYTES...
#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "bench/plug_in_ranks.hpp"

namespace {

constexpr int kFirst = 50;  // for memory and connections

struct Quantiles {
  double least, median, ninth;  // us
};
Quantiles quantiles(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  const auto at = [&](double share) {
    return 1e6 * seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
  };
  return {at(0), at(0.5), at(0.9)};
}

// Every way there and back timed for itself by the first rank; work: one of them.
template <class Work>
Quantiles timed(int times, Work&& work) {
  std::vector<double> seconds;
  for (int k = 0; k < kFirst + times; ++k) {
    const double begun = MPI_Wtime();
    work();
    if (k >= kFirst) seconds.push_back(MPI_Wtime() - begun);
  }
  return quantiles(std::move(seconds));
}

void ping_pong(int rank, std::vector<double>& message) {
  const int count = static_cast<int>(message.size());
  if (rank == 0) MPI_Send(message.data(), count, MPI_DOUBLE, 1, 0, MPI_COMM_WORLD);
  MPI_Recv(message.data(), count, MPI_DOUBLE, 1 - rank, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  if (rank == 1) MPI_Send(message.data(), count, MPI_DOUBLE, 0, 0, MPI_COMM_WORLD);
}

RailstrataRanks joined(const char* plug_in) {
  RailstrataRanks out{};
  if (!railstrata::join_ranks(plug_in, out) || out.count != 2) {
    fmt::print(stderr, "start two ranks, and name build/railstrata_mpi.so\n");
    std::exit(1);
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: mpirun -n 2 rank_messages PLUG_IN TIMES BYTES...\n");
    return 2;
  }
  const RailstrataRanks ranks = joined(argv[1]);
  const int times = std::atoi(argv[2]);
  if (ranks.rank == 0)
    fmt::print("| bytes | one way: least, median, nine of ten (us) | exchange: likewise |\n|---|---|---|\n");
  for (int k = 3; k < argc; ++k) {
    const long bytes = std::atol(argv[k]);
    const auto count = static_cast<std::size_t>(std::max(1L, bytes / 8));
    std::vector<double> message(count), all(2 * count);
    const std::ptrdiff_t sizes[2] = {static_cast<std::ptrdiff_t>(count), static_cast<std::ptrdiff_t>(count)};
    const Quantiles way = timed(times, [&] { ping_pong(ranks.rank, message); });
    const Quantiles exchange = timed(times, [&] { ranks.gather(all.data(), sizes); });
    if (ranks.rank == 0)
      fmt::print("| {} | {:.2f}, {:.2f}, {:.2f} | {:.2f}, {:.2f}, {:.2f} |\n", 8 * count, way.least / 2, way.median / 2,
                 way.ninth / 2, exchange.least, exchange.median, exchange.ninth);
  }
  return ranks.leave() == nullptr ? 0 : 1;
}
