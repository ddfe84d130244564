// The ranks of one run by MPI. This is all of MPI that RailStrata knows; the program loads it where mpirun has started
// it (src/app/mpi_ranks.cpp) and needs no MPI otherwise.
//
// A rank that waits looks now and then whether the processes of the others on this machine are alive, so that it ends
// with a message where MPI alone would wait for ever.
#include <mpi.h>

#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "core/rank_plug_in.hpp"

namespace {

using Clock = std::chrono::steady_clock;
// Looks at a message before others may have the core, and before this process sleeps between looks: where ranks share
// cores, those that wait must not take them from those that work.
constexpr int kSpins = 200, kYields = 2000;
constexpr double kNap = 20e-6, kLongNap = 0.01;  // s
constexpr auto kLookAround = std::chrono::milliseconds(100);

struct Peer {
  int rank, process;
};
std::vector<Peer> peers;  // the other ranks on this machine
std::vector<int> sizes_in_list, places_in_list;
std::string trouble;

const char* fault(const std::string& text) {
  trouble = text;
  return trouble.c_str();
}

const char* fault_of(int code) {
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(code, text, &length);
  return fault("the exchange between the ranks failed: " + std::string(text));
}

const char* missing_peer() {
  for (const Peer& p : peers)
    if (kill(p.process, 0) != 0 && errno == ESRCH)
      return fault("rank " + std::to_string(p.rank) + " (process " + std::to_string(p.process) +
                   ") has ended before the others");
  return nullptr;
}

// nap: seconds asleep between two looks.
const char* wait_for(MPI_Request& request, double nap) {
  auto next_look = Clock::now() + kLookAround;
  for (int looks = 0;; ++looks) {
    int done = 0;
    if (const int code = MPI_Test(&request, &done, MPI_STATUS_IGNORE); code != MPI_SUCCESS) return fault_of(code);
    if (done) return nullptr;
    if (looks < kSpins) continue;
    if (looks < kYields) {
      sched_yield();
    } else {
      const timespec time{0, static_cast<long>(1e9 * nap)};
      nanosleep(&time, nullptr);
    }
    if (Clock::now() < next_look) continue;
    if (const char* missing = missing_peer()) return missing;
    next_look = Clock::now() + kLookAround;
  }
}

const char* gather(double* all, const std::ptrdiff_t* sizes) {
  std::ptrdiff_t total = 0;
  for (std::size_t r = 0; r < sizes_in_list.size(); ++r) {
    sizes_in_list[r] = static_cast<int>(sizes[r]);
    places_in_list[r] = static_cast<int>(total);
    total += sizes[r];
  }
  if (total > INT_MAX) return fault("the bodies are too large for one message between the ranks");
  MPI_Request request = MPI_REQUEST_NULL;
  const int code = MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, all, sizes_in_list.data(), places_in_list.data(),
                                   MPI_DOUBLE, MPI_COMM_WORLD, &request);
  return code == MPI_SUCCESS ? wait_for(request, kNap) : fault_of(code);
}

const char* leave() {
  MPI_Request request = MPI_REQUEST_NULL;
  if (const int code = MPI_Ibarrier(MPI_COMM_WORLD, &request); code != MPI_SUCCESS) return fault_of(code);
  if (const char* missing = wait_for(request, kLongNap)) return missing;
  MPI_Finalize();
  return nullptr;
}

void find_peers(RailstrataRanks& out) {
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, out.rank, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &out.on_this_machine);
  const Peer own{out.rank, getpid()};
  std::vector<Peer> all(static_cast<std::size_t>(out.on_this_machine));
  MPI_Allgather(&own, 2, MPI_INT, all.data(), 2, MPI_INT, here);
  for (const Peer& p : all)
    if (p.rank != out.rank) peers.push_back(p);
  MPI_Comm_free(&here);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const char* railstrata_join_ranks_1(RailstrataRanks* out) {
  int provided = 0;  // one thread of a rank, the one that started, calls MPI
  if (const int code = MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided); code != MPI_SUCCESS)
    return fault_of(code);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_size(MPI_COMM_WORLD, &out->count);
  MPI_Comm_rank(MPI_COMM_WORLD, &out->rank);
  find_peers(*out);
  sizes_in_list.resize(static_cast<std::size_t>(out->count));
  places_in_list.resize(sizes_in_list.size());
  out->gather = gather;
  out->leave = leave;
  return nullptr;
}
