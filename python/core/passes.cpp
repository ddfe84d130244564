#include <atomic>
#include <memory>
#include <mutex>

#include "core/parallel.hpp"
#include "io/csv.hpp"
#include "python/core/bind.hpp"
#include "report/passes_page.hpp"
#include "runs/pass_folder.hpp"

namespace railstrata::python {
namespace {

/// What the thread that computes tells the one that asks.
struct Told {
  std::mutex lock;
  int pass = 0;
  double fraction = 0;
  std::vector<std::string> notes;
};

PassFolderObserver teller(Told& told, std::atomic<bool>& stop) {
  PassFolderObserver out;
  out.wishes = [&stop] { return RunWishes{&stop, nullptr}; };
  out.warn = [&told](const std::string& text) {
    const std::lock_guard hold(told.lock);
    told.notes.push_back(text);
  };
  out.going = [&told](int pass, double fraction) {
    const std::lock_guard hold(told.lock);
    told.pass = pass;
    told.fraction = fraction;
  };
  return out;
}

/// Returns (passes, stopped, notes). progress: of the pass under way and how far all are.
py::tuple solve(const LoadedCase& loaded, bool rolled, PassOrder order, const py::object& progress) {
  Told told;
  std::atomic<bool> stop{false};
  PassesEnd end;
  order.command = {{"railstrata.passes (Python)"}, max_threads()};
  const auto work = [&] {
    const PassFolderObserver observer = teller(told, stop);
    end = rolled ? rolled_passes_in_folder(loaded, order, observer) : passes_in_folder(loaded, order, observer);
  };
  const auto look = [&] {
    if (progress.is_none()) return;
    int pass = 0;
    double fraction = 0;
    {
      const std::lock_guard hold(told.lock);
      pass = told.pass;
      fraction = told.fraction;
    }
    if (pass > 0) progress(pass, (pass - 1 + fraction) / order.passes);
  };
  in_background(work, look, [&] { stop = true; });
  return py::make_tuple(end.passes, end.stopped, told.notes);
}

/// {name: numbers} of a table of a result folder, read-only views into it.
py::dict read_table(const std::string& file) {
  auto* kept = new CsvTable(read_csv(file));
  const py::capsule owner(kept, [](void* p) { delete static_cast<CsvTable*>(p); });
  py::dict out;
  for (const CsvColumn& c : kept->columns)
    out[py::str(c.name)] = view(c.values.data(), {static_cast<py::ssize_t>(c.values.size())}, owner);
  return out;
}

}  // namespace

void bind_passes(py::module_& m) {
  m.def("run_passes",
        [](const LoadedCase& loaded, const std::string& folder, bool rolled, int passes, bool resume, bool force,
           bool page, double cell, double roll_length, double checkpoint_every, const py::object& progress) {
          PassOrder order;
          order.folder = folder;
          order.passes = passes;
          order.resume = resume;
          order.force = force;
          order.page = page;
          order.cell = cell;
          order.roll_length = roll_length;
          order.checkpoint_every = checkpoint_every;
          return solve(loaded, rolled, order, progress);
        });
  m.def("read_table", &read_table);
  m.def("write_passes_page", [](const std::string& page, const std::vector<std::string>& folders) {
    const py::gil_scoped_release release;
    write_passes_page(page, {folders.begin(), folders.end()});
  });
}

}  // namespace railstrata::python
