#include "jobs/job.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "io/folder_kind.hpp"
#include "io/output_folder.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kBetweenSaves{20};

}  // namespace

Job::Job(const JobKind& kind, JobOrder order, Control& control)
    : order_(std::move(order)), control_(control), kind_(kind), saved_(Clock::now()) {}

FolderHold Job::hold() { return prepare_output_folder(folder(), order_.force || order_.resume); }

void Job::require_identity() const {
  if (kind_.identity && file_text(folder() / kind_.identity) != identity() + "\n")
    throw CaseError(fmt::format("{}: no {} of this very case", folder().string(), kind_.name),
                    fmt::format("give {}, or another --out without --resume", kind_.to_repeat));
}

JobEnd Job::carry_out(const std::function<void()>& results_are_there) {
  const FolderHold held = hold();
  try {
    return work(results_are_there);
  } catch (EnvironmentError& e) {
    if (!e.remedy.empty() && !to_resume().empty())
      e.remedy += has_state() ? fmt::format(", then go on with{}", to_resume())
                              : fmt::format(", then start the {} again with --force", kind_.name);
    throw;
  } catch (const Interrupted& e) {  // before there was anything to keep
    throw Interrupted(fmt::format("{}\n    remedy: start it again: {}", e.what(), command_again(folder())));
  }
}

JobEnd Job::work(const std::function<void()>& results_are_there) {
  if (order_.resume) {
    require_identity();
    resume();
  } else {
    begin();
    if (kind_.identity) write_whole_file(folder() / kind_.identity, identity() + "\n");
  }
  saved_ = Clock::now();
  while (!finished()) {
    if (control_.stop || !step()) {
      control_.progress("");
      stop();
      const std::string far = how_far();
      if (!to_resume().empty()) control_.warn("stopped{}{}; go on with{}", far.empty() ? "" : " ", far, to_resume());
      return out_of_time() ? JobEnd::out_of_time : JobEnd::stopped;
    }
    save_when_due();
  }
  control_.progress("");
  finish();
  if (results_are_there) results_are_there();
  const bool page_holds = !order_.page || write_page();
  return sound_ && page_holds ? JobEnd::finished : JobEnd::failed_checks;
}

void Job::save_when_due() {
  if (!control_.save.exchange(false) && Clock::now() - saved_ < kBetweenSaves) return;
  save();
  saved_ = Clock::now();
}

CaseJob::CaseJob(const JobKind& kind, LoadedCase loaded, JobOrder order, Control& control)
    : Job(kind, std::move(order), control), loaded_(std::move(loaded)) {}

FolderHold CaseJob::hold() {
  require_apart(folder(), loaded_);
  FolderHold held = Job::hold();
  remove_parts(folder(), PartsOf::dead);
  return held;
}

std::string CaseJob::identity() const { return case_identity(loaded_); }

void CaseJob::begin() {
  std::error_code ignored;
  for (const std::string& name : older_results()) std::filesystem::remove(folder() / name, ignored);
  write_origin(folder(), loaded_, order_.command.command_line, order_.command.threads);
}

std::vector<std::string> CaseJob::origin() const { return table_origin(loaded_); }

}  // namespace railstrata
