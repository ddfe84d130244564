// Lists of points as they come: what is wrong with them, or what they are worth, is said.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "geometry/profile_names.hpp"
#include "geometry/read_profile.hpp"

namespace railstrata {
namespace {

using Print = std::function<std::string(double, double)>;

/// A built-in profile every `spacing` mm, each point (y, z) in mm printed.
std::string listed(ProfileKind kind, const char* name, double spacing, const Print& print) {
  const Profile profile = builtin_profile(kind, name);
  std::string text;
  for (int i = static_cast<int>(std::ceil(1e3 * profile.y_min() / spacing)); i * spacing < 1e3 * profile.y_max(); ++i)
    text += print(i * spacing, 1e3 * profile.height(1e-3 * i * spacing)) + "\n";
  return text;
}

std::string six(double y, double z) { return fmt::format("{:.6f},{:.6f}", y, z); }

std::string answer_to(ProfileKind kind, const std::string& text) {
  try {
    parse_profile(kind, text, "list.csv");
  } catch (const CaseError& e) {
    return e.what();
  }
  return "accepted";
}

std::string notes_of(ProfileKind kind, const std::string& text) {
  std::vector<std::string> notes;
  parse_profile(kind, text, "list.csv", &notes);
  std::string out;
  for (const std::string& note : notes) out += note + "\n";
  return out;
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(ProfileLists, FortranExponentsAndTheMinusSignOfUnicodeAreNumbers) {
  const auto fortran = [](double y, double z) {
    std::string row = fmt::format("{:E} {:E}", y, z);
    for (char& c : row) c = c == 'E' ? 'D' : c;
    return row;
  };
  const auto unicode = [](double y, double z) {
    std::string row = six(y, z);
    for (std::size_t at = 0; (at = row.find('-', at)) != std::string::npos;) row.replace(at, 1, "\xE2\x88\x92");
    return row;
  };
  for (const Print& print : {Print(fortran), Print(unicode)})
    EXPECT_EQ(answer_to(ProfileKind::rail, listed(ProfileKind::rail, "CN60", 0.5, print)), "accepted");
}

TEST(ProfileLists, ASpoiledRowBeforeTheFirstPointIsAnErrorAndATitleIsNot) {
  const auto half_lost = [](double y, double z) { return (y < -5 ? "L" : "") + six(y, z); };
  EXPECT_TRUE(has(answer_to(ProfileKind::wheel, "y [mm],z [mm]\n" + listed(ProfileKind::wheel, "LMA", 0.5, half_lost)),
                  "list.csv:2: 'L-"));
  const std::string rows = listed(ProfileKind::rail, "UIC60", 0.5, six);
  EXPECT_FALSE(has(notes_of(ProfileKind::rail, "UIC 60\n" + rows), "not read"));
  EXPECT_TRUE(has(notes_of(ProfileKind::rail, "UIC 60\nof 2020\nlateral,height\n" + rows),
                  "3 lines before the first point were not read"));
}

TEST(ProfileLists, PointsOutOfOrderAndAnOutlineOfTheWholeRailAreNamed) {
  std::vector<std::string> rows;
  listed(ProfileKind::rail, "CN60", 0.2, [&](double y, double z) { return rows.emplace_back(six(y, z)); });
  std::string shuffled, outline = "y,z\n";
  for (std::size_t i = 0; i < rows.size(); ++i) shuffled += rows[i * 101 % rows.size()] + "\n";
  EXPECT_TRUE(has(answer_to(ProfileKind::rail, shuffled), "the points are not in order along the curve"));
  for (const std::string& row : rows) outline += row + "\n";
  for (int k = 0; k < 140; ++k) outline += six(36 - 0.2 * k, -10 - k) + "\n";
  EXPECT_TRUE(has(answer_to(ProfileKind::rail, outline), "this is an outline of the whole rail"));
}

TEST(ProfileLists, OfAWholeSectionTheHeadIsTaken) {
  std::vector<std::string> points;
  listed(ProfileKind::rail, "CN60", 0.2, [&](double y, double z) { return points.emplace_back(six(y, z)); });
  const std::size_t head = points.size();
  for (const auto& [y, z] : {std::pair{35.0, -37.0},
                             {20.0, -42.0},
                             {9.0, -60.0},
                             {8.0, -75.0},
                             {8.0, -90.0},
                             {8.5, -105.0},
                             {9.0, -120.0},
                             {10.0, -136.0},
                             {20.0, -150.0},
                             {38.0, -157.0},
                             {56.0, -161.5},
                             {74.0, -164.0},
                             {75.0, -176.0}})
    points.push_back(six(y, z));
  for (int k = 1; k < 10; ++k) points.push_back(six(75 - 15.0 * k, -176));
  for (std::size_t i = 13; i-- > 0;) {
    double y = 0, z = 0;
    std::sscanf(points[head + i].c_str(), "%lf,%lf", &y, &z);
    points.push_back(six(-y, z));
  }
  std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(points.size() - 20), points.end());
  std::string outline = "y,z\n";
  for (const std::string& point : points) outline += point + "\n";
  EXPECT_TRUE(has(notes_of(ProfileKind::rail, outline), fmt::format("its head was taken, {} of", head)))
      << notes_of(ProfileKind::rail, outline);
}

TEST(ProfileLists, AnotherUnitAndAColumnThatCountsAreNamed) {
  const auto inches = [](double y, double z) { return six(y / 25.4, z / 25.4); };
  const auto micrometres = [](double y, double z) { return fmt::format("{:.3f} {:.3f}", 1e3 * y, 1e3 * z); };
  EXPECT_TRUE(has(answer_to(ProfileKind::rail, listed(ProfileKind::rail, "CN60", 0.5, inches)), "if these are inches"));
  EXPECT_TRUE(has(answer_to(ProfileKind::rail, listed(ProfileKind::rail, "CN60", 0.5, micrometres)),
                  "these seem to be micrometres"));
  int count = 0;
  const auto counted = [&](double y, double z) { return fmt::format("{} {}", ++count, six(y, z)); };
  EXPECT_TRUE(has(answer_to(ProfileKind::rail, listed(ProfileKind::rail, "CN60", 0.5, counted)),
                  "the first column counts the points"));
}

TEST(ProfileLists, DigitsSpecksAndAHeadAsideAreSaid) {
  const auto rounded = [](double y, double z) { return fmt::format("{:.2f},{:.2f}", y, z); };
  EXPECT_TRUE(has(notes_of(ProfileKind::wheel, listed(ProfileKind::wheel, "LMA", 0.5, rounded)),
                  "Heights are rounded to 0.01 mm"));
  std::mt19937 random(3);
  const auto speckled = [&](double y, double z) {
    const double noise = 1e-12 * static_cast<double>(random());  // 1.2 um
    return six(y, z + noise + (std::abs(y - 7) < 0.01 ? 0.03 : 0));
  };
  const std::string notes = notes_of(ProfileKind::rail, listed(ProfileKind::rail, "CN60", 0.2, speckled));
  EXPECT_TRUE(has(notes, "(y = 7.00 mm) lies ")) << notes;
  EXPECT_TRUE(has(notes, "it was left out")) << notes;
  const auto aside = [](double y, double z) { return six(y + 4, z); };
  EXPECT_TRUE(has(notes_of(ProfileKind::rail, listed(ProfileKind::rail, "CN60", 0.2, aside)),
                  "The middle between the head's faces stands at y = 4.0"));
}

/// No jump where points come to lie half a millimetre apart.
TEST(ProfileLists, ARoundedListKeepsItsCurveAtAnySpacing) {
  const auto rounded = [](double y, double z) { return fmt::format("{:.2f},{:.2f}", y, z); };
  const Profile exact = builtin_profile(ProfileKind::wheel, "LMA");
  for (const double spacing : {0.1, 0.3, 0.45, 0.5, 0.55, 0.8, 1.2}) {
    const Profile read =
        parse_profile(ProfileKind::wheel, listed(ProfileKind::wheel, "LMA", spacing, rounded), "list.csv");
    double squares = 0;
    int count = 0;
    for (double y = -20e-3; y < 40e-3; y += 1e-4, ++count)
      squares += std::pow(read.height(y) - exact.height(y) - exact.height(0), 2);
    EXPECT_LT(std::sqrt(squares / count), 5e-6) << "every " << spacing << " mm";
  }
}

TEST(ProfileLists, FiveThousandPointsAreReadWithinASecond) {
  std::mt19937 random(1);
  const std::string text = listed(ProfileKind::rail, "CN60", 0.0145, [&](double y, double z) {
    return six(y, z + 1e-12 * static_cast<double>(random()));
  });
  EXPECT_GT(std::count(text.begin(), text.end(), '\n'), 4900);
  const auto begin = std::chrono::steady_clock::now();
  parse_profile(ProfileKind::rail, text, "list.csv");
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 1.0);
}

}  // namespace
}  // namespace railstrata
