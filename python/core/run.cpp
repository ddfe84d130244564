#include "runs/folder_run.hpp"

#include <atomic>
#include <memory>
#include <mutex>

#include "core/parallel.hpp"
#include "python/core/bind.hpp"

namespace railstrata::python {
namespace {

/// What the thread that computes tells the one that asks.
struct Told {
  std::mutex lock;
  std::string phase = "meshing";
  double fraction = 0;
  std::vector<std::string> notes;
};

FolderRunObserver teller(Told& told) {
  const auto phase = [&told](const char* name) {
    return [&told, name] {
      const std::lock_guard hold(told.lock);
      told.phase = name;
    };
  };
  FolderRunObserver observer;
  observer.meshing = phase("meshing");
  observer.preload = phase("preload");
  observer.writing = phase("writing");
  observer.rolling = [&told](double fraction, const HistoryRow&) {
    const std::lock_guard hold(told.lock);
    told.phase = "rolling";
    told.fraction = fraction;
  };
  observer.warn = [&told](const std::string& text) {
    const std::lock_guard hold(told.lock);
    told.notes.push_back(text);
  };
  return observer;
}

/// Wall times [s], 0: never.
struct Times {
  double checkpoint_every = 0, limit = 0;
};

/// Returns (stopped, notes).
py::tuple solve(FolderRun& run, const Times& times, const py::object& progress) {
  Told told;
  std::atomic<bool> stop{false};
  FemOptions options;
  options.wishes.stop = &stop;
  options.times.checkpoint_every = times.checkpoint_every;
  options.times.limit = times.limit;
  bool stopped = false;
  const auto work = [&] {
    const RunCommand command{{"railstrata.run (Python)"}, max_threads()};
    stopped = solve_in_folder(run, command, teller(told), options).stopped;
  };
  const auto look = [&] {
    if (progress.is_none()) return;
    std::string phase;
    double fraction = 0;
    {
      const std::lock_guard hold(told.lock);
      phase = told.phase;
      fraction = told.fraction;
    }
    progress(phase, fraction);
  };
  in_background(work, look, [&] { stop = true; });
  told.notes.insert(told.notes.begin(), run.notes.begin(), run.notes.end());
  return py::make_tuple(stopped, told.notes);
}

}  // namespace

void bind_run(py::module_& m) {
  m.def("run_case", [](const LoadedCase& loaded, const std::string& folder, bool force, double checkpoint_every,
                       double limit, const py::object& progress) {
    FolderRun run = begin_run(loaded, folder, force);
    return solve(run, {checkpoint_every, limit}, progress);
  });
  m.def("resume_run", [](const std::string& folder, double checkpoint_every, double limit, const py::object& progress) {
    FolderRun run = resume_run(folder);
    return solve(run, {checkpoint_every, limit}, progress);
  });
}

}  // namespace railstrata::python
