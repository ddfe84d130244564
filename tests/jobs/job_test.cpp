#include "jobs/job.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "core/faults.hpp"
#include "jobs/state_table.hpp"
#include "record/output_file.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

struct Term {
  double k = 0, sum = 0;
};
const StateColumns<Term> kTerms{{"k", &Term::k}, {"sum", &Term::sum}};

/// The worked example of CONTRIBUTING.md: 1/1² + 1/2² + ..., a row a step.
class SeriesJob : public CaseJob {
 public:
  SeriesJob(LoadedCase loaded, const JobOrder& order, std::size_t terms, Control& control)
      : CaseJob({"series", "series.id", "the case of its beginning"}, std::move(loaded), order, control),
        wanted_(terms) {}

 private:
  std::vector<std::string> older_results() const override { return {"series.csv"}; }
  void resume() override {
    if (fs::exists(folder() / "series.csv")) terms_ = read_rows(folder() / "series.csv", kTerms);
  }
  bool finished() const override { return terms_.size() >= wanted_; }
  bool step() override {
    const Term last = terms_.empty() ? Term{} : terms_.back();
    terms_.push_back({last.k + 1, last.sum + 1 / ((last.k + 1) * (last.k + 1))});
    control_.progress("series", static_cast<double>(terms_.size()) / static_cast<double>(wanted_));
    return true;
  }
  void save() override { write_rows(folder() / "series.csv", origin(), kTerms, terms_); }
  void finish() override { save(); }
  std::string how_far() const override { return "after term " + std::to_string(terms_.size()); }

  std::size_t wanted_;
  std::vector<Term> terms_;
};

std::string text_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class JobInAFolder : public testing::Test {
 protected:
  JobEnd carry_out(const char* name, std::size_t terms, bool resume,
                   const char* text = "[case]\ntitle = \"series\"\n") {
    const fs::path file = folder.path() / "a.toml";
    write_whole_file(file, text);
    SeriesJob job(load_case(file), {folder.path() / name, resume, false, false, {}}, terms, control);
    return job.carry_out();
  }
  std::string table(const char* name) const { return text_in(folder.path() / name / "series.csv"); }

  TemporaryFolder folder;
  Control control;
};

}  // namespace

TEST_F(JobInAFolder, StoppedAndResumedItHasTheBytesOfOneInOneGo) {
  EXPECT_EQ(carry_out("whole", 50, false), JobEnd::finished);
  std::string warning;
  control.on_warning = [&](const std::string& text) { warning = text; };
  control.on_progress = [&](const std::string&, double fraction, int) { control.stop = fraction >= 0.4; };
  EXPECT_EQ(carry_out("parts", 50, false), JobEnd::stopped);
  EXPECT_EQ(warning, "stopped after term 20; go on with --resume");
  control.on_progress = nullptr;
  control.stop = false;
  EXPECT_EQ(carry_out("parts", 50, true), JobEnd::finished);
  EXPECT_EQ(table("parts"), table("whole"));
}

TEST_F(JobInAFolder, KilledAfterASaveItGoesOnToTheSameBytes) {
  EXPECT_EQ(carry_out("whole", 50, false), JobEnd::finished);
  const pid_t child = ::fork();
  if (child == 0) {
    control.on_progress = [&](const std::string&, double fraction, int) {
      control.save = fraction > 0.3;
      if (fraction > 0.5) ::kill(::getpid(), SIGKILL);
    };
    carry_out("parts", 50, false);
    _exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_NE(table("parts"), "");
  EXPECT_EQ(carry_out("parts", 50, true), JobEnd::finished);
  EXPECT_EQ(table("parts"), table("whole"));
}

TEST_F(JobInAFolder, IsRefusedWhereTheFolderHoldsAnotherOrIsHeld) {
  carry_out("one", 3, false);
  try {
    carry_out("one", 5, true, "[drive]\nspeed = \"7 m/s\"\n");
    FAIL() << "another case goes on";
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("no series of this very case\n    remedy: give the case of its beginning"),
              std::string::npos)
        << e.what();
  }
  EXPECT_THROW(carry_out("one", 5, false), CaseError) << "it is not empty";
  const FolderHold held(folder.path() / "one");
  EXPECT_THROW(carry_out("one", 5, true), CaseError);
}

}  // namespace railstrata
