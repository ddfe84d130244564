#include "text/text_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

class TextFile : public ::testing::Test {
 protected:
  fs::path pipe() const {
    const fs::path name = folder_ / "pipe";
    EXPECT_EQ(::mkfifo(name.c_str(), 0600), 0);
    return name;
  }
  Diagnostic refusal(const fs::path& file) const {
    try {
      read_text_file(file, "look elsewhere");
    } catch (const CaseError& e) {
      return e.diagnostics.front();
    }
    ADD_FAILURE() << "read " << file;
    return {};
  }
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(TextFile, ANamedPipeThatNobodyWritesIntoIsRefusedAfterAWhile) {
  const Diagnostic d = refusal(pipe());
  EXPECT_NE(d.message.find("is a named pipe, and nothing writes into it"), std::string::npos) << d.message;
}

TEST_F(TextFile, ANamedPipeIsReadToItsEndHoweverSlowlyItIsWritten) {
  const fs::path name = pipe();
  std::thread writer([&] {
    std::ofstream out(name);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    out << "one\n" << std::flush;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    out << "two\n";
  });
  EXPECT_EQ(read_text_file(name, ""), "one\ntwo\n");
  writer.join();
}

TEST_F(TextFile, TheRemedyFitsTheFault) {
  EXPECT_EQ(refusal(folder_ / "nowhere.toml").remedy, "look elsewhere");
  EXPECT_EQ(refusal(folder_).remedy, "name the file in it");
  const fs::path large = folder_ / "large.toml";
  std::ofstream(large).close();
  fs::resize_file(large, (std::size_t{64} << 20) + 1);
  EXPECT_EQ(refusal(large).remedy, "tables of measurements have some megabytes: was another file meant?");
}

TEST_F(TextFile, EmptyFilesAndTheNullDeviceAreEmptyTexts) {
  std::ofstream(folder_ / "empty.toml").close();
  EXPECT_EQ(read_text_file(folder_ / "empty.toml", ""), "");
  EXPECT_EQ(read_text_file("/dev/null", ""), "");
}

}  // namespace
}  // namespace railstrata
