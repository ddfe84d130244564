#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

#include "core/parallel.hpp"
#include "python/core/bind.hpp"

namespace railstrata::python {

void in_background(const std::function<void()>& work, const std::function<void()>& look,
                   const std::function<void()>& stop) {
  std::atomic<bool> done{false};
  std::exception_ptr failed;
  const int threads = max_threads();  // OpenMP counts them per thread
  std::thread worker([&] {
    set_threads(threads);
    try {
      work();
    } catch (...) {
      failed = std::current_exception();
    }
    done = true;
  });
  std::exception_ptr asked;
  while (!done) {
    {
      const py::gil_scoped_release release;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (asked) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      look();
    } catch (...) {
      asked = std::current_exception();
      stop();
    }
  }
  {
    const py::gil_scoped_release release;
    worker.join();
  }
  if (asked) std::rethrow_exception(asked);
  if (failed) std::rethrow_exception(failed);
}

}  // namespace railstrata::python
