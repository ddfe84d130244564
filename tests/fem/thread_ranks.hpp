#pragma once
// Ranks of one run as threads of one process.
#include <algorithm>
#include <barrier>
#include <exception>
#include <thread>
#include <vector>

#include "core/parallel.hpp"
#include "core/ranks.hpp"

namespace railstrata::fem_checks {

/// A list that all ranks fill, each its own part, between two barriers.
class ThreadRanks {
 public:
  explicit ThreadRanks(int count) : barrier_(count), seats_(static_cast<std::size_t>(count)) {
    for (int r = 0; r < count; ++r) seats_[static_cast<std::size_t>(r)] = {this, r};
  }

  /// work(ranks) on as many threads as there are ranks, each with `threads` of its own. A rank that throws would leave
  /// the others waiting: what is thrown must be thrown by all.
  template <class Work>
  void run(int threads, Work&& work) {
    std::vector<std::exception_ptr> thrown(seats_.size());
    std::vector<std::thread> all;
    for (Seat& seat : seats_)
      all.emplace_back([&, threads] {
        set_threads(threads);
        const auto r = static_cast<std::size_t>(seat.rank);
        try {
          work(Ranks{static_cast<int>(seats_.size()), seat.rank, &seat, gather});
        } catch (...) {
          thrown[r] = std::current_exception();
        }
      });
    for (std::thread& t : all) t.join();
    for (const std::exception_ptr& e : thrown)
      if (e) std::rethrow_exception(e);
  }

  long gathers() const { return gathers_; }

 private:
  struct Seat {
    ThreadRanks* ranks = nullptr;
    int rank = 0;
  };
  static void gather(void* context, double* all, const std::ptrdiff_t* sizes) {
    const Seat& seat = *static_cast<Seat*>(context);
    ThreadRanks& ranks = *seat.ranks;
    std::ptrdiff_t before = 0, total = 0;
    for (std::size_t r = 0; r < ranks.seats_.size(); ++r) {
      if (static_cast<int>(r) == seat.rank) before = total;
      total += sizes[r];
    }
    if (seat.rank == 0) {
      ranks.list_.resize(static_cast<std::size_t>(total));
      ++ranks.gathers_;
    }
    ranks.barrier_.arrive_and_wait();
    std::copy_n(all + before, sizes[seat.rank], ranks.list_.data() + before);
    ranks.barrier_.arrive_and_wait();
    std::copy_n(ranks.list_.data(), total, all);
    ranks.barrier_.arrive_and_wait();
  }

  std::barrier<> barrier_;
  std::vector<Seat> seats_;
  std::vector<double> list_;
  long gathers_ = 0;
};

}  // namespace railstrata::fem_checks
