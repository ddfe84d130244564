#include "validate/validation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/places.hpp"
#include "validate/validation_page.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBall = R"([geometry]
rail_profile = "flat"
wheel_profile = "arc:R=430 mm"
rail_shape = "block"
wheel_shape = "disc"
wheel_radius = "430 mm"
bore_radius = "200 mm"
cant = 0.0
[drive]
traction_coefficient = 0.0
)";
constexpr const char* kHead = R"(title = "Ball"
source = "Hertz"
reference = "closed form"
uncertainty = "none"
fitted = "nothing"
cell = "0.4 mm"
[[vary]]
column = "load"
key = "load"
unit = "kN"
)";

/// Loads of 20 and 40 kN on a ball of 430 mm: 653.18 and 822.96 MPa by Hertz.
struct SetFolder {
  TemporaryFolder folder;
  SetFolder(const std::string& rest, const std::string& data) {
    write("case.toml", kBall);
    write("validation.toml", kHead + rest);
    write("data.csv", data);
  }
  void write(const char* name, const std::string& text) const { std::ofstream(folder.path() / name) << text; }
  ValidationSet load() const { return load_validation(folder.path()); }
};

Validation solved(const ValidationSet& set) {
  BemOptions options;
  options.cell = 0.4e-3;
  return validate(set, options, nullptr);
}

const std::string kCompare = "[[compare]]\ncolumn = \"p\"\nresult = \"p_max_MPa\"\nrelative = true\nbar = 0.02\n";

TEST(Validation, DifferenceIsTheLargestOfTheRowsOrTheirRootMeanSquare) {
  const SetFolder files(kCompare + "[[compare]]\ncolumn = \"p\"\nresult = \"p_max_MPa\"\nby = \"rms\"\nbar = 1\n",
                        "load,p\n20,653.18\n40,800\n");
  const ValidationSet set = files.load();
  const Validation v = solved(set);
  ASSERT_EQ(v.comparisons.size(), 2u);
  const std::vector<ComparedPoint>& points = v.comparisons[0].points;
  EXPECT_NEAR(points[0].ours / 653.18, 1, 3e-3);
  EXPECT_EQ(points[1].x, 40);
  const double first = points[0].ours - 653.18, second = points[1].ours - 800;
  EXPECT_DOUBLE_EQ(v.comparisons[0].difference, second / 800);
  EXPECT_DOUBLE_EQ(v.comparisons[1].difference, std::sqrt(0.5 * (first * first + second * second)));
  EXPECT_EQ(v.comparisons[0].agreement, Agreement::outside);
  EXPECT_EQ(v.agreement, Agreement::outside) << "the worst";
}

TEST(Validation, SeriesThatIsNotJudgedDoesNotCount) {
  const SetFolder files(kCompare +
                            "[[series]]\nname = \"steel\"\n[[series]]\nname = \"soft\"\njudged = false\n"
                            "set = [\"material.rail.young=100 GPa\"]\n",
                        "load,p\n20,653.18\n");
  const ValidationSet set = files.load();
  const Validation v = solved(set);
  ASSERT_EQ(v.comparisons.size(), 2u);
  EXPECT_LT(v.comparisons[1].points[0].ours, 0.9 * v.comparisons[0].points[0].ours);
  EXPECT_EQ(v.comparisons[1].agreement, Agreement::not_judged);
  EXPECT_EQ(v.agreement, Agreement::within_bar);
}

TEST(Validation, ScatterIsThatOfTheDataAsTheBarHasIt) {
  const SetFolder files(kCompare + "deviation = \"sd\"\n", "load,p,sd\n20,640,20\n40,822.96,20\n");
  const ValidationSet set = files.load();
  const Validation v = solved(set);
  EXPECT_DOUBLE_EQ(v.comparisons[0].scatter, 20.0 / 640);
  EXPECT_EQ(v.agreement, Agreement::within_scatter);
  const std::string picture = comparison_svg(v, set.compared[0]);
  EXPECT_NE(picture.find("<circle"), std::string::npos);
  EXPECT_NE(picture.find("with their standard deviation"), std::string::npos);
}

TEST(Validation, NothingToCompareIsAMistake) {
  const SetFolder files("", "load,p\n20,653.18\n");
  EXPECT_THROW(files.load(), CaseError);
}

TEST(Validation, EverySetThatComesWithTheProgramIsRead) {
  const std::vector<fs::path> folders = validation_folders(source_dir() / "cases/validation");
  EXPECT_GE(folders.size(), 8u);
  for (const fs::path& folder : folders) {
    const ValidationSet set = load_validation(folder);
    EXPECT_EQ(set.name, folder.filename());
    EXPECT_GT(set.data.rows(), 0u) << set.name;
  }
}

}  // namespace
}  // namespace railstrata
