#include "validate/validation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/places.hpp"
#include "text/text_file.hpp"
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
  return validate(set, {options});
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

TEST(Validation, AFactorCountsToBothSidesAndIsTheLargestOfTheRows) {
  const std::string by = "[[compare]]\ncolumn = \"p\"\nresult = \"p_max_MPa\"\nby = \"factor\"\nbar = 3\n";
  const ValidationSet low = SetFolder(by, "load,p\n20,1306.36\n40,822.96\n").load();
  EXPECT_NEAR(solved(low).comparisons[0].difference, 2, 0.01);
  EXPECT_EQ(solved(low).agreement, Agreement::within_bar);
  const ValidationSet high = SetFolder(by, "load,p\n20,653.18\n40,200\n").load();
  EXPECT_NEAR(solved(high).comparisons[0].difference, 822.96 / 200, 0.02);
  EXPECT_EQ(solved(high).agreement, Agreement::outside);
  EXPECT_THROW(SetFolder(by + "relative = true\n", "load,p\n20,653.18\n").load(), CaseError);
}

TEST(Validation, RowsThatAreNoCurveAreDrawnOverTheData) {
  const SetFolder files(kCompare, "load,p\n20,653.18\n40,822.96\n30,747.7\n");
  const ValidationSet set = files.load();
  const Validation v = solved(set);
  EXPECT_EQ(v.comparisons[0].points[2].x, 30);
  EXPECT_NE(comparison_svg(v, set.compared[0]).find("p of the data"), std::string::npos);
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

/// What a set of another kind needs before its columns.
std::string head_of(const std::string& kind) {
  return "title = \"T\"\nsource = \"S\"\nreference = \"computed\"\nuncertainty = \"none\"\nfitted = \"nothing\"\nkind "
         "= \"" +
         kind + "\"\n";
}

std::string vary(const std::string& column, const std::string& rest = "") {
  return "[[vary]]\ncolumn = \"" + column + "\"\nkey = \"" + column + "\"\n" + rest;
}

std::string compare(const std::string& result) {
  return "[[compare]]\ncolumn = \"" + result + "\"\nresult = \"" + result + "\"\nbar = 1\n";
}

std::string faults_of(const SetFolder& files) {
  try {
    files.load();
  } catch (const CaseError& e) {
    return e.what();
  }
  return "";
}

// Tension to 0.4 % and back to 0, perfectly plastic at 300 MPa, E = 200 GPa: +300, then 300 - 800 < -300 MPa. From the
// virgin state nothing is left of the first row.
TEST(Validation, RowsOfAMaterialAreAPathOrEachBeginsAnew) {
  for (const bool anew : {false, true}) {
    const SetFolder files("", "e_xx,s_xx_MPa,yield_MPa\n0.004,300,300\n0,-300,300\n");
    files.write("case.toml", "[material.rail]\nyoung = \"200 GPa\"\nyield_strength = \"300 MPa\"\n");
    files.write("validation.toml", head_of("material") + (anew ? "from_virgin = true\n" : "") + vary("e_xx") +
                                       compare("s_xx_MPa") + compare("yield_MPa"));
    const ValidationSet set = files.load();
    const Validation v = solved(set);
    ASSERT_EQ(v.comparisons.size(), 2u);
    EXPECT_NEAR(v.comparisons[0].points[0].ours, 300, 1e-4);
    EXPECT_NEAR(v.comparisons[0].points[1].ours, anew ? 0 : -300, 1e-4);
    EXPECT_NEAR(v.comparisons[1].points[1].ours, 300, 1e-9);
  }
}

// On the axis of a circle of radius 5 mm under 100 MPa, 5 mm deep: sigma_z = -p (1 - 1/sqrt 8) [Johnson1985 sec. 3.4].
TEST(Validation, RowsOfAPressureArePointsBelowTheCircles) {
  const SetFolder files("", "depth,sigma_zz_MPa\n5,-64.645\n");
  const std::string circle = "[[circle]]\nx = \"2 mm\"\nradius = \"5 mm\"\npressure = \"100 MPa\"\n";
  const std::string rest = vary("depth", "unit = \"mm\"\n") + compare("sigma_zz_MPa");
  files.write("data.csv", "x,depth,sigma_zz_MPa\n2,5,-64.645\n");
  files.write("validation.toml", head_of("pressure") + circle + vary("x", "unit = \"mm\"\n") + rest);
  const ValidationSet set = files.load();
  EXPECT_NEAR(solved(set).comparisons[0].points[0].ours, -100 * (1 - std::pow(0.5, 1.5)), 5e-3);
  files.write("data.csv", "x,depth,sigma_zz_MPa\n2,0,-100\n");
  EXPECT_THROW(solved(files.load()), CaseError);
}

TEST(Validation, ShakedownIsANumberOfAContact) {
  const SetFolder files("[[compare]]\ncolumn = \"factor\"\nresult = \"shakedown_wandering\"\nbar = 0.1\n",
                        "load,factor\n20,4.63\n");
  files.write("case.toml", std::string(kBall) + "[material.rail]\nyield_strength = \"1131.34 MPa\"\n");  // k = p0
  const ValidationSet set = files.load();
  EXPECT_NEAR(solved(set).comparisons[0].points[0].ours, 4.632, 0.03);
}

// Of the rows of a table of results the first one that fits; a row without one has no answer. Names with commas.
TEST(Validation, AnswersMayHaveBeenRecorded) {
  const SetFolder files(
      kCompare + "[[series]]\nname = \"fem, of last year\"\nrecorded = \"study.csv\"\n" + "where = [\"engine=fem\"]\n",
      "load,p\n20,653.18\n40,822.96\n60,942\n");
  files.write("study.csv",
              "# a remark\ngroup,engine,vehicle.wheel_load,p_max_MPa\n\"a, b\",bem,20 kN,1\na,fem,20 kN,650\n"
              "b,fem,20 kN,2\na,fem,40 kN,820\na,fem,60 kN,\n");
  const ValidationSet set = files.load();
  const Validation v = solved(set);
  EXPECT_EQ(v.comparisons[0].points[0].ours, 650);
  EXPECT_EQ(v.comparisons[0].points[1].ours, 820);
  EXPECT_TRUE(std::isnan(v.comparisons[0].points[2].ours));
  EXPECT_EQ(v.agreement, Agreement::unsolved);
  const TemporaryFolder out;
  write_validation(out.path(), {}, v);
  EXPECT_EQ(read_csv(out.path() / "comparison.csv").columns.back().name, "ours of p fem; of last year");
  files.write("data.csv", "load,p\n20,653.18\n80,1036\n");
  const ValidationSet other = files.load();
  EXPECT_EQ(solved(other).faults, std::vector<std::string>{"fem, of last year, row 2: study.csv has no row with engine "
                                                           "= fem, vehicle.wheel_load = 80 kN"});
}

TEST(Validation, ANumberThatNoRowHasIsNamed) {
  const SetFolder files("[[compare]]\ncolumn = \"p\"\ntitle = \"limit\"\nresult = \"shakedown_upper\"\nbar = 1\n",
                        "load,p\n20,4.6\n");  // of a steel without a strength
  const ValidationSet set = files.load();
  EXPECT_EQ(solved(set).faults,
            std::vector<std::string>{"limit: answers of this kind and case have no shakedown_upper"});
}

TEST(Validation, FaultsOfAKindAreNamed) {
  const SetFolder files("", "e_xx,s_xx_MPa\n0.004,300\n");
  const std::string columns = vary("e_xx") + compare("s_xx_MPa");
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {head_of("liquid") + columns, "kind = \"liquid\" is unknown"},
           {head_of("material") + vary("load") + compare("s_xx_MPa"), "key = \"load\" is unknown"},
           {head_of("material") + vary("e_xx") + compare("p_max_MPa"), "no number of an answer"},
           {head_of("material") + "cell = \"1 mm\"\n" + columns, "cell belongs to kind = \"contact\""},
           {head_of("material") + "increments = 0\n" + columns, "a whole number from 1"},
           {head_of("pressure") + vary("depth") + compare("sigma_zz_MPa"), "nothing presses"},
           {head_of("pressure") + "[[circle]]\nradius = \"0 mm\"\npressure = \"1 MPa\"\n", "must be above 0"},
           {head_of("pressure") + "[[circle]]\nradius = \"5 kN\"\npressure = \"1 MPa\"\n", "radius = \"5 kN\""}}) {
    files.write("validation.toml", text);
    EXPECT_NE(faults_of(files).find(words), std::string::npos) << faults_of(files);
  }
}

TEST(Validation, ThePageOfTheDocumentationHasEveryKindWithItsKeys) {
  const std::string page = read_text_file(source_dir() / "docs/validate.md", "");
  for (const ValidationKind& kind : validation_kinds()) {
    EXPECT_NE(page.find("| `" + std::string(kind.name) + "` |"), std::string::npos) << kind.name;
    for (const std::string& key : kind.settings) EXPECT_NE(page.find(key), std::string::npos) << key;
  }
}

TEST(Validation, RelativeToZeroIsRefused) {
  const SetFolder files(kCompare, "load,p\n20,653.18\n40,0\n");
  EXPECT_NE(faults_of(files).find("\"p\" is 0 in row 2"), std::string::npos) << faults_of(files);
}

TEST(Validation, NothingToCompareIsAMistake) {
  const SetFolder files("", "load,p\n20,653.18\n");
  EXPECT_THROW(files.load(), CaseError);
}

TEST(Validation, EverySetThatComesWithTheProgramIsRead) {
  const std::vector<fs::path> folders = validation_folders(source_dir() / "cases/validation");
  EXPECT_GE(folders.size(), 19u);
  for (const fs::path& folder : folders) {
    const ValidationSet set = load_validation(folder);
    EXPECT_EQ(set.name, folder.filename());
    EXPECT_GT(set.data.rows(), 0u) << set.name;
  }
}

}  // namespace
}  // namespace railstrata
