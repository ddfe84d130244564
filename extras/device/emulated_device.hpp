#pragma once
// A device on the processor, for tests: the kernels of the card run one index after the other, or several at a time in
// threads, on memory that is closed to the host.
#include <map>
#include <vector>

#include "core/parallel.hpp"
#include "device/memory.hpp"

namespace railstrata::device {

/// In which order an emulated launch goes through its indices. What depends on it is wrong.
enum class LaunchOrder { forward, backward, threads };

/// The group of threads of an emulated launch (device/launch.hpp), in one of the orders.
class EmulatedGroup {
 public:
  explicit EmulatedGroup(LaunchOrder order) : order_(order) {}
  template <class Work>
  void each(std::ptrdiff_t n, const Work& work) const {
    constexpr std::ptrdiff_t kEnough = 64;  // fewer are done before threads are awake
    if (order_ == LaunchOrder::threads && n >= kEnough)
      for_each(n, work);
    else
      for (std::ptrdiff_t i = 0; i < n; ++i) work(order_ == LaunchOrder::backward ? n - 1 - i : i);
  }
  template <class Work>
  void once(const Work& work) const {
    work();
  }

 private:
  LaunchOrder order_;
};

/// open: nothing is closed, for long runs.
enum class Protection { closed, open };

class EmulatedDevice : public Device {
 public:
  explicit EmulatedDevice(Protection protection = Protection::closed, LaunchOrder order = LaunchOrder::forward)
      : protection_(protection), order_(order) {}

  /// Every array has pages of its own; it ends where its last page does, and behind that is one which nobody may touch.
  void* allocate(std::size_t bytes) override;
  void release(void* memory, std::size_t bytes) override;
  void upload(void* to, const void* from, std::size_t bytes) override;
  void download(void* to, const void* from, std::size_t bytes) override;
  void finish() override {}
  EmulatedDevice* emulated() override { return this; }
  std::unique_ptr<Recording> record(const std::function<void()>& launches) override;

  template <class Kernel>
  void run(std::ptrdiff_t n, const Kernel& kernel) {
    const Running running(*this);
    ++launches_;
    if (order_ == LaunchOrder::threads)
      for_each(n, kernel);
    else
      for (std::ptrdiff_t i = 0; i < n; ++i) kernel(order_ == LaunchOrder::forward ? i : n - 1 - i);
  }
  template <class Kernel>
  void run_group(const Kernel& kernel) {
    const Running running(*this);
    ++launches_;
    kernel(EmulatedGroup(order_));
  }
  long launches() const { return launches_; }
  /// Copies to and from it so far.
  long copies() const { return copies_; }
  /// Bytes of arrays now, as they were asked for.
  std::size_t allocated() const { return allocated_; }

 private:
  struct Running {
    explicit Running(EmulatedDevice& device) : of(device) { of.open_device(true); }
    ~Running() { of.open_device(false); }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    EmulatedDevice& of;
  };
  using Pages = std::map<void*, std::size_t>;  // first page and bytes, without the page that guards them
  void copy(void* to, const void* from, std::size_t bytes, const void* array);
  void open_device(bool open);
  static void protect(const Pages& pages, bool open);

  Protection protection_;
  LaunchOrder order_;
  Pages arrays_;
  std::size_t allocated_ = 0;
  long launches_ = 0, copies_ = 0;
};

}  // namespace railstrata::device
