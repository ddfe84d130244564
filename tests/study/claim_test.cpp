#include "study/claim.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <sstream>
#include <vector>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

class ClaimTest : public testing::Test {
 protected:
  std::string text() const {
    std::ostringstream all;
    all << std::ifstream(file_).rdbuf();
    return all.str();
  }
  void age(double seconds) const {
    const auto now = *file_server_time(file_);
    const timespec then[2]{{static_cast<time_t>(now - seconds), 0}, {static_cast<time_t>(now - seconds), 0}};
    ASSERT_EQ(::utimensat(AT_FDCWD, file_.c_str(), then, 0), 0);
  }
  void of_another_machine() const { std::ofstream(file_) << "{\"host\": \"elsewhere\"}\n"; }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.push_back(entry.path().filename().string());
    return all;
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  const fs::path file_ = folder_ / "fem.claim";
};

/// What it returns in a process of its own, that ends without its destructors as a killed one does.
int in_a_process(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WEXITSTATUS(status);
}

TEST_F(ClaimTest, OneHasItUntilItGivesItBack) {
  {
    const auto claim = Claim::take(file_, 300);
    ASSERT_TRUE(claim);
    EXPECT_TRUE(claim->is_ours());
    EXPECT_FALSE(Claim::take(file_, 300));
    EXPECT_NE(claimed_by(file_).find("process " + std::to_string(::getpid())), std::string::npos);
    EXPECT_EQ(names(), std::vector<std::string>{"fem.claim"});
  }
  EXPECT_TRUE(names().empty());
  EXPECT_EQ(claimed_by(file_), "");
  EXPECT_TRUE(Claim::take(file_, 300));
}

TEST_F(ClaimTest, OfAProcessOfThisMachineThatIsNoMoreItIsDeadAtOnce) {
  ASSERT_EQ(in_a_process([&] {
              const auto claim = Claim::take(file_, 300);
              ::_exit(claim ? 1 : 0);
              return 0;
            }),
            1);
  ASSERT_TRUE(fs::exists(file_));
  EXPECT_TRUE(Claim::take(file_, 300));
}

TEST_F(ClaimTest, OfAnotherMachineItIsDeadAfterTheLease) {
  of_another_machine();
  EXPECT_FALSE(Claim::take(file_, 60));
  age(50);
  EXPECT_FALSE(Claim::take(file_, 60));
  age(70);
  EXPECT_TRUE(Claim::take(file_, 60));
}

TEST_F(ClaimTest, TheLeaseIsTheOwners) {
  const auto claim = Claim::take(file_, 600);
  std::string other = text();
  other.replace(other.find("\"host\":\"") + 8, 1, "other-");
  std::ofstream(file_) << other;
  age(500);
  EXPECT_FALSE(Claim::take(file_, 60));
  age(700);
  EXPECT_TRUE(Claim::take(file_, 60));
}

TEST_F(ClaimTest, WhatIsNoFileIsRefused) {
  fs::create_symlink("nowhere", file_);
  EXPECT_THROW(Claim::take(file_, 300), EnvironmentError);
  fs::remove(file_);
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THROW(Claim::take(file_, 300), EnvironmentError);
}

TEST_F(ClaimTest, OfManyThatFindItDeadOneTakesIt) {
  int winners = 0;
  for (int turn = 0; turn < 5; ++turn) {
    of_another_machine();
    age(1000);
    std::vector<pid_t> children;
    int start[2]{};
    ASSERT_EQ(::pipe(start), 0);
    for (int k = 0; k < 8; ++k) {
      children.push_back(::fork());
      if (children.back() == 0) {
        ::close(start[1]);
        char byte = 0;
        static_cast<void>(::read(start[0], &byte, 1) == 0);  // until all are there
        const auto claim = Claim::take(file_, 60);
        ::usleep(50000);
        ::_exit(claim && claim->is_ours() ? 1 : 0);
      }
    }
    ::close(start[0]);
    ::close(start[1]);
    int taken = 0;
    for (const pid_t child : children) {
      int status = 0;
      ::waitpid(child, &status, 0);
      taken += WEXITSTATUS(status);
    }
    EXPECT_LE(taken, 1);
    winners += taken;
    for (const std::string& name : names()) fs::remove(folder_ / name);
  }
  EXPECT_GT(winners, 0);
}

TEST_F(ClaimTest, WhoHasLostItKnowsAndDoesNotRemoveTheOthers) {
  {
    auto claim = Claim::take(file_, 0.01);
    of_another_machine();
    EXPECT_FALSE(claim->is_ours());
    ::usleep(5000);
    EXPECT_FALSE(claim->renew());
  }
  EXPECT_TRUE(fs::exists(file_));
  EXPECT_EQ(names(), std::vector<std::string>{"fem.claim"});
}

TEST_F(ClaimTest, ItsOwnerRenewsItByTheClockOfTheFileServer) {
  auto claim = Claim::take(file_, 0.01);
  age(1000);
  ::usleep(5000);
  EXPECT_TRUE(claim->renew());
  EXPECT_NEAR(*written_at(file_), *file_server_time(file_), 5);
  EXPECT_FALSE(written_at(folder_ / "none"));
  EXPECT_FALSE(file_server_time(folder_ / "none" / "none"));
}

}  // namespace
}  // namespace railstrata
