// The ranks of one run by MPI. This is all of MPI that RailStrata knows; the program loads it where mpirun has started
// it (src/doors/app/mpi_ranks.cpp) and needs no MPI otherwise.
//
// Ranks on one machine exchange lists in memory that they share; long ones, and those of ranks on several machines, are
// messages. A rank that waits looks now and then whether the processes of the others on this machine are alive, so that
// it ends with a message where MPI alone would wait for ever.
#include <mpi.h>

#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
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

// look(done) describes a fault; nap: seconds asleep between two looks.
template <class Look>
const char* wait_until(Look&& look, double nap) {
  auto next_look = Clock::now() + kLookAround;
  for (int looks = 0;; ++looks) {
    bool done = false;
    if (const char* wrong = look(done)) return wrong;
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

const char* wait_for(MPI_Request& request, double nap) {
  const auto look = [&](bool& done) -> const char* {
    int flag = 0;
    if (const int code = MPI_Test(&request, &flag, MPI_STATUS_IGNORE); code != MPI_SUCCESS) return fault_of(code);
    done = flag != 0;
    return nullptr;
  };
  return wait_until(look, nap);
}

// Lists of up to kSharedNumbers in memory that ranks on one machine share: each puts its part there, marks it by the
// number of the exchange, and copies those of the others. Two lists take turns: who is at the next exchange has read
// this one, so that the one after it may be written.
class SharedLists {
 public:
  // All ranks call it; without shared memory it is not there.
  void make(MPI_Comm here, int rank, int count) {
    const MPI_Aint bytes =
        rank == 0 ? kLineBytes * count + 2 * kSharedNumbers * static_cast<MPI_Aint>(sizeof(double)) : 0;
    void* own = nullptr;
    int made = MPI_Win_allocate_shared(bytes, 1, MPI_INFO_NULL, here, &own, &window_) == MPI_SUCCESS;
    MPI_Allreduce(MPI_IN_PLACE, &made, 1, MPI_INT, MPI_MIN, here);
    if (!made) return;
    MPI_Aint size = 0;
    int unit = 0;
    void* first = nullptr;
    MPI_Win_shared_query(window_, 0, &size, &unit, &first);
    rank_ = rank;
    count_ = count;
    arrived_ = static_cast<char*>(first);
    lists_ = reinterpret_cast<double*>(arrived_ + kLineBytes * count);
    std::atomic_ref<long>(exchange_of(rank)).store(0);
    MPI_Barrier(here);
  }
  void release() {
    if (window_ != MPI_WIN_NULL) MPI_Win_free(&window_);
  }
  bool hold(std::ptrdiff_t total) const { return lists_ != nullptr && total <= kSharedNumbers; }

  const char* gather(double* all, const std::ptrdiff_t* sizes) {
    double* const list = lists_ + (++exchange_ % 2) * kSharedNumbers;
    std::ptrdiff_t before = 0;
    for (int r = 0; r < rank_; ++r) before += sizes[r];
    std::copy_n(all + before, sizes[rank_], list + before);
    std::atomic_ref<long>(exchange_of(rank_)).store(exchange_, std::memory_order_release);
    std::ptrdiff_t first = 0;
    for (int r = 0; r < count_; first += sizes[r++]) {
      if (r == rank_) continue;
      const auto look = [&](bool& done) -> const char* {
        done = std::atomic_ref<long>(exchange_of(r)).load(std::memory_order_acquire) >= exchange_;
        return nullptr;
      };
      if (const char* missing = wait_until(look, kNap)) return missing;
      std::copy_n(list + first, sizes[r], all + first);
    }
    return nullptr;
  }

 private:
  static constexpr std::ptrdiff_t kSharedNumbers = 1 << 17, kLineBytes = 64;
  long& exchange_of(int rank) { return *reinterpret_cast<long*>(arrived_ + kLineBytes * rank); }

  MPI_Win window_ = MPI_WIN_NULL;
  int rank_ = 0, count_ = 0;
  long exchange_ = 0;
  char* arrived_ = nullptr;  // the last exchange of each rank, in lines of memory of their own
  double* lists_ = nullptr;
};
SharedLists shared_lists;

const char* gather(double* all, const std::ptrdiff_t* sizes) {
  std::ptrdiff_t total = 0;
  for (std::size_t r = 0; r < sizes_in_list.size(); ++r) {
    sizes_in_list[r] = static_cast<int>(sizes[r]);
    places_in_list[r] = static_cast<int>(total);
    total += sizes[r];
  }
  if (shared_lists.hold(total)) return shared_lists.gather(all, sizes);
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
  shared_lists.release();
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
  if (out.on_this_machine == out.count) shared_lists.make(here, out.rank, out.count);
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
