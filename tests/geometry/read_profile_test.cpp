#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "core/faults.hpp"
#include "geometry/placement.hpp"
#include "geometry/profile_names.hpp"
#include "geometry/profile_texts.hpp"
#include "geometry/read_profile.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
constexpr double mm = 1e-3;

fs::path shipped(const char* name) { return source_dir() / "data" / "profiles" / name; }

class ReadProfile : public ::testing::Test {
 protected:
  fs::path written(const std::string& text, const char* name = "list.csv") {
    const fs::path file = folder_ / name;
    std::ofstream(file) << text;
    return file;
  }
  std::string error_of(const std::string& text, ProfileKind kind = ProfileKind::rail, const char* name = "list.csv") {
    try {
      read_profile(kind, written(text, name));
    } catch (const CaseError& e) {
      const std::string what = e.what();
      return what.substr(0, folder_.string().size()) == folder_.string() ? what.substr(folder_.string().size() + 1)
                                                                         : what;
    }
    return "accepted";
  }
  /// The shipped list as another file: each point (y, z), in mm and z down, printed by `print`.
  std::string relisted(const char* name, const std::function<std::string(double, double)>& print,
                       bool backwards = false) {
    std::ifstream in(shipped(name));
    std::vector<std::string> rows;
    for (std::string line; std::getline(in, line);) {
      double y, z;
      if (line[0] != '#' && std::sscanf(line.c_str(), "%lf,%lf", &y, &z) == 2) rows.push_back(print(y, z));
    }
    if (backwards) std::reverse(rows.begin(), rows.end());
    std::string text;
    for (const std::string& row : rows) text += row + "\n";
    return text;
  }
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

std::string formatted(const char* format, double a, double b) {
  char row[100];
  std::snprintf(row, sizeof row, format, a, b);
  return row;
}

/// A parabolic crown of 81 points, one a line, from `first_line` text on.
std::string crown(const std::string& heading = "", double scale = 1.0) {
  std::string text = heading;
  for (int i = -40; i <= 40; ++i) text += formatted("%.9f %.9f\n", scale * 0.8 * i, -scale * 0.64 * i * i / 100);
  return text;
}

void expect_same_curve(const Profile& a, const Profile& b, double tolerance) {
  const double lo = std::max(a.y_min(), b.y_min()) + 1 * mm, hi = std::min(a.y_max(), b.y_max()) - 1 * mm;
  ASSERT_GT(hi - lo, 60 * mm);
  for (int i = 0; i <= 500; ++i) {
    const double y = lo + (hi - lo) * i / 500;
    EXPECT_NEAR(a.height(y), b.height(y), tolerance) << "y = " << y;
  }
}

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
  for (const std::string& n : notes)
    if (n.find(text) != std::string::npos) return true;
  return false;
}

TEST_F(ReadProfile, the_listed_LMA_touches_CN60_where_the_arcs_do_with_their_curvature) {
  const Profile arcs = builtin_profile(ProfileKind::wheel, "LMA"),
                listed = read_profile(ProfileKind::wheel, shipped("lma_wheel.csv"));
  const Profile rail_arcs = builtin_profile(ProfileKind::rail, "CN60"),
                rail_listed = read_profile(ProfileKind::rail, shipped("cn60_head.csv"));
  for (const double shift : {-2.0, -1.0, 0.0, 1.0, 1.5, 5.0}) {
    TrackGeometry track;
    track.lateral_shift = shift * mm;
    const RigidContact exact = place_wheel(arcs, rail_arcs, track), read = place_wheel(listed, rail_listed, track);
    EXPECT_NEAR(read.point.y, exact.point.y, 5e-3 * mm) << shift;
    EXPECT_NEAR(read.wheel_offset_z, exact.wheel_offset_z, 1e-5 * mm) << shift;
    if (shift == 1.5) continue;  // 0.3 mm beside the jump from R450 to the cone, which a C2 curve cannot follow
    const double exact_sum = exact.curvature_wheel_lateral + exact.curvature_rail_lateral;
    EXPECT_NEAR(read.curvature_wheel_lateral + read.curvature_rail_lateral, exact_sum, 0.01 * exact_sum) << shift;
    EXPECT_NEAR(read.curvature_rail_lateral, exact.curvature_rail_lateral, 0.01 * exact.curvature_rail_lateral)
        << shift;
  }
}

TEST_F(ReadProfile, shipped_lists_read_back_as_the_built_in_profiles) {
  const std::pair<const char*, const char*> rails[] = {
      {"cn60_head.csv", "CN60"}, {"uic60_60e1_head.csv", "UIC60"}, {"uic54_54e1_head.csv", "UIC54"}};
  for (const auto& [file, name] : rails)
    expect_same_curve(read_profile(ProfileKind::rail, shipped(file)), builtin_profile(ProfileKind::rail, name),
                      1e-3 * mm);
  expect_same_curve(read_profile(ProfileKind::wheel, shipped("lma_wheel.csv")),
                    builtin_profile(ProfileKind::wheel, "LMA"), 5e-3 * mm);  // chamfer's kink
  expect_same_curve(read_profile(ProfileKind::wheel, shipped("s1002_wheel.csv")),
                    builtin_profile(ProfileKind::wheel, "S1002"), 1e-3 * mm);
}

TEST_F(ReadProfile, orientation_units_and_separators_are_found_and_said) {
  struct Variant {
    const char* what;
    std::function<std::string(double, double)> print;
    bool backwards;
    std::vector<std::string> notes;
  };
  const Variant variants[] = {
      {"z up, blanks", [](double y, double z) { return formatted("%.6f  %.6f", y, -z); }, false, {}},
      {"flange at positive y, tabs",
       [](double y, double z) { return formatted("%.6f\t%.6f", -y, z); },
       false,
       {"z was positive down; it was turned up.", "the profile was mirrored"}},
      {"metres, semicolons, backwards",
       [](double y, double z) { return formatted("%.9f; %.9f", y * mm, -z * mm); },
       true,
       {"taken as metres", "their order was reversed"}},
      {"lifted by 3 mm",
       [](double y, double z) { return formatted("%.6f,%.6f", y, 3 - z); },
       false,
       {"z was shifted by -3.000 mm"}},
      {"decimal commas",
       [](double y, double z) {
         std::string row = formatted("%.6f;%.6f;7", y, -z);
         for (char& c : row) c = c == '.' ? ',' : c;
         return row;
       },
       false,
       {"Commas were read as decimal commas.", "Only the first two of 3 columns were used."}},
  };
  const Profile lma = builtin_profile(ProfileKind::wheel, "LMA");
  for (const Variant& v : variants) {
    std::vector<std::string> notes;
    const Profile read = read_profile(
        ProfileKind::wheel,
        written("\xEF\xBB\xBFy z\r\n\"quoted\"\n" + relisted("lma_wheel.csv", v.print, v.backwards)), &notes);
    SCOPED_TRACE(v.what);
    expect_same_curve(read, lma, 5e-3 * mm);
    EXPECT_EQ(notes.size(), v.notes.size());
    for (const std::string& n : v.notes) EXPECT_TRUE(mentions(notes, n)) << n;
  }
}

TEST_F(ReadProfile, rail_turned_upside_down_or_worn_on_one_side_is_noted) {
  std::vector<std::string> notes;
  const auto worn = [](double y, double z) {
    return formatted("%.6f %.6f", y, y < -20 ? z + 0.001 * (y + 20) * (y + 20) : z);
  };
  const Profile read = read_profile(ProfileKind::rail, written(relisted("cn60_head.csv", worn)), &notes);
  EXPECT_LT(read.height(-0.030), read.height(0.030) - 0.05 * mm);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0], "list.csv: z was positive down; it was turned up.");
  EXPECT_EQ(notes[1], "list.csv: The head is not symmetric; its gauge side was taken at y < 0.");
}

TEST_F(ReadProfile, headings_counts_comments_and_inline_comments_are_passed_over) {
  EXPECT_EQ(error_of(crown("Rail scan 7\n# made up\n% y/mm z/mm\n! 3\n81\n") + "\n  # end\n"), "accepted");
}

TEST_F(ReadProfile, bad_lines_are_named_with_their_number) {
  EXPECT_EQ(error_of(crown("y_mm z_mm\n") + "33.0 oops\n"),
            "list.csv:83: '33.0 oops' is not two numbers\n    remedy: give two columns, y and z; mark comments with #");
  EXPECT_EQ(error_of(crown() + "33.0\n"),
            "list.csv:82: '33.0' is not two numbers\n    remedy: give two columns, y and z; mark comments with #");
  EXPECT_EQ(error_of(crown() + "33.0 nan\n"),
            "list.csv:82: '33.0 nan' is not a finite number\n    remedy: remove or repair the point");
}

TEST_F(ReadProfile, too_few_points_and_empty_files_are_refused) {
  EXPECT_NE(error_of("0 0\n1 0\n2 -1\n").find("list.csv: 3 points are too few for a profile"), std::string::npos);
  EXPECT_NE(error_of("").find("0 points are too few"), std::string::npos);
}

TEST_F(ReadProfile, a_loop_is_refused_with_the_line_where_it_closes) {
  std::string text;
  for (int i = 0; i < 80; ++i) {
    const double t = -4 + 0.1 * i;  // a strophoid-like curl
    text += formatted("%.6f %.6f\n", 8 * (t * t * t / 6 - t), -4 * t * t);
  }
  EXPECT_TRUE(error_of(text).find("the curve crosses itself") != std::string::npos) << error_of(text);
  EXPECT_EQ(error_of(text).substr(0, 9), "list.csv:") << error_of(text);
  EXPECT_NE(error_of(crown() + "30 -10\n").find("list.csv:82: the curve turns back on itself at point 81"),
            std::string::npos)
      << error_of(crown() + "30 -10\n");
}

TEST_F(ReadProfile, units_that_cannot_be_resolved_are_refused) {
  EXPECT_NE(error_of(crown("", 0.05))
                .find("which fits a profile neither in millimetres (20 to 500) nor in metres (0.02 to 0.5)"),
            std::string::npos);
  EXPECT_NE(error_of(crown("# units: mm\n", 1e-3))
                .find("the heading gives millimetres, but the curve would then be 6.813e-05 m long"),
            std::string::npos)
      << error_of(crown("# units: mm\n", 1e-3));
  EXPECT_NE(error_of(crown("y [m] z [m]\n")).find("the heading gives metres, but the curve would then be 68.13 m long"),
            std::string::npos)
      << error_of(crown("y [m] z [m]\n"));
  std::string mixed;
  for (int i = -40; i <= 40; ++i) mixed += formatted("%.6f %.9f\n", 0.8 * i, -1e-6 * i * i);
  EXPECT_NE(error_of(mixed).find("the columns seem to be in different units"), std::string::npos);
}

TEST_F(ReadProfile, an_origin_elsewhere_than_the_tape_circle_or_the_axis_is_refused) {
  const auto from_back = [](double y, double z) { return formatted("%.6f %.6f", y + 70, z); };
  EXPECT_NE(error_of(relisted("lma_wheel.csv", from_back), ProfileKind::wheel)
                .find("the flange's crest stands at y = 16.00 mm; from the tape circle it should be about 55 mm away"),
            std::string::npos);
  const auto from_track = [](double y, double z) { return formatted("%.6f %.6f", y + 753, z); };
  EXPECT_NE(error_of(relisted("cn60_head.csv", from_track)).find("the middle of the rail head stands at y = 753.00 mm"),
            std::string::npos);
}

TEST_F(ReadProfile, a_missing_file_is_named) {
  try {
    read_profile(ProfileKind::rail, "nowhere/profile.txt");
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_STREQ(e.what(),
                 "nowhere/profile.txt: cannot open the profile file\n    remedy: check the path; it is relative to the "
                 "case file");
  }
}

TEST_F(ReadProfile, another_encoding_is_named) {
  EXPECT_EQ(error_of(std::string("\xFF\xFE-\0"
                                 "3\0"
                                 "2\0",
                                 8))
                .find("list.csv: this profile is in UTF-16\n    remedy: save it as UTF-8"),
            0u);
}

TEST_F(ReadProfile, every_point_has_as_many_columns) {
  EXPECT_EQ(error_of("-32 -2.56\n-28 7 -1.96\n" + crown())
                .find("list.csv:2: '-28 7 -1.96' has 3 numbers, the lines before it 2\n    remedy: give every point as "
                      "many columns"),
            0u);
  EXPECT_EQ(error_of("-32,000.000, -2.56\n-8,000, -0.16\n-900.000, -0.002\n")
                .find("list.csv:3: '-900.000, -0.002' has 2 numbers, the lines before it 3"),
            0u);
}

TEST_F(ReadProfile, a_line_of_a_million_characters_is_a_line) {
  EXPECT_NE(error_of("1,5 2" + std::string(1'000'000, '0') + "x\n").find("is not two numbers"), std::string::npos);
  EXPECT_NE(error_of(std::string(1'000'000, 'm') + "\n").find("0 points are too few"), std::string::npos);
}

TEST_F(ReadProfile, more_points_than_a_profile_can_need_are_refused) {
  std::string text;
  for (int i = 0; i <= 20'000; ++i) text += formatted("%.6f %.6f\n", -30 + 3e-3 * i, 0);
  EXPECT_NE(error_of(text).find("20001 points are too many for a profile\n    remedy: thin them out to at most 20000"),
            std::string::npos);
}

TEST_F(ReadProfile, a_stray_point_that_the_curve_swings_out_to_is_refused_with_the_file) {
  const std::string error = error_of("-3 226\n-24 1.44\n-15 0.64\n-8 8.16\n0 0\n24 1.44\n32 2.56\n");
  EXPECT_EQ(error,
            "list.csv: list: the smooth curve through the points swings far out between them\n    remedy: remove stray "
            "points, or give more of them where the curve bends");
}

TEST_F(ReadProfile, nearly_repeated_points_beside_long_gaps_are_refused_with_the_file) {
  const std::string error = error_of("-24.001 -1.44\n0 0\n0.000002 0.00064\n0.02 0.001\n0.024 0\n20 -1.00048\n");
  EXPECT_EQ(error.find("list.csv"), 0u) << error;
  EXPECT_NE(error.find("remedy"), std::string::npos);
}

TEST_F(ReadProfile, a_curve_that_passes_the_axis_twice_is_refused_with_the_file) {
  const std::string error = error_of(
      "-32 -2.56\n-28 -1.902\n0.32 -0.00256\n24 -5.44\n-0.0 0\n4 -0.04\n8 -0.16\n12 -3.06\n16 -0.64\n20 -1\n24 "
      "-1.44\n28 -1.96\n32 -2.56\n");
  EXPECT_EQ(error.find("list.csv"), 0u) << error;
  EXPECT_NE(error.find("remedy"), std::string::npos);
}

TEST_F(ReadProfile, a_Simpack_file_is_shifted_cut_mirrored_reversed_in_this_order) {
  const std::string header =
      "header.begin\n  version = 1\n  type = 1 ! wheel\nheader.end\nspline.begin\n  approx.smooth = 1\n  shift.y = 2\n "
      " shift.z = -1\n  rotate = 0.0\n"
      "  bound.y.min = -80\n  bound.y.max = 70\n  bound.z.min = 1\n  bound.z.max = 0\n  mirror.y = 1\n  inversion = "
      "1\n  units.len.f = 1000.\n  point.begin\n    -90 5 1.0\n";
  const std::string rows =
      relisted("lma_wheel.csv", [](double y, double z) { return formatted("    %.6f  %.6f 1.0", y - 2, z + 1); });
  std::vector<std::string> notes;
  const Profile read =
      read_profile(ProfileKind::wheel, written(header + rows + "  point.end\nspline.end\n", "wheel.PRW"), &notes);
  expect_same_curve(read, builtin_profile(ProfileKind::wheel, "LMA"), 5e-3 * mm);
  for (const char* n :
       {"Simpack profile of", "shift.y = 2, shift.z = -1 were added.", "1 points were dropped by bound.y.",
        "mirror.y reversed the sign of y.", "inversion reversed", "approx.smooth was not applied.",
        "z was positive down; it was turned up.", "the profile was mirrored"})
    EXPECT_TRUE(mentions(notes, n)) << n;
  EXPECT_FALSE(mentions(notes, "bound.z"));
}

/// Points along a built-in profile, 0.25 mm apart.
std::vector<Vec2> points_along(const Profile& profile) {
  std::vector<Vec2> out;
  for (double s = profile.s_min(); s < profile.s_max(); s += 0.25e-3) out.push_back(profile.at(s).position);
  return out;
}

TEST_F(ReadProfile, what_is_written_for_Simpack_and_MiniProf_is_read_back) {
  struct Kind {
    ProfileKind kind;
    const char *name, *simpack, *miniprof;
  };
  for (const Kind& k : {Kind{ProfileKind::rail, "UIC60", "rail.prr", "rail.ban"},
                        Kind{ProfileKind::wheel, "S1002", "wheel.prw", "wheel.whl"}}) {
    const std::vector<Vec2> points = points_along(builtin_profile(k.kind, k.name));
    const Profile direct = Profile::from_points(k.kind, k.name, points);
    const std::string remark = "worn = 'by' 3\nloads!";
    for (const auto& [text, file] : {std::pair{simpack_text(k.kind, points, remark), k.simpack},
                                     std::pair{miniprof_text(k.kind, points, remark), k.miniprof}}) {
      const Profile read = read_profile(k.kind, written(text, file));
      ASSERT_NEAR(read.s_max() - read.s_min(), direct.s_max() - direct.s_min(), 1e-9) << file;
      for (const Vec2 p : points) {
        if (p.y <= direct.y_min() || p.y >= direct.y_max()) continue;
        EXPECT_NEAR(read.height(p.y), direct.height(p.y), 1e-9) << file << " at " << p.y;
      }
    }
  }
}

TEST_F(ReadProfile, a_list_in_Windows_1252_is_read_as_other_files_are_and_that_is_said) {
  std::vector<std::string> notes;
  const Profile read = read_profile(ProfileKind::rail, written(crown("# H\xF6he \xB5m?\n")), &notes);
  EXPECT_NEAR(read.height(16 * mm), -2.56 * mm, 1e-6 * mm);
  EXPECT_TRUE(mentions(notes, "list.csv: It is not in UTF-8: it was read as Windows-1252."));
  EXPECT_NE(error_of(crown() + "40 -10 n\xE4he\n").find("'40 -10 nähe' has 3 numbers"), std::string::npos);
  notes.clear();
  read_profile(ProfileKind::rail, written(crown("# Höhe\n")), &notes);
  EXPECT_FALSE(mentions(notes, "1252"));
}

TEST_F(ReadProfile, a_Simpack_file_tells_its_unit) {
  std::vector<std::string> notes;
  const Profile metres =
      read_profile(ProfileKind::rail,
                   written("% measured\nspline.begin\nunits.len.f = 1 % of a metre\npoint.begin\n% y z\n" +
                               crown("", 1e-3) + "point.end\nspline.end\n",
                           "rail.prr"),
                   &notes);
  EXPECT_NEAR(metres.height(16 * mm), -2.56 * mm, 1e-6 * mm);
  EXPECT_TRUE(mentions(notes, "units.len.f = 1: lengths were taken as parts of a metre."));
  EXPECT_NE(error_of("spline.begin\nunits.len.f = 1000\npoint.begin\n" + crown("", 1e-3) + "point.end\nspline.end\n",
                     ProfileKind::rail, "rail.prr")
                .find("the heading gives millimetres"),
            std::string::npos);
}

TEST_F(ReadProfile, what_is_wrong_with_a_Simpack_file_is_told_with_its_line) {
  const std::string list = "point.begin\n" + crown() + "point.end\n";
  const std::pair<std::string, const char*> wrong[] = {
      {"header.begin\ntype = 1\nheader.end\n" + list, "rail.prr:2: this Simpack profile is for a wheel"},
      {"spline.begin\nrotate = 0.1\n" + list, "rail.prr:2: rotate turns the points"},
      {"spline.begin\nshift.y = a\n" + list, "rail.prr:2: spline.shift.y = a is not a finite number"},
      {"spline.begin\nunits.len.f = 0\n" + list, "rail.prr:2: units.len.f must be above 0"},
      {list + list, "rail.prr:84: there is a second list of points"},
      {"point.begin\n1 nan\n", "rail.prr:2: '1 nan' is not two finite numbers"},
      {"1 2\n", "rail.prr:1: '1 2' is not a setting"},
      {"spline.begin\n", "rail.prr: there is no point.begin"},
      {"point.begin\n" + crown(), "rail.prr: the list of points has no point.end: the file is cut off"},
  };
  for (const auto& [text, message] : wrong)
    EXPECT_EQ(error_of(text, ProfileKind::rail, "rail.prr").find(message), 0u)
        << error_of(text, ProfileKind::rail, "rail.prr");
}

TEST_F(ReadProfile, MiniProf_files_new_and_old_lose_their_switched_off_points) {
  const std::string rows =
      relisted("lma_wheel.csv", [](double y, double z) { return formatted("%.6f\t%.6f\t0.1\t0.002", -y, -z); });
  std::vector<std::string> notes;
  const Profile fresh = read_profile(ProfileKind::wheel,
                                     written("ProgramName=MiniProf\r\nDate=24-12-2020\r\n12 "
                                             "3\r\nXYPoints=7\r\nColumnDef=X,Y,A,C\r\nXYPoints=7\r\n\r\n\"80 90\n" +
                                                 rows,
                                             "new.whl"),
                                     &notes);
  const Profile old = read_profile(
      ProfileKind::wheel,
      written("MINIPROF 101 148 1994\n12 and more words\n32.5 37.1 14.7  (Sd)\n\"a note\"\n\n" + rows, "old.WHL"));
  expect_same_curve(fresh, builtin_profile(ProfileKind::wheel, "LMA"), 5e-3 * mm);
  expect_same_curve(old, fresh, 1e-12);
  for (const char* n :
       {"MiniProf profile of", "1 points in quotes are switched off.", "XYPoints gives 7.", "the profile was mirrored"})
    EXPECT_TRUE(mentions(notes, n)) << n;
  EXPECT_EQ(error_of("ColumnDef=A,X,Y\n\n" + crown(), ProfileKind::rail, "rail.ban")
                .find("rail.ban:1: 'ColumnDef=A,X,Y': the columns do not begin with X,Y"),
            0u);
  for (const char* spelling : {"ColumnDef = A,X,Y\n\n", "columndef=Y,X\n\n"})
    EXPECT_NE(error_of(spelling + crown(), ProfileKind::rail, "rail.ban").find("the columns do not begin with X,Y"),
              std::string::npos)
        << spelling;
  EXPECT_EQ(error_of("ColumnDef= X,Y\n\n" + crown(), ProfileKind::rail, "rail.ban"), "accepted");
  EXPECT_EQ(error_of("XYPoints=83\n\n\"1 2\n" + crown(), ProfileKind::rail, "rail.ban")
                .find("rail.ban: XYPoints gives 83, but there are 81 points: the file is cut off"),
            0u);
  EXPECT_EQ(
      error_of("A=1\n\n1 2\nx 3\n", ProfileKind::rail, "rail.ban").find("rail.ban:4: 'x 3' is not two finite numbers"),
      0u);
}

}  // namespace
TEST_F(ReadProfile, ARailFromItsGaugeFaceIsMovedAndTurnedRoundWhenAsked) {
  const fs::path straight =
      written(relisted("cn60_head.csv", [](double y, double z) { return formatted("%.6f,%.6f", y, z); }));
  const Profile original = read_profile(ProfileKind::rail, straight);
  const fs::path moved = written(
      relisted("cn60_head.csv", [](double y, double z) { return formatted("%.6f,%.6f", 36.5 - y, z); }), "moved.csv");
  EXPECT_THROW(read_profile(ProfileKind::rail, moved), CaseError);
  const Profile back = read_profile(ProfileKind::rail, moved, nullptr, {true, 36.5 * mm});
  for (const double y : {-20 * mm, 5 * mm, 25 * mm}) EXPECT_NEAR(back.height(y), original.height(y), 1e-8);
}

TEST_F(ReadProfile, InchesAreTakenWhereTheHeadingHasThem) {
  const auto listed = [](double y, double z) { return formatted("%.8f,%.8f", y / 25.4, z / 25.4); };
  std::vector<std::string> notes;
  const Profile inches = read_profile(
      ProfileKind::rail, written("y [in],z [in]\n" + relisted("cn60_head.csv", listed), "inch.csv"), &notes);
  const Profile original = read_profile(ProfileKind::rail, shipped("cn60_head.csv"));
  EXPECT_NEAR(inches.height(20 * mm), original.height(20 * mm), 1e-8);
  EXPECT_NE(notes.front().find("inches"), std::string::npos);
}

TEST_F(ReadProfile, SmoothingAndHolesAreTold) {
  std::mt19937 random;
  const auto rough = [&](double y, double z) {
    const bool gap = y > 2 && y < 9;
    return gap ? std::string("#") : formatted("%.6f,%.6f", y, z + 1e-11 * static_cast<double>(random()));
  };
  std::vector<std::string> notes;
  read_profile(ProfileKind::rail, written(relisted("cn60_head.csv", rough), "rough.csv"), &notes);
  const auto told = [&](const char* words) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& n) { return n.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(told("The points were smoothed: a spline of"));
  EXPECT_TRUE(told("the spline bridges the hole"));
}

}  // namespace railstrata
