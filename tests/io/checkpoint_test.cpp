#include "io/checkpoint_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>
#include <thread>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

const CheckpointOrigin kOrigin{"a case", "a program", {"one", "two"}};

RunState small_run(double time) {
  RunState r;
  r.stepper.state.time = time;
  r.stepper.state.step = 1'234'567'890'123;
  r.stepper.state.bodies[0].u = {0.1, -0.0, 5e-324};
  r.stepper.state.bodies[1].v = {1.0 / 3};
  r.stepper.state.tractions = SurfaceTractions(2, 3);
  r.stepper.state.tractions.at(1, 2) = {1, 2, 3, 4, 5, 6, 0.5, 11, 12, 2, 8, 9};
  r.stepper.state.groups = {{0.5, -0.5}};
  r.stepper.state.sleepers = {{-6e-4, 0.01}, {-7e-4, 0}};
  r.stepper.facets = {{3, 4, {{1, 2}, {3, 4}, {5, 6}, {7, 8}}}};
  r.stepper.reached_edge = true;
  r.result.history.resize(2);
  r.result.history[0].time = 1e-3;
  r.result.history[0].forces.nodes = 7;
  r.result.history[0].energy.kinetic = 12;
  r.result.history[0].way = {0.01, 0.005, 0.2, 2, -1e-4, 9e-4};
  r.result.positions = {{0.3, {RollingSample{}, RollingSample{}}}, {0.4, {}}};
  r.result.positions[0].samples[1].rail.stress = {{1, 2, 3, 4, 5, 6}};
  r.result.positions[0].samples[1].rail.plastic = {{{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}, 13}};
  r.result.positions[0].samples[1].rail.along = {0.25};
  r.next_sample = 2;
  r.started = true;
  r.frame_times = {0, 1e-4};
  return r;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kOwnHeap = false;  // a sanitizer looks after the memory
#elif defined(__has_feature)
constexpr bool kOwnHeap =
    !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer) && !__has_feature(memory_sanitizer);
#else
constexpr bool kOwnHeap = true;
#endif

/// Bytes that someone holds, and those in the machine's memory that are no file's.
long held_memory() {
  const auto heap = mallinfo2();
  return static_cast<long>(heap.uordblks + heap.hblkhd);
}
long resident_memory() {
  std::ifstream in("/proc/self/status");
  for (std::string word; in >> word;)
    if (long kilobytes = 0; word == "RssAnon:" && in >> kilobytes) return 1024 * kilobytes;
  return 0;
}

/// A checkpoint whose HDF5 part was changed by HDF5, under a checksum that fits.
std::string edited(const std::string& checkpoint, const std::function<void(hid_t)>& edit) {
  constexpr std::size_t kText = 512;
  std::string image = checkpoint.substr(kText);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 16, 0);
  H5Pset_file_image(access, image.data(), image.size());
  const hid_t file = H5Fopen("checkpoint", H5F_ACC_RDWR, access);
  edit(file);
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  image.resize(static_cast<std::size_t>(H5Fget_file_image(file, nullptr, 0)));
  H5Fget_file_image(file, image.data(), image.size());
  H5Fclose(file);
  H5Pclose(access);
  return sealed_checkpoint(image);
}

class Checkpoints : public testing::Test {
 protected:
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path();
  static std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }
  static void put(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }
  std::string refusal() {
    try {
      read_checkpoint(folder, "a case");
    } catch (const CaseError& e) {
      return e.what();
    }
    return {};
  }
};
using SlowCheckpoints = Checkpoints;

}  // namespace

TEST_F(Checkpoints, ReadBackWhatWasWritten) {
  const RunState r = small_run(1e-3);
  const std::string bytes = checkpoint_bytes(kOrigin, r);
  const Checkpoint c = checkpoint_of(bytes, "x");
  EXPECT_EQ(c.origin.provenance, kOrigin.provenance);
  EXPECT_EQ(c.run.stepper.state.step, r.stepper.state.step);
  EXPECT_EQ(c.run.stepper.state.bodies[0].u, r.stepper.state.bodies[0].u);
  EXPECT_TRUE(std::signbit(c.run.stepper.state.bodies[0].u[1]));
  EXPECT_EQ(c.run.stepper.state.tractions.at(1, 2).slip2, 5);
  EXPECT_EQ(c.run.stepper.state.tractions.at(1, 2).plastic, 6);
  EXPECT_EQ(c.run.stepper.state.tractions.at(1, 2).lost_friction, 0.5);
  EXPECT_EQ(c.run.stepper.state.tractions.at(1, 2).mean_slip2, 12);
  EXPECT_EQ(c.run.stepper.state.tractions.at(1, 2).stuck, 2);
  EXPECT_EQ(c.run.stepper.state.tractions.at(1, 2).slip_time, 9);
  EXPECT_EQ(c.run.stepper.facets[0].correction[3].y, 8);
  EXPECT_TRUE(c.run.stepper.reached_edge);
  EXPECT_EQ(c.run.result.history[0].forces.nodes, 7);
  EXPECT_EQ(c.run.result.history[0].way.patches, 2);
  EXPECT_EQ(c.run.result.history[0].way.lowering, 9e-4);
  EXPECT_EQ(c.run.result.positions[0].samples[1].rail.stress[0].xz, 6);
  const ElementPlasticity yielded = c.run.result.positions[0].samples[1].rail.plastic.at(0);
  EXPECT_EQ(yielded.strain.yz, 5);
  EXPECT_EQ(yielded.backstress.xz, 12);
  EXPECT_EQ(yielded.accumulated, 13);
  EXPECT_TRUE(c.run.result.positions[1].samples.empty());
  EXPECT_EQ(checkpoint_bytes(c.origin, c.run), bytes);  // nothing of the state is left out of the way back
}

TEST_F(Checkpoints, TheSameStateHasTheSameBytesASecondLater) {
  const std::string bytes = checkpoint_bytes(kOrigin, small_run(1e-3));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  EXPECT_TRUE(checkpoint_bytes(kOrigin, small_run(1e-3)) == bytes);
}

// Of the library's blocks for files to come, none fits the history that has grown meanwhile.
TEST_F(Checkpoints, AGrowingHistoryLeavesNoMemoryBehind) {
  if (!kOwnHeap) GTEST_SKIP() << "the heap is a sanitizer's";
  RunState r = small_run(1e-3);
  r.result.history.reserve(4000);
  long first = 0;
  for (int k = 0; k < 100; ++k) {
    r.result.history.resize(r.result.history.size() + 20);
    write_checkpoint(folder, kOrigin, r);
    if (k == 10) first = held_memory();
  }
  EXPECT_GT(first, 0);
  EXPECT_LT(held_memory() - first, 16 << 10);
}

// As in a run: the state to write is a copy that is made anew from time to time.
TEST_F(Checkpoints, TheSystemHasTheMemoryBack) {
  if (!kOwnHeap) GTEST_SKIP() << "the heap is a sanitizer's";
  RunState r = small_run(1e-3), good;
  RollingState& s = r.stepper.state;
  for (Field* f : {&s.bodies[0].u, &s.bodies[0].v, &s.bodies[1].u, &s.bodies[1].v})
    f->assign(std::size_t{1} << 18, 1.0);  // 2 MiB each, below what malloc gives back by itself
  long least = 0, most = 0;
  for (int k = 0; k < 5; ++k) {
    good = {};
    good = r;
    write_checkpoint(folder, kOrigin, good);
    const long now = resident_memory();
    least = k == 0 ? now : std::min(least, now);
    most = std::max(most, now);
  }
  EXPECT_GT(least, 16 << 20);
  EXPECT_LT(most, 20 << 20);
}

TEST_F(SlowCheckpoints, EveryFlippedByteIsFound) {
  std::string bytes = checkpoint_bytes(kOrigin, small_run(1e-3));
  std::size_t found = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    const char flip = static_cast<char>(1 << k % 8);
    bytes[k] = static_cast<char>(bytes[k] ^ flip);
    try {
      checkpoint_of(bytes, "x");
    } catch (const CaseError&) {
      ++found;
    }
    bytes[k] = static_cast<char>(bytes[k] ^ flip);
  }
  EXPECT_EQ(found, bytes.size());
  EXPECT_GT(found, 10'000u);
  std::printf("RELIABILITY {\"fact\": \"checkpoint_flips\", \"flipped\": %zu, \"found\": %zu}\n", bytes.size(), found);
}

TEST_F(Checkpoints, EveryCutIsFound) {
  const std::string bytes = checkpoint_bytes(kOrigin, small_run(1e-3));
  std::size_t cuts = 0;
  for (std::size_t k = 0; k < bytes.size(); k += 97, ++cuts)
    EXPECT_THROW(checkpoint_of(bytes.substr(0, k), "x"), CaseError) << k;
  if (!HasFailure())
    std::printf("RELIABILITY {\"fact\": \"checkpoint_cuts\", \"cut\": %zu, \"found\": %zu}\n", cuts, cuts);
  EXPECT_THROW(checkpoint_of(bytes + '\0', "x"), CaseError);
}

TEST_F(Checkpoints, TheOneBeforeIsKeptAndTakenWhenTheNewestIsDamaged) {
  EXPECT_NE(refusal().find("it has no checkpoint"), std::string::npos);
  write_checkpoint(folder, kOrigin, small_run(1));
  EXPECT_FALSE(fs::exists(previous_checkpoint_file(folder)));
  write_checkpoint(folder, kOrigin, small_run(2));
  EXPECT_EQ(read_checkpoint(folder, "a case").checkpoint.run.stepper.state.time, 2);
  std::string bytes = bytes_of(checkpoint_file(folder));
  bytes[bytes.size() / 2] ^= 1;
  put(checkpoint_file(folder), bytes);
  const FoundCheckpoint found = read_checkpoint(folder, "a case");
  EXPECT_EQ(found.checkpoint.run.stepper.state.time, 1);
  ASSERT_EQ(found.notes.size(), 1u);
  EXPECT_NE(found.notes[0].find("checkpoint.h5: this checkpoint cannot be used: its checksum does not agree"),
            std::string::npos)
      << found.notes[0];
  fs::remove(checkpoint_file(folder));  // killed between the two renames
  EXPECT_EQ(read_checkpoint(folder, "a case").checkpoint.run.stepper.state.time, 1);
  put(previous_checkpoint_file(folder), "");
  EXPECT_NE(refusal().find("it is empty"), std::string::npos) << refusal();
  remove_checkpoints(folder);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Checkpoints, NumbersAreTakenFromThisFileAndAsTheyWereWrittenOnly) {
  const std::string whole = checkpoint_bytes(kOrigin, small_run(1));
  const std::vector<double> numbers{0.1, -0.0, 5e-324};  // those that the run has
  const std::string elsewhere = folder / "numbers";
  std::ofstream(elsewhere, std::ios::binary).write(reinterpret_cast<const char*>(numbers.data()), 24);
  /// state/u_rail of this type, stored so.
  const auto stored = [&](hid_t type, const std::function<void(hid_t how)>& set_how, bool written = true) {
    return edited(whole, [&](hid_t file) {
      H5Ldelete(file, "state/u_rail", H5P_DEFAULT);
      const hsize_t three = 3;
      const hid_t space = H5Screate_simple(1, &three, nullptr), how = H5Pcreate(H5P_DATASET_CREATE);
      set_how(how);
      const hid_t set = H5Dcreate2(file, "state/u_rail", type, space, H5P_DEFAULT, how, H5P_DEFAULT);
      ASSERT_GE(set, 0);
      ASSERT_TRUE(!written || H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) >= 0);
      H5Dclose(set);
      H5Pclose(how);
      H5Sclose(space);
    });
  };
  const auto refused_for = [&](const std::string& bytes) -> std::string {
    try {
      checkpoint_of(bytes, "x");
    } catch (const CaseError& e) {
      return e.what();
    }
    return "taken";
  };
  const auto as_usual = [](hid_t) {};
  const hsize_t chunk = 3;
  EXPECT_EQ(checkpoint_of(stored(H5T_IEEE_F64LE, as_usual), "x").run.stepper.state.bodies[0].u,
            small_run(1).stepper.state.bodies[0].u);
  const std::string apart = "u_rail is not stored in one piece";
  EXPECT_NE(refused_for(stored(H5T_IEEE_F64LE, [&](hid_t how) { H5Pset_chunk(how, 1, &chunk); })).find(apart),
            std::string::npos);
  EXPECT_NE(refused_for(stored(H5T_IEEE_F64LE, [&](hid_t how) { H5Pset_chunk(how, 1, &chunk), H5Pset_shuffle(how); }))
                .find(apart),
            std::string::npos);
  EXPECT_NE(refused_for(stored(H5T_IEEE_F64LE, [](hid_t how) { H5Pset_layout(how, H5D_COMPACT); })).find(apart),
            std::string::npos);
  EXPECT_NE(refused_for(stored(H5T_IEEE_F64LE, [&](hid_t how) { H5Pset_external(how, elsewhere.c_str(), 0, 24); }))
                .find(apart),
            std::string::npos);
  EXPECT_NE(refused_for(stored(H5T_IEEE_F64LE, as_usual, false)).find(apart), std::string::npos);
  EXPECT_NE(refused_for(stored(H5T_IEEE_F64BE, as_usual)).find("u_rail is no array of numbers of 8 bytes"),
            std::string::npos);
  const std::string linked = edited(whole, [&](hid_t file) {
    H5Ldelete(file, "state/u_rail", H5P_DEFAULT);
    H5Lcreate_soft("/state/v_wheel", file, "state/u_rail", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_NE(refused_for(linked).find("u_rail is a link"), std::string::npos);
}

TEST_F(Checkpoints, OfTheFormatBeforeSleepersAreRead) {
  RunState run = small_run(1);
  run.result.history[0].foot_z = -8e-4;
  run.result.preload.foot_z = -9e-4;
  const std::string whole = checkpoint_bytes(kOrigin, run);
  const Checkpoint now = checkpoint_of(whole, "x");
  ASSERT_EQ(now.run.stepper.state.sleepers.size(), 2u);
  EXPECT_EQ(now.run.stepper.state.sleepers[0].z, -6e-4);
  EXPECT_EQ(now.run.result.history[0].foot_z, -8e-4);
  EXPECT_EQ(now.run.result.preload.foot_z, -9e-4);
  std::string before = edited(whole, [](hid_t file) {
    for (const char* part : {"state/sleepers", "result/track_history", "result/preload_foot", "result/way_history"})
      ASSERT_GE(H5Ldelete(file, part, H5P_DEFAULT), 0);
  });
  const std::string format = fmt::format("format {}\n", kCheckpointFormat);
  before.replace(before.find(format), format.size(), fmt::format("format {}\n", kOldestCheckpointFormat));
  const Checkpoint then = checkpoint_of(before, "x");
  EXPECT_TRUE(then.run.stepper.state.sleepers.empty());
  EXPECT_EQ(then.run.result.history.size(), 2u);
  EXPECT_EQ(then.run.stepper.state.time, 1);
}

TEST_F(Checkpoints, ThoseOfAnotherCaseOrFormatAreRefused) {
  write_checkpoint(folder, {"another case", "a program", {}}, small_run(1));
  EXPECT_NE(refusal().find("belongs to another case"), std::string::npos);
  const std::string whole = checkpoint_bytes(kOrigin, small_run(1)),
                    format = fmt::format("format {}\n", kCheckpointFormat);
  const auto refusal_of = [&](const std::string& other) {
    std::string bytes = whole;
    bytes.replace(bytes.find(format), format.size(), "format " + other + "\n");
    put(checkpoint_file(folder), bytes);
    fs::remove(previous_checkpoint_file(folder));
    return refusal();
  };
  const std::string older = refusal_of("1"), newer = refusal_of("77"), strange = refusal_of("x7");
  EXPECT_NE(older.find("it was written by an older RailStrata (its format is 1, this program's is"), std::string::npos);
  EXPECT_NE(older.find("start the run anew with --force, or go on with the program that wrote it"), std::string::npos);
  EXPECT_NE(newer.find("it was written by a newer RailStrata (its format is 77, "), std::string::npos) << newer;
  EXPECT_NE(strange.find("its format is x7, this program's is"), std::string::npos) << strange;
}

}  // namespace railstrata
