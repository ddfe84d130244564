#include "geometry/read_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <regex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/faults.hpp"
#include "core/printable.hpp"
#include "geometry/exchange_profiles.hpp"
#include "geometry/number_table.hpp"
#include "geometry/point_defects.hpp"
#include "geometry/point_scatter.hpp"
#include "geometry/profile_signs.hpp"
#include "geometry/smoothing_spline.hpp"

namespace railstrata {
namespace {

constexpr std::size_t kMostPoints = 20'000;                      // all pairs of chords are compared
constexpr std::streamsize kLargestFile = 16 << 20;               // bytes
constexpr double kShortestCurve = 0.020, kLongestCurve = 0.500;  // m, curve of a listed profile
constexpr double kSmallestFlange = 0.009;                  // m: lower than any flange, higher than any tread's fall
constexpr double kCrestNear = -0.035, kCrestFar = -0.075;  // m, y of the flange's crest (nominal -0.054 to -0.056)
constexpr double kAxisTolerance = 0.015;                   // m, of the middle of a rail head
constexpr double kSameHeight = 1e-7;                       // m
constexpr double kHole = 2e-3;                             // m, between neighbours that stand closer elsewhere
constexpr double kSymmetry = 0.02e-3;                      // m
constexpr double kOffAxis = 1e-3;                          // m, of a head's middle: worn faces move it by less
constexpr double kHighestHead = 0.09;                      // m: a rail's foot is farther below its crown

struct Extent {
  double lo = 0, hi = 0;
  double size() const { return hi - lo; }
};

Extent extent(const std::vector<Vec2>& points, double Vec2::*component) {
  const auto [lowest, highest] = std::minmax_element(
      points.begin(), points.end(), [&](const Vec2& a, const Vec2& b) { return a.*component < b.*component; });
  return {(*lowest).*component, (*highest).*component};
}

NumberTable table_in(ProfileKind kind, std::string_view text, const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  if (ending == ".prr" || ending == ".prw") return parse_simpack(kind, text, file.string());
  if (ending == ".ban" || ending == ".whl") return parse_miniprof(text, file.string());
  return parse_number_table(text, file.string());
}

NumberTable table_of(ProfileKind kind, std::string_view text, const std::filesystem::path& file) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw CaseError("this profile is in UTF-16", "save it as UTF-8 or plain text", file.string());
  if (const std::string sign = sign_of_binary(text); !sign.empty())
    throw CaseError(fmt::format("this is not a text: {}", sign),
                    "give a table of y and z as a text, or a file of Simpack or MiniProf", file.string());
  const DecodedText readable = decoded(std::string(text));
  NumberTable out = table_in(kind, readable.text, file);
  if (readable.from_windows_1252) out.notes.emplace_back("It is not in UTF-8: it was read as Windows-1252.");
  return out;
}

class Reading {
 public:
  Reading(ProfileKind kind, NumberTable table, const std::filesystem::path& file, const ProfileFrame& frame)
      : kind_(kind), file_(file), frame_(frame), table_(std::move(table)), points_(table_.rows), notes_(table_.notes) {}

  Profile profile(std::vector<std::string>* notes) {
    if (points_.size() < 5)
      fail(fmt::format("{} points are too few for a profile", points_.size()),
           "give at least 5 points; every 0.1 to 1 mm is usual");
    if (points_.size() > kMostPoints)
      fail(fmt::format("{} points are too many for a profile", points_.size()),
           fmt::format("thin them out to at most {}; every 0.1 to 1 mm is usual", kMostPoints));
    if (table_.decimal_commas) note("Commas were read as decimal commas.");
    if (table_.columns > 2) note(fmt::format("Only the first two of {} columns were used.", table_.columns));
    drop_repeated_points();
    if (table_.skipped > 1) note(fmt::format("{} lines before the first point were not read.", table_.skipped));
    std::vector<double> heights;
    for (const Vec2& p : points_) heights.push_back(p.z);
    rounding_ = last_digit(heights);
    to_metres();
    to_frame();
    drop_stray_points();
    if (const auto defect = find_defect(points_)) fail(defect->message, defect->remedy, table_.lines[defect->index]);
    kind_ == ProfileKind::wheel ? orient_wheel() : orient_rail();
    if (points_.front().y > points_.back().y) {
      std::reverse(points_.begin(), points_.end());
      note("The points were listed from the field side; their order was reversed.");
    }
    Profile out = at_origin();
    if (notes)
      for (const std::string& n : notes_) notes->push_back(file_.filename().string() + ": " + n);
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& message, const std::string& remedy, int line = 0) const {
    throw CaseError(message, remedy, line > 0 ? fmt::format("{}:{}", file_.string(), line) : file_.string());
  }
  void note(std::string text) { notes_.push_back(std::move(text)); }

  void drop_repeated_points() {
    const std::size_t before = points_.size();
    for (std::size_t i = points_.size(); i-- > 1;) {
      if (norm(points_[i] - points_[i - 1]) > 0) continue;
      points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(i));
      table_.lines.erase(table_.lines.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (points_.size() < before) note(fmt::format("{} repeated points were removed.", before - points_.size()));
  }

  void to_frame() {
    if (frame_.mirror) note("The sign of y was reversed, as the case requests.");
    if (frame_.offset != 0) note(fmt::format("{:.3f} mm were added to y, as the case requests.", 1e3 * frame_.offset));
    for (Vec2& p : points_) p.y = (frame_.mirror ? -p.y : p.y) + frame_.offset;
  }

  /// Leaves out points off the curve of their neighbours, and names them.
  void drop_stray_points() {
    constexpr std::size_t kTold = 5;
    scatter_ = scatter_of(points_, rounding_);
    const std::vector<StrayPoint> strays = stray_points(points_, scatter_);
    for (std::size_t i = 0; i < std::min(strays.size(), kTold); ++i) {
      const StrayPoint& p = strays[i];
      note(
          fmt::format("Line {} (y = {:.2f} mm) lies {:.1f} um off the curve of its neighbours, which scatter by {:.2g} "
                      "um: it was left out.",
                      table_.lines[p.index], 1e3 * points_[p.index].y, 1e6 * p.off, 1e6 * scatter_.noise));
    }
    if (strays.size() > kTold) note(fmt::format("{} more such points were left out.", strays.size() - kTold));
    for (std::size_t i = strays.size(); i-- > 0;) {
      points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(strays[i].index));
      table_.lines.erase(table_.lines.begin() + static_cast<std::ptrdiff_t>(strays[i].index));
    }
  }

  void scale(double factor) {
    for (Vec2& p : points_) p = factor * p;
    rounding_ *= factor;
  }

  /// "y [in]", "inch", "inches".
  void from_inches() {
    static const std::regex says_inch(R"([\[\(]in[\]\)]|\binch(es)?\b)", std::regex::icase);
    if (!std::regex_search(table_.heading, says_inch)) return;
    scale(25.4);
    note("The heading gives inches; the numbers were read as inches.");
  }

  /// How many points lie so far from the lowest, or from the highest if these are fewer.
  std::ptrdiff_t far_below(double height) const {
    const Extent z = extent(points_, &Vec2::z);
    const auto count = [&](auto&& far) { return std::count_if(points_.begin(), points_.end(), far); };
    return std::min(count([&](Vec2 p) { return p.z > z.lo + height; }),
                    count([&](Vec2 p) { return p.z < z.hi - height; }));
  }

  /// Faults of a list that would show as a curve of a strange length.
  void refuse_other_lists(double y, double z, double length) const {
    constexpr double kInOrder = 3;  // length over extents: a curve goes down at both ends
    constexpr std::ptrdiff_t kSomeStray = 4;
    bool counts = table_.columns > 2 && (points_.front().y == 0 || points_.front().y == 1);
    for (std::size_t i = 1; i < points_.size() && counts; ++i) counts = points_[i].y == points_[i - 1].y + 1;
    if (counts) fail("the first column counts the points", "give y and z as the first two columns");
    if (length > kInOrder * (y + z))
      fail(fmt::format("the points are not in order along the curve: joined as listed they make {:.4g} of way within "
                       "{:.4g} by {:.4g}",
                       length, y, z),
           "list the points from one end of the curve to the other; a head or tread without steep ends can be sorted "
           "by y");
    const double unit = y < 1 ? 1 : 1e-3;  // m
    if (kind_ == ProfileKind::rail && z * unit < kLongestCurve && far_below(kHighestHead / unit) > kSomeStray)
      fail(fmt::format("the points span {:.0f} mm of height: this is an outline of the whole rail", 1e3 * z * unit),
           "give the points of the head alone, from one face over the running surface to the other");
  }

  /// Of the outline of a whole rail, points in order around it, the head: from the crown down both faces to where they
  /// are widest. Leaves any other list as it is.
  void keep_head() {
    constexpr double kLowestRail = 0.1, kFootBand = 0.012, kNarrowestFoot = 0.1, kWidestHead = 0.09,
                     kLowestFace = 0.045;
    constexpr double kTurnsIn = 0.3e-3, kFarthestPoint = 0.02;  // m
    const Extent y = extent(points_, &Vec2::y), z = extent(points_, &Vec2::z);
    const double unit = y.size() < 1 ? 1 : 1e-3;  // m
    const auto width = [&](bool low) {
      Extent of{y.hi, y.lo};
      for (const Vec2& p : points_)
        if ((low ? p.z - z.lo : z.hi - p.z) * unit < kFootBand) of = {std::min(of.lo, p.y), std::max(of.hi, p.y)};
      return unit * of.size();
    };
    const bool up = width(true) > kNarrowestFoot && width(false)<kWidestHead, down = width(false)> kNarrowestFoot &&
                    width(true) < kWidestHead;
    if (kind_ != ProfileKind::rail || up == down || unit * z.size() < kLowestRail) return;
    const double middle = 0.5 * (y.lo + y.hi), crown_z = up ? z.hi : z.lo;
    const auto depth = [&](Vec2 p) { return unit * std::abs(p.z - crown_z); };
    std::size_t crown = 0;
    const auto off_crown = [&](Vec2 p) { return depth(p) + unit * std::abs(p.y - middle); };
    for (std::size_t i = 1; i < points_.size(); ++i)
      if (off_crown(points_[i]) < off_crown(points_[crown])) crown = i;
    const std::size_t n = points_.size();
    const auto face = [&](std::size_t step) {  // how many points that way: step 1 or n - 1
      double widest = 0;
      std::size_t count = 0, kept = 0;
      for (std::size_t i = crown; count + 1 < n; i = (i + step) % n, ++count) {
        const double aside = unit * std::abs(points_[i].y - middle);
        const Vec2 next = points_[(i + step) % n];
        if (aside >= widest) kept = count;
        widest = std::max(widest, aside);
        if (depth(points_[i]) > kLowestFace || aside < widest - kTurnsIn ||
            unit * norm(next - points_[i]) > kFarthestPoint)
          break;
      }
      return kept;
    };
    const std::size_t after = face(1), before = face(n - 1);
    std::vector<Vec2> head;
    std::vector<int> lines;
    for (std::size_t k = 0; k <= before + after; ++k) {
      const std::size_t i = (crown + n - before + k) % n;
      head.push_back(points_[i]);
      lines.push_back(table_.lines[i]);
    }
    note(fmt::format("This is the outline of a whole rail: its head was taken, {} of {} points.", head.size(), n));
    points_ = std::move(head);
    table_.lines = std::move(lines);
  }

  [[noreturn]] void refuse_unit(double length) const {
    constexpr double kInch = 25.4, kMicrometresInMillimetre = 1e3;
    const auto of_a_profile = [](double mm) { return mm >= 1e3 * kShortestCurve && mm <= 1e3 * kLongestCurve; };
    std::string remedy = "give y and z in millimetres or metres";
    if (of_a_profile(kInch * length))
      remedy += "; if these are inches, say so in a heading: y [in], z [in]";
    else if (of_a_profile(length / kMicrometresInMillimetre))
      remedy += "; these seem to be micrometres";
    fail(fmt::format("the curve is {:.4g} long, which fits a profile neither in millimetres (20 to 500) nor in "
                     "metres (0.02 to 0.5)",
                     length),
         remedy);
  }

  void to_metres() {
    from_inches();
    const double y = extent(points_, &Vec2::y).size(), z = extent(points_, &Vec2::z).size();
    if ((z > 0 && z < 5e-4 * y) || y < 2e-2 * z)
      fail(fmt::format("y spans {:.4g} and z spans {:.4g}: the columns seem to be in different units", y, z),
           "give both columns in millimetres or both in metres");
    keep_head();
    double length = 0;
    for (std::size_t i = 1; i < points_.size(); ++i) length += norm(points_[i] - points_[i - 1]);
    refuse_other_lists(extent(points_, &Vec2::y).size(), extent(points_, &Vec2::z).size(), length);
    const bool metres = length >= kShortestCurve && length <= kLongestCurve,
               millimetres = length >= 1e3 * kShortestCurve && length <= 1e3 * kLongestCurve;
    if (!metres && !millimetres) refuse_unit(length);
    static const std::regex says_mm(R"((^|[^A-Za-z])mm([^A-Za-z]|$))"),
        says_m(R"([\[\(_]m([\]\)\s,;]|$)|\bmet(re|er)s?\b)");
    const bool claims_mm = std::regex_search(table_.heading, says_mm),
               claims_m = std::regex_search(table_.heading, says_m);
    if (claims_mm != claims_m && claims_mm != millimetres)
      fail(fmt::format("the heading gives {}, but the curve would then be {:.4g} m long",
                       claims_mm ? "millimetres" : "metres", claims_mm ? 1e-3 * length : length),
           "correct the heading or the numbers");
    if (metres) note("The numbers were taken as metres.");
    scale(metres ? 1.0 : 1e-3);
  }

  void flip_z(const char* reason) {
    for (Vec2& p : points_) p.z = -p.z;
    note(reason);
  }

  void orient_wheel() {
    const auto nearest =
        std::min_element(points_.begin(), points_.end(), [](Vec2 a, Vec2 b) { return std::abs(a.y) < std::abs(b.y); });
    const double tread = nearest->z, above = extent(points_, &Vec2::z).hi - tread,
                 below = tread - extent(points_, &Vec2::z).lo;
    if (std::max(above, below) < kSmallestFlange) {
      note("No flange was found; y was taken as positive to the field side and z as positive up.");
      return;
    }
    if (above > below) flip_z("z was positive down; it was turned up.");
    const Vec2 crest = *std::min_element(points_.begin(), points_.end(), [](Vec2 a, Vec2 b) { return a.z < b.z; });
    const double crest_y = -std::abs(crest.y);
    if (crest_y > kCrestNear || crest_y < kCrestFar)
      fail(fmt::format("the flange's crest stands at y = {:.2f} mm; from the tape circle it should be about 55 mm away",
                       1e3 * crest.y),
           "put y = 0 at the tape circle, 70 mm from the flange back, or give geometry.wheel_offset, which is added to "
           "y");
    if (crest.y > 0) {
      for (Vec2& p : points_) p.y = -p.y;
      note("The flange was on the side of positive y; the profile was mirrored.");
    }
  }

  void orient_rail() {
    const Extent y = extent(points_, &Vec2::y);
    const double middle = 0.5 * (y.lo + y.hi);
    if (std::abs(middle) > kAxisTolerance)
      fail(fmt::format("the middle of the rail head stands at y = {:.2f} mm", 1e3 * middle),
           fmt::format(
               "y = 0 is the rail's axis: if it is the gauge face here, give geometry.rail_offset = \"{:.2f} mm\", "
               "which is added to y",
               -1e3 * middle));
    const auto centre = std::min_element(points_.begin(), points_.end(), [&](Vec2 a, Vec2 b) {
      return std::abs(a.y - middle) < std::abs(b.y - middle);
    });
    if (0.5 * (points_.front().z + points_.back().z) > centre->z) flip_z("z was positive down; it was turned up.");
  }

  Profile curve() const {
    try {
      return Profile::from_points(kind_, file_.stem().string(), points_, scatter_.rounding);
    } catch (const CaseError& e) {
      fail(e.diagnostics.front().message, e.diagnostics.front().remedy);
    }
  }

  /// The profile with z = 0 at y = 0.
  Profile at_origin() {
    Profile out = curve();
    const double height = out.height(0);
    if (std::abs(height) > 1e-8) {
      for (Vec2& p : points_) p.z -= height;
      out = curve();
      if (!(std::abs(out.height(0)) < kSameHeight))
        fail("the curve crosses y = 0 more than once, at different heights",
             "list the points in order along the curve, only for the running surface");
    }
    if (std::abs(height) > 1e-6)
      note(fmt::format(
          "z was shifted by {} so that it is zero at y = 0; heights count from there.",
          std::abs(height) < 1e-3 ? fmt::format("{:.1f} um", -1e6 * height) : fmt::format("{:.3f} mm", -1e3 * height)));
    if (kind_ == ProfileKind::rail && asymmetric(out))
      note("The head is not symmetric; its gauge side was taken at y < 0.");
    if (kind_ == ProfileKind::rail)
      if (const double middle = head_middle(out).value_or(0); std::abs(middle) > kOffAxis)
        note(
            fmt::format("The middle between the head's faces stands at y = {:.2f} mm, y = 0 was taken as the rail's "
                        "axis: geometry.rail_offset moves it.",
                        1e3 * middle));
    tell_smoothing();
    return out;
  }

  /// What the fit did to the points.
  void tell_smoothing() {
    constexpr double kSmallestMovement = 1e-6;  // m, of a measured profile; the digits of a listed one move less
    if (scatter_.rounding > 0)
      note(fmt::format("Heights are rounded to {:.3g} mm: points {:.2g} mm apart scatter by {:.1f} um.",
                       1e3 * scatter_.rounding, 1e3 * scatter_.spacing, 1e6 * scatter_.noise));
    const SmoothingSpline fit = fit_smoothing_spline(points_, scatter_.rounding);
    double squares = 0, largest = 0, hole = 0, steps = 0;
    std::vector<double> apart;
    for (const double m : fit.miss) {
      squares += m * m;
      largest = std::max(largest, m);
    }
    for (std::size_t i = 1; i < points_.size(); ++i) apart.push_back(norm(points_[i] - points_[i - 1]));
    const auto widest = std::max_element(apart.begin(), apart.end());
    hole = *widest;
    const Vec2 at = points_[static_cast<std::size_t>(widest - apart.begin())];
    std::nth_element(apart.begin(), apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2), apart.end());
    steps = apart[apart.size() / 2];
    if (largest > kSmallestMovement)
      note(
          fmt::format("The points were smoothed: a spline of {} knots over {:.0f} mm deviates from them by {:.1f} um "
                      "rms, {:.1f} um at most.",
                      fit.s.size(), 1e3 * (fit.s.back() - fit.s.front()),
                      1e6 * std::sqrt(squares / static_cast<double>(fit.miss.size())), 1e6 * largest));
    if (hole > kHole && hole > 4 * steps)
      note(fmt::format("No points lie between y = {:.1f} mm and the next, {:.1f} mm away: the spline bridges the hole.",
                       1e3 * at.y, 1e3 * hole));
  }

  static bool asymmetric(const Profile& rail) {
    const double reach = std::min(-rail.y_min(), rail.y_max());
    for (int i = 1; i < 20; ++i)
      if (const double y = 0.9 * reach * i / 20; std::abs(rail.height(y) - rail.height(-y)) > kSymmetry) return true;
    return false;
  }

  ProfileKind kind_;
  std::filesystem::path file_;
  ProfileFrame frame_;
  NumberTable table_;
  std::vector<Vec2> points_;
  double rounding_ = 0;  ///< last digit of the heights, in the unit of the points
  PointScatter scatter_;
  std::vector<std::string> notes_;
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw CaseError("cannot open the profile file", "check the path; it is relative to the case file", file.string());
  std::string text(kLargestFile + 1, '\0');
  in.read(text.data(), kLargestFile + 1);
  if (in.bad()) throw CaseError("cannot read the profile file", "check that it is a text file", file.string());
  if (in.gcount() > kLargestFile)
    throw CaseError(fmt::format("this file is larger than {} MiB", kLargestFile >> 20),
                    "a profile is two columns of at most some thousand points", file.string());
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

Profile parse_profile(ProfileKind kind, std::string_view text, const std::filesystem::path& file,
                      std::vector<std::string>* notes, const ProfileFrame& frame) {
  return Reading(kind, table_of(kind, text, file), file, frame).profile(notes);
}

Profile profile_of_points(ProfileKind kind, std::vector<Vec2> points, const std::string& name,
                          std::vector<std::string>* notes) {
  for (std::size_t k = 0; k < points.size(); ++k)
    if (!std::isfinite(points[k].y) || !std::isfinite(points[k].z))
      throw CaseError(fmt::format("point {} is not a finite number", k + 1), "remove or repair it", name);
  NumberTable table;
  table.lines.resize(points.size());
  std::iota(table.lines.begin(), table.lines.end(), 1);
  table.rows = std::move(points);
  return Reading(kind, std::move(table), name, {}).profile(notes);
}

Profile read_profile(ProfileKind kind, const std::filesystem::path& file, std::vector<std::string>* notes,
                     const ProfileFrame& frame) {
  return parse_profile(kind, text_of(file), file, notes, frame);
}

}  // namespace railstrata
