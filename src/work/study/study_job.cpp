#include "study/study_job.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/faults.hpp"
#include "core/printable.hpp"
#include "io/folder_kind.hpp"
#include "io/output_folder.hpp"
#include "io/provenance.hpp"
#include "jobs/duration_text.hpp"
#include "many/each_case.hpp"
#include "record/output_file.hpp"
#include "report/checks.hpp"
#include "report/page.hpp"
#include "runs/device_at_hand.hpp"
#include "runs/write_report.hpp"
#include "study/study_report.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

/// A study has begun in this folder. It is known by the command line in provenance.json, which is written first;
/// study.toml is what people call their own files.
bool is_study_folder(const fs::path& folder) {
  const std::vector<std::string> words = command_line_of(folder);
  return std::find(words.begin(), words.end(), "study") != words.end();
}

/// The "#" lines of study.csv.
std::vector<std::string> study_origin(const LoadedStudy& study) {
  return {fmt::format("RailStrata {}", version_text()),
          fmt::format("study: {} ({})", study.file.filename().string(), study.spec.title),
          "a case by one engine a line; the names of columns say their units; stresses of the rail"};
}

class StudyJob : public Job {
 public:
  StudyJob(const LoadedStudy& study, std::vector<StudyCase> cases, std::vector<bool> ours, StudyOrder order,
           Control& control)
      : Job({"study", nullptr, ""}, order, control),
        study_(study),
        cases_(std::move(cases)),
        ours_(std::move(ours)),
        wanted_(std::move(order)) {
    require_case_processes();
    require_devices();
  }
  const std::vector<CaseRow>& rows() const { return our_rows_; }

 private:
  /// Half-spaces first: they show mistakes in seconds.
  std::vector<const StudyCase*> cases_to_do() const {
    std::vector<const StudyCase*> to_do;
    for (std::size_t k = 0; k < cases_.size(); ++k)
      if (ours_[k] && !is_done(folder(), cases_[k])) to_do.push_back(&cases_[k]);
    std::stable_sort(to_do.begin(), to_do.end(),
                     [](const StudyCase* a, const StudyCase* b) { return a->engine < b->engine; });
    return to_do;
  }

  /// Before the first case: where a card is missing each of them would fail by itself.
  void require_devices() {
    const auto asks = [](const StudyCase& c) {
      return c.engine == Engine::fem && c.loaded.spec.run.device != ComputeDevice::cpu;
    };
    if (std::none_of(cases_.begin(), cases_.end(), asks)) return;
    find_results(folder(), cases_);
    for (const StudyCase* c : cases_to_do())
      if (asks(*c)) require_device(c->loaded);
  }

  FolderHold hold() override {
    return prepare_output_folder(folder(), order_.force, [&] { return is_study_folder(folder()); });
  }

  void begin() override {
    std::vector<fs::path> inputs{study_.file};
    for (const StudyGroup& g : study_.spec.groups)
      if (std::find(inputs.begin(), inputs.end(), g.base) == inputs.end()) inputs.push_back(g.base);
    write_whole_file(folder() / "provenance.json",
                     provenance_json(order_.command.command_line, wanted_.overrides, inputs, order_.command.threads));
    write_whole_file(folder() / "study.toml",
                     fmt::format("# A copy for the record of {}: run that one, for its base is named relative "
                                 "to its folder.\n{}",
                                 printable(study_.file.filename().string()), study_.source_text));
    recover(folder(), cases_, wanted_.lease);
    find_results(folder(), cases_);
  }

  void write_table() {
    rows_ = study_rows(folder(), cases_);
    write_study_table(folder() / "study.csv", study_origin(study_), rows_);
  }

  /// Computes what is to do; study.csv follows every case that ends.
  bool step() override {
    const std::vector<const StudyCase*> to_do = cases_to_do();
    StudyRun run;
    run.out = folder();
    run.cell = study_.spec.cell;
    run.jobs = std::clamp(wanted_.jobs > 0 ? wanted_.jobs : order_.command.threads, 1,
                          std::max(1, static_cast<int>(to_do.size())));
    run.threads = std::max(1, order_.command.threads / run.jobs);
    run.control = &control_;
    run.lease = wanted_.lease;
    run.wait = wanted_.wait;
    run.life_of = wanted_.life_of;
    report(run, to_do.size());
    NowAndThen now_and_then;
    run.ended = [&](const StudyCase& c, const std::string& fault, double seconds, int done) {
      if (fault.empty())
        control_.info("{}/{}  {}: {}", done, to_do.size(), c.label(), duration_text(seconds));
      else
        control_.warn("{}/{}  {} failed: {}", done, to_do.size(), c.label(), fault);
      now_and_then([&] { write_table(); });
    };
    const StudyRunEnd end = run_cases(run, to_do);
    control_.progress("");
    if (end.elsewhere > 0) control_.info("{} more cases have been computed by other processes", end.elsewhere);
    for (const StudyCase* c : end.not_ours)
      if (const std::string owner = claimed_by(claim_file(folder(), *c)); !owner.empty())
        control_.info("{}: left to {}", c->label(), owner);
    left_ = static_cast<std::ptrdiff_t>(end.not_ours.size());
    computed_ = !control_.stop;
    return computed_;
  }

  void report(const StudyRun& run, std::size_t to_do) const {
    control_.info("{}: {} cases, {} of them to compute, {} at a time with {} thread{} each; results go to {}",
                  study_.spec.title, std::count(ours_.begin(), ours_.end(), true), to_do, run.jobs, run.threads,
                  run.threads == 1 ? "" : "s", folder().string());
  }

  void stop() override {
    write_table();
    control_.warn("stopped; the same command goes on where it was");
  }

  void finish() override {
    write_table();
    our_rows_ = rows_of(rows_, ours_);
    const auto to_do =
        std::count_if(our_rows_.begin(), our_rows_.end(), [](const CaseRow& r) { return r.state == "to do"; });
    if (to_do > left_)
      control_.warn(
          "{} results have been replaced meanwhile: another study, with other settings, writes into this folder",
          to_do - left_);
    const auto faults =
        std::count_if(our_rows_.begin(), our_rows_.end(), [](const CaseRow& r) { return !r.fault.empty(); });
    if (faults > 0)
      control_.warn("{} of {} cases failed or have a failed check: see the column fault", faults, our_rows_.size());
    sound_ = to_do <= left_ && faults == 0;
  }

  bool write_page() override {
    if (std::none_of(rows_.begin(), rows_.end(), [](const CaseRow& r) { return r.done(); })) return true;
    const fs::path page = folder() / "report.html";
    return write_page_or_warn(page, control_, [&] {
      std::vector<CaseRow> rows = rows_;
      for (CaseRow& row : rows) row.folder = folder() / row.folder;
      const Report report = study_report(study_.spec, rows);
      write_whole_file(page, report_page(report));
      return WrittenPage{verdict_of(report), {}};
    });
  }

  void resume() override {}
  bool finished() const override { return computed_; }
  std::string to_resume() const override { return {}; }

  const LoadedStudy& study_;
  std::vector<StudyCase> cases_;
  std::vector<bool> ours_;
  const StudyOrder wanted_;
  bool computed_ = false;
  std::ptrdiff_t left_ = 0;  ///< to other processes
  std::vector<CaseRow> rows_, our_rows_;
};

}  // namespace

JobEnd carry_out_study(const LoadedStudy& study, std::vector<StudyCase> cases, std::vector<bool> ours, StudyOrder order,
                       Control& control, const std::function<void(const std::vector<CaseRow>&)>& at_end) {
  StudyJob job(study, std::move(cases), std::move(ours), std::move(order), control);
  return job.carry_out([&] { at_end(job.rows()); });
}

std::vector<CaseRow> rows_of(const std::vector<CaseRow>& all, const std::vector<bool>& ours) {
  std::vector<CaseRow> rows;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (ours[k]) rows.push_back(all[k]);
  return rows;
}

}  // namespace railstrata
