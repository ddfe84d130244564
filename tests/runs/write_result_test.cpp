#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "io/result_folder.hpp"
#include "record/csv.hpp"
#include "result/patch.hpp"
#include "runs/write_fem_result.hpp"
#include "runs/write_half_space_result.hpp"
#include "runs/write_transient.hpp"
#include "tests/places.hpp"
#include "tests/runs/small_run.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

class WriteResult : public testing::Test {
 protected:
  static Names names_in(const fs::path& where) {
    Names names;
    for (const auto& entry : fs::directory_iterator(where)) names.insert(entry.path().filename().string());
    return names;
  }
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path();
};
using SlowWriteResult = WriteResult;

const Names kPosition{"centre_line.csv",
                      "depth_line.csv",
                      "geometry.json",
                      "patch.csv",
                      "patch.vtp",
                      "rail_cross_section.csv",
                      "rail_longitudinal_section.csv",
                      "rail_slices.csv",
                      "rail_surface.vtp",
                      "streamlines.csv",
                      "summary.json",
                      "view.py",
                      "wheel_cross_section.csv",
                      "wheel_longitudinal_section.csv",
                      "wheel_surface.vtp"};

Names with(Names names, const Names& more) {
  names.insert(more.begin(), more.end());
  return names;
}

/// A transient of the small case, with the files that it writes on its way and at its end.
Answer solve_and_write(const fs::path& folder, const std::vector<std::string>& overrides) {
  const LoadedCase loaded = run_checks::small_case(overrides);
  const Placement placement = place(loaded.spec, ".");
  BemOptions options;
  options.cell = 0.5e-3;
  TransientWriter writer(loaded.spec, folder, {"a case"});
  const auto observer = [&](const TransientState& state) {
    writer.add(state);
    EXPECT_EQ(read_csv(folder / "history.csv").rows(), static_cast<std::size_t>(state.step) + 1);
  };
  Answer solution = ask(loaded.spec, placement, {}, {.bem = options, .observer = observer});
  write_half_space_result(folder, {"a case"}, loaded.spec, placement, solution);
  return solution;
}

}  // namespace

TEST_F(WriteResult, AWriterThatObservesARunLeavesItsFilesAndNoCheckpoint) {
  const RollingSystem system = fem_system(run_checks::small_case().spec, ".");
  FemWriter writer(system, folder, {"sha", "program", {"a case"}});
  RunObserver observer;
  int saved = 0;
  Control control;
  control.save = true;
  control.on_info = [&](const std::string& text) {
    saved += text.starts_with("checkpoint at x = ");
    EXPECT_TRUE(fs::exists(checkpoint_file(folder)));
  };
  writer.observe(observer, control);
  FemOptions options;
  options.control = &control;
  const FemSolution solution = solve_fem(system, observer, options);
  EXPECT_EQ(saved, 1);
  EXPECT_EQ(read_csv(folder / "history.csv").rows(), solution.history.size());  // before the results are written
  writer.write(solution);
  EXPECT_EQ(names_in(folder), with(kPosition, {"history.csv", "patch.pvd", "patch_film.csv", "patch_series",
                                               "position_5mm", "rail.vtu", "wheel.vtu"}));
  EXPECT_EQ(names_in(folder / "position_5mm"), with(kPosition, {"rail.vtu", "wheel.vtu"}));
  EXPECT_EQ(names_in(folder / "patch_series"),
            (Names{"patch_0000.vtp", "patch_0001.vtp", "patch_0002.vtp", "patch_0003.vtp"}));
  EXPECT_EQ(read_result_folder(folder).number("/contact/p_max_Pa"), solution.positions[1].summary.contact.patch.p_max);
  EXPECT_EQ(read_result_folder(folder / "position_5mm").number("/contact/p_max_Pa"),
            solution.positions[0].summary.contact.patch.p_max);
}

TEST_F(SlowWriteResult, ACheckpointThatCannotBeWrittenIsAWarningUnlessTheRunStops) {
  const RollingSystem system = fem_system(run_checks::small_case({"output.patch_series=false"}).spec, ".");
  const fs::path gone = folder / "gone";
  FemWriter writer(system, gone, {"sha", "program", {}});
  RunObserver observer;
  std::vector<std::string> warnings;
  Control control;
  control.save = true;
  control.on_warning = [&](const std::string& text) { warnings.push_back(text); };
  writer.observe(observer, control);
  observer.history = {};
  FemOptions options;
  options.control = &control;
  EXPECT_FALSE(solve_fem(system, observer, options).stopped);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("the run goes on"), std::string::npos) << warnings[0];

  observer.progress = [&](double, const HistoryRow&) { control.stop = true; };
  EXPECT_THROW(solve_fem(system, observer, options), EnvironmentError);
}

/// The half-space solution of a case, written into the folder.
Answer written(const LoadedCase& loaded, double cell, const fs::path& folder) {
  const Placement placement = place(loaded.spec, ".");
  BemOptions options;
  options.cell = cell;
  Answer solution = ask(loaded.spec, placement, {}, {.bem = options});
  write_half_space_result(folder, {"a case"}, loaded.spec, placement, solution);
  return solution;
}

TEST_F(WriteResult, AAnswerHasTheFilesOfAPosition) {
  const Answer solution = written(run_checks::small_case(), 0.5e-3, folder);
  EXPECT_EQ(names_in(folder), kPosition);
  EXPECT_EQ(read_result_folder(folder).number("/contact/p_max_Pa"), solution.summary.contact.patch.p_max);
  EXPECT_EQ(read_csv(folder / "patch.csv").columns[0].name, "x_mm") << "one patch needs no number";
}

TEST_F(WriteResult, SeveralPatchesAreWrittenAndReadOneAfterTheOther) {
  const LoadedCase loaded = parse_case(
      "[geometry]\nrail_profile = \"UIC60\"\nwheel_profile = \"S1002\"\ncant = 0.05\ngauge_depth = \"14 mm\"\n"
      "back_to_back = \"1353 mm\"\nwheel_radius = \"430 mm\"\nlateral_shift = \"9.6 "
      "mm\"\n[drive]\ntraction_coefficient = 0.02\n",
      "two.toml");
  const Answer solution = written(loaded, 1e-3, folder);
  EXPECT_EQ(names_in(folder), kPosition);
  const ResultFolder read = read_result_folder(folder);
  ASSERT_EQ(read.further.size(), 2U) << "two lobes on the tread and the flange's root";
  EXPECT_EQ(read.field.size(), static_cast<int>(solution.result.grid.size()));
  EXPECT_EQ(read.further[0].size(), static_cast<int>(solution.result.further[0].grid.size()));
  EXPECT_DOUBLE_EQ(measure_patch(read.field).p_max, measure_patch(solution.result.field).p_max);
  EXPECT_EQ(read.number("/patches/1/p_max_Pa"), solution.summary.patches[1].contact.patch.p_max);
  EXPECT_TRUE(result_doubts(read).empty());
}

TEST_F(WriteResult, PatchesOutOfOrderAreRefused) {
  const std::string head =
      "patch,x_mm,y_mm,z_mm,area_mm2,p_MPa,q_x_MPa,q_y_MPa,slip_x_mm_s,slip_y_mm_s,"
      "state_0separated_1stick_2slip\n";
  const auto with = [&](const char* first, const char* second) {
    std::string text = head;
    for (const char* patch : {first, second})
      for (const char* y : {"0", "1"}) text += fmt::format("{},0,{},0,1,1,0,0,0,0,1\n", patch, y);
    return text;
  };
  EXPECT_EQ(parse_results("{\"contact\": {}}", with("1", "2"), "a").further.size(), 1U);
  EXPECT_THROW(parse_results("{\"contact\": {}}", with("2", "1"), "a"), CaseError);
  EXPECT_THROW(parse_results("{\"contact\": {}}", with("1", "3"), "a"), CaseError);
  EXPECT_THROW(parse_results("{\"contact\": {}, \"patches\": 3}", with("1", "2"), "a"), CaseError);
  EXPECT_THROW(parse_results("{\"contact\": {}, \"patches\": [{\"p\": \"x\"}]}", with("1", "2"), "a"), CaseError);
}

TEST_F(WriteResult, ATransientLeavesItsHistoryAndFramesAsItGoes) {
  const Answer solution = solve_and_write(folder, {"transient.kind=rolling", "transient.distance=6 mm",
                                                   "output.series_frames=3", "drive.traction_coefficient=0.1"});
  EXPECT_EQ(names_in(folder / "patch_series"),
            (Names{"patch_0000.vtp", "patch_0001.vtp", "patch_0002.vtp", "patch_0003.vtp"}));
  EXPECT_EQ(names_in(folder), with(kPosition, {"history.csv", "patch.pvd", "patch_film.csv", "patch_series"}));
  const std::vector<double> step = read_csv(folder / "patch_film.csv").column("step");
  EXPECT_EQ(std::set<double>(step.begin(), step.end()), (std::set<double>{0, 4, 8, 12}));
  EXPECT_EQ(read_csv(folder / "history.csv").column("creepage").back(), solution.summary.contact.creepage_x);
}

TEST_F(WriteResult, TheSlipOfAShiftIsReadBackAsADistance) {
  const Answer solution = solve_and_write(
      folder, {"transient.kind=shift", "transient.displacement=[\"2 um\"]", "output.patch_series=false"});
  Names wanted = with(kPosition, {"history.csv"});
  wanted.erase("streamlines.csv");
  EXPECT_EQ(names_in(folder), wanted) << "no series is wanted, and nothing rolls";
  const ContactField back = read_result_folder(folder).field;
  EXPECT_TRUE(back.slip_is_distance);
  for (std::size_t k = 0; k < back.slip_x.size(); ++k)
    EXPECT_NEAR(back.slip_x[k], solution.result.field.slip_x[k], 1e-20);
  const CsvTable history = read_csv(folder / "history.csv");
  EXPECT_NEAR(history.column("displacement_um").back(), 2, 1e-12);
  EXPECT_THROW(history.column("creepage"), CaseError);
}

}  // namespace railstrata
