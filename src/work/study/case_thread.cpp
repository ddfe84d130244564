#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <thread>

#include "ask/answer.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "io/output_folder.hpp"
#include "record/output_file.hpp"
#include "rules/clashes.hpp"
#include "runs/write_half_space_result.hpp"
#include "runs/write_transient.hpp"
#include "study/running_case.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

/// The files of `bem --no-single-track` in its folder: that limit takes a third of the time of a case, and is the same
/// for hundreds of them.
class CaseThread : public RunningCase {
 public:
  CaseThread(const StudyCase& c, const CaseSettings& settings, fs::path folder)
      : case_(c), settings_(settings), folder_(std::move(folder)), thread_([this] { work(); }) {}
  ~CaseThread() override {
    control_.stop = true;
    thread_.join();
  }

  std::optional<std::string> ended() override { return ended_ ? std::optional(fault_) : std::nullopt; }
  void ask_to_stop() override { control_.stop = true; }
  double fraction() const override { return fraction_; }

 private:
  void work() {
    try {
      solve();
    } catch (const std::exception& e) {
      fault_ = fault_line(e);
      log_ += fmt::format("error: {}\n", e.what());
    }
    try {
      write_whole_file(folder_ / "log.txt", log_);
    } catch (const std::exception& e) {
      if (fault_.empty()) fault_ = fault_line(e);
    }
    ended_ = true;
    settings_.wake->release();
  }

  void solve() {
    set_threads(settings_.threads);
    const LoadedCase& loaded = case_.loaded;
    for (const std::string& note : notes_for(uses::kHalfSpaces, loaded)) log_ += fmt::format("warning: {}\n", note);
    AskOptions how{.control = &control_};
    if (!settings_.cell.empty()) how.bem.cell = parse_quantity(settings_.cell, dimension::kLength);
    how.bem.cache = settings_.cache;
    if (settings_.life_of) how.life_of = settings_.life_of(loaded.folder(), &control_);
    const Placement placement = place(loaded.spec, loaded.folder());
    require_solvable(loaded.spec, placement, how.bem);
    const FolderHold hold(folder_);
    write_origin(folder_, loaded, case_command(case_, settings_, folder_), settings_.threads);
    const Answer answer = answered(placement, how);
    for (const std::string& note : answer.result.notes) log_ += fmt::format("info: {}\n", note);
    write_half_space_result(folder_, table_origin(loaded), loaded.spec, placement, answer);
  }

  Answer answered(const Placement& placement, AskOptions& how) {
    const CaseSpec& spec = case_.loaded.spec;
    std::optional<TransientWriter> writer;
    if (spec.transient.kind != TransientKind::none) writer.emplace(spec, folder_, table_origin(case_.loaded));
    how.observer = [&](const TransientState& state) {
      writer->add(state);
      fraction_ = static_cast<double>(state.step) / state.steps;
    };
    Answer answer = ask(spec, placement, {}, how);
    if (answer.stopped) throw Interrupted("stopped");
    return answer;
  }

  const StudyCase& case_;
  const CaseSettings& settings_;
  const fs::path folder_;
  std::string fault_, log_;
  Control control_;
  std::atomic<bool> ended_{false};
  std::atomic<double> fraction_{0};
  std::thread thread_;  // last: it uses all of them
};

}  // namespace

std::unique_ptr<RunningCase> start_thread(const StudyCase& c, const CaseSettings& settings, const fs::path& folder) {
  return std::make_unique<CaseThread>(c, settings, folder);
}

}  // namespace railstrata
