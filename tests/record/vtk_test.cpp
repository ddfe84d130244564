#include "record/vtk.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/faults.hpp"
#include "record/output_file.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

class Vtk : public ::testing::Test {
 protected:
  /// The reader's test (read_vtk.py) names the folder in which it wants to find the samples.
  void SetUp() override {
    const char* wanted = std::getenv("RAILSTRATA_VTK_SAMPLES");
    folder_ = wanted != nullptr ? fs::path(wanted) : temporary_.path();
    fs::create_directories(folder_);
  }
  const TemporaryFolder temporary_;
  fs::path folder_;
};

/// A brick of n³ hexahedra with corners (0,0,0) and (1,2,3). Fields are simple functions of place that read_vtk.py
/// repeats.
VtkHexahedra brick(int n) {
  VtkHexahedra mesh;
  const auto node = [n](int i, int j, int k) {
    return static_cast<long long>(i) + (n + 1) * (j + static_cast<long long>(n + 1) * k);
  };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh.points.push_back({1.0 * i / n, 2.0 * j / n, 3.0 * k / n});
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        mesh.cells.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                              node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                              node(i, j + 1, k + 1)});
  std::vector<float> stress;
  std::vector<double> displacement;
  for (const Vec3 p : mesh.points) {
    for (int c = 0; c < 6; ++c) stress.push_back(static_cast<float>(100 * (c + 1) + p.x + 2 * p.y + 3 * p.z));
    displacement.insert(displacement.end(), {1e-9 + p.x / 3, p.y / 3, p.z / 3});
  }
  std::vector<std::int32_t> material;
  for (std::size_t i = 0; i < mesh.cells.size(); ++i) material.push_back(static_cast<std::int32_t>(i % 7));
  mesh.point_fields = {{"stress_MPa", 6, stress}, {"displacement_m", 3, displacement}};
  mesh.cell_fields = {{"material", 1, material}};
  return mesh;
}

VtkQuads patch(double pressure) {
  VtkQuads mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0.5}, {2, 1, 0.5}};
  mesh.cells = {{0, 1, 2, 3}, {1, 4, 5, 2}};
  std::vector<float> p;
  for (int i = 0; i < 6; ++i) p.push_back(static_cast<float>(pressure * i));
  mesh.point_fields = {{"pressure_MPa", 1, p}};
  return mesh;
}

TEST_F(Vtk, samples_for_the_reader_are_written_whole) {
  write_vtu(folder_ / "brick.vtu", brick(20));
  write_vtu(folder_ / "empty.vtu", VtkHexahedra{});
  PvdSeries series(folder_ / "patch.pvd");
  fs::create_directories(folder_ / "frames & more");
  for (int i = 0; i < 3; ++i) {
    const fs::path frame = folder_ / "frames & more" / ("patch_" + std::to_string(i) + ".vtp");
    write_vtp(frame, patch(1 + i));
    series.add(0.1 * i, frame);
  }
  EXPECT_EQ(files_in(folder_), 4u);  // no temporary file is left
  EXPECT_EQ(files_in(folder_ / "frames & more"), 3u);
}

TEST_F(Vtk, the_collection_is_complete_after_every_frame) {
  PvdSeries series(folder_ / "growing.pvd");
  series.add(0.25, folder_ / "a.vtp");
  EXPECT_EQ(content(folder_ / "growing.pvd"),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
            "<DataSet timestep=\"0.25\" group=\"\" part=\"0\" file=\"a.vtp\"/>\n</Collection>\n</VTKFile>\n");
  series.add(0.5, folder_ / "deeper" / "b.vtp");
  EXPECT_NE(content(folder_ / "growing.pvd")
                .find("timestep=\"0.5\" group=\"\" part=\"0\" file=\"deeper/b.vtp\"/>\n</Collection>"),
            std::string::npos);
}

TEST_F(Vtk, appended_data_end_with_a_newline_for_meshio) {
  write_vtp(folder_ / "patch.vtp", patch(1));
  EXPECT_NE(content(folder_ / "patch.vtp").find("\n</AppendedData>\n</VTKFile>\n"), std::string::npos);
}

TEST_F(Vtk, arrays_that_do_not_fit_and_names_with_blanks_are_refused) {
  VtkQuads mesh = patch(1);
  mesh.point_fields[0].components = 2;
  EXPECT_THROW(write_vtp(folder_ / "x.vtp", mesh), std::invalid_argument);
  mesh = patch(1);
  mesh.point_fields[0].name = "pressure [MPa]";
  EXPECT_THROW(write_vtp(folder_ / "x.vtp", mesh), std::invalid_argument);
  mesh = patch(1);
  mesh.cells[0][2] = 6;
  EXPECT_THROW(write_vtp(folder_ / "x.vtp", mesh), std::invalid_argument);
  EXPECT_FALSE(fs::exists(folder_ / "x.vtp"));
}

/// Lets the process write files of at most `bytes`, as a full disk would.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(Vtk, a_full_disk_is_an_environment_error_that_names_the_file_and_spares_the_old_one) {
  const fs::path file = folder_ / "result.vtu";
  write_whole_file(file, "old");
  const std::size_t before = files_in(folder_);
  try {
    const SmallDisk disk(2000);
    write_vtu(file, brick(20));
    FAIL() << "wrote more than the disk holds";
  } catch (const EnvironmentError& e) {
    EXPECT_EQ(std::string(e.what()), "cannot write " + file.string() + ": File too large");
  }
  EXPECT_EQ(content(file), "old");
  EXPECT_EQ(files_in(folder_), before);
}

TEST_F(Vtk, a_missing_folder_is_an_environment_error_that_names_the_file) {
  const fs::path file = folder_ / "nowhere" / "patch.vtp";
  try {
    write_vtp(file, patch(1));
    FAIL();
  } catch (const EnvironmentError& e) {
    EXPECT_EQ(std::string(e.what()), "cannot write " + file.string() + ": No such file or directory");
  }
}

}  // namespace
}  // namespace railstrata
