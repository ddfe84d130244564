#include "app/profile_report.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/shipped_files.hpp"
#include "geometry/profile_names.hpp"
#include "geometry/profile_scatter.hpp"
#include "geometry/profile_signs.hpp"
#include "geometry/profile_texts.hpp"
#include "geometry/read_profile.hpp"
#include "io/output_folder.hpp"
#include "model/profile_doubts.hpp"
#include "record/output_file.hpp"
#include "report/svg_page.hpp"

namespace railstrata {
namespace {

struct ReadFile {
  Profile profile;
  std::vector<std::string> notes;
};

std::string ending_of(const std::filesystem::path& file) {
  std::string out = file.extension().string();
  for (char& c : out) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return out;
}

ReadFile read_as(ProfileKind kind, const std::filesystem::path& file) {
  std::vector<std::string> notes;
  Profile profile = read_profile(kind, file, &notes);
  return {std::move(profile), std::move(notes)};
}

/// Both ends of a head hang below its crown; of a wheel's ends one does at most.
bool hangs_at_both_ends(const Profile& p) {
  constexpr double kBelow = -5e-3;  // m
  return p.at(p.s_min()).position.z < kBelow && p.at(p.s_max()).position.z < kBelow;
}

/// By the ending; without one that says it, a rail where both ends hang, else a wheel if it can be read as one.
ReadFile read_by_shape(const std::filesystem::path& file, const std::string& kind) {
  const std::string ending = ending_of(file);
  if (kind == "rail" || ending == ".prr" || ending == ".ban") return read_as(ProfileKind::rail, file);
  if (kind == "wheel" || ending == ".prw" || ending == ".whl") return read_as(ProfileKind::wheel, file);
  std::optional<ReadFile> rail;
  std::optional<CaseError> not_a_rail;
  try {
    rail = read_as(ProfileKind::rail, file);
    if (hangs_at_both_ends(rail->profile)) return std::move(*rail);
  } catch (const CaseError& e) {
    not_a_rail = e;
  }
  try {
    return read_as(ProfileKind::wheel, file);
  } catch (const CaseError&) {
    if (not_a_rail) throw *not_a_rail;
    return std::move(*rail);
  }
}

struct ProfileFact {
  std::string label, text;
};

std::string radius_text(double curvature) {
  constexpr double kFlat = 0.02;  // 1/m
  if (std::abs(curvature) < kFlat) return "flat";
  return fmt::format("{:.0f} mm{}", 1e3 / std::abs(curvature), curvature < 0 ? " hollow" : "");
}

std::string radii_text(const Profile& p) {
  std::string out;
  for (const double y : {-0.03, -0.02, -0.01, 0.0, 0.01, 0.02, 0.03})
    if (y > p.y_min() && y < p.y_max())
      out +=
          fmt::format("{}{:g}: {}", out.empty() ? "at y = " : ", ", 1e3 * y, radius_text(p.at(p.s_at_y(y)).curvature));
  return out;
}

std::vector<ProfileFact> profile_facts(const Profile& p) {
  const ListedPoints& listed = *p.listed();
  const PointScatter& s = listed.scatter;
  std::vector<ProfileFact> out{
      {"points", fmt::format("{}, every {:.2g} mm; {}; scatter {:.2g} um", listed.points.size(), 1e3 * s.spacing,
                             s.rounding > 0 ? fmt::format("heights rounded to {:.2g} mm", 1e3 * s.rounding)
                                            : "heights finer than a micrometre",
                             1e6 * s.noise)},
      {"y", fmt::format("{:.2f} to {:.2f} mm, running surface {:.2f} to {:.2f} mm; the side of the {} is y < 0",
                        1e3 * p.at(p.s_min()).position.y, 1e3 * p.at(p.s_max()).position.y, 1e3 * p.y_min(),
                        1e3 * p.y_max(), p.kind() == ProfileKind::rail ? "gauge" : "flange")}};
  if (const auto middle = head_middle(p); middle && p.kind() == ProfileKind::rail)
    out.push_back(
        {"head's middle", fmt::format("y = {:.2f} mm, between the faces 14 mm below the top", 1e3 * *middle)});
  if (const auto slope = head_inclination(p); slope && p.kind() == ProfileKind::rail)
    out.push_back({"inclination", inclination_text(*slope) + ", of the running surface at the head's middle"});
  if (const auto back = flange_back(p); back && p.kind() == ProfileKind::wheel)
    out.push_back({"flange back", fmt::format("{:.2f} mm from the tape circle", 1e3 * *back)});
  out.push_back({"radius", radii_text(p)});
  out.push_back({"error bar", leaves_open(p) ? "p_max and forces of `bem` contain what these points leave open"
                                             : "the points leave nothing open that counts"});
  return out;
}

/// The curve above, its curvature below.
std::string drawing_of(const Profile& p) {
  constexpr int kPieces = 400;
  constexpr double kMostCurvature = 20;  // 1/m, drawn
  std::vector<double> y, z, at, curvature;
  for (const Vec2& point : p.listed()->points) {
    y.push_back(1e3 * point.y);
    z.push_back(1e3 * point.z);
  }
  for (int i = 0; i <= kPieces; ++i) {
    at.push_back(p.y_min() + (p.y_max() - p.y_min()) * i / kPieces);
    curvature.push_back(std::clamp(p.at(p.s_at_y(at.back())).curvature, -kMostCurvature, kMostCurvature));
    at.back() *= 1e3;
  }
  const auto [y0, y1] = std::minmax_element(y.begin(), y.end());
  const auto [z0, z1] = std::minmax_element(z.begin(), z.end());
  const double width = 640, margin = 2;
  const SvgFrame curve{
      60,           30,           width,        width * (*z1 - *z0 + 2 * margin) / (*y1 - *y0 + 2 * margin),
      *y0 - margin, *y1 + margin, *z0 - margin, *z1 + margin};
  const SvgFrame bend{
      60, curve.top + curve.height + 70, width, 200, curve.x0, curve.x1, -kMostCurvature, kMostCurvature};
  SvgPage page(width + 90, bend.top + bend.height + 50);
  page.axes(curve, "y, mm", fmt::format("{}: z, mm", p.name()));
  page.line(curve, y, z, "#1f5fa8", false);
  page.axes(bend, "y, mm", "curvature, 1/m");
  page.line(bend, at, curvature, "#1f5fa8", false);
  return page.finish();
}

void write_profile(const std::filesystem::path& out, const Profile& p) {
  const std::vector<Vec2>& points = p.listed()->points;
  const bool rail = p.kind() == ProfileKind::rail;
  const std::string remark = fmt::format("{}, by railstrata check", p.name());
  std::string list = "y_mm,z_mm\n";
  for (const Vec2& point : points) list += fmt::format("{:.10g},{:.10g}\n", 1e3 * point.y, 1e3 * point.z);
  write_whole_file(out / "profile.csv", list);
  write_whole_file(out / (rail ? "profile.prr" : "profile.prw"), simpack_text(p.kind(), points, remark));
  write_whole_file(out / (rail ? "profile.ban" : "profile.whl"), miniprof_text(p.kind(), points, remark));
  write_whole_file(out / "profile.svg", drawing_of(p));
}

nlohmann::ordered_json profile_json(const ReadFile& read, const std::vector<std::string>& doubts) {
  const Profile& p = read.profile;
  const PointScatter& s = p.listed()->scatter;
  nlohmann::ordered_json out{{"kind", p.kind() == ProfileKind::rail ? "rail" : "wheel"},
                             {"points", p.listed()->points.size()},
                             {"spacing_m", s.spacing},
                             {"rounding_m", s.rounding},
                             {"scatter_m", s.noise},
                             {"leaves_open", leaves_open(p)},
                             {"notes", read.notes},
                             {"warnings", doubts}};
  if (p.kind() == ProfileKind::rail) {
    if (const auto slope = head_inclination(p)) out["inclination"] = *slope;
    if (const auto middle = head_middle(p)) out["head_middle_m"] = *middle;
  } else if (const auto back = flange_back(p)) {
    out["flange_back_m"] = *back;
  }
  return out;
}

}  // namespace

bool names_profile_file(const std::filesystem::path& file) {
  constexpr std::array kEndings{".csv", ".txt", ".dat", ".prr", ".prw", ".ban", ".whl"};
  const std::string ending = ending_of(file);
  return std::any_of(kEndings.begin(), kEndings.end(), [&](const char* known) { return ending == known; });
}

ExitCode check_profile(const CommandOptions& options, const std::string& kind) {
  const ReadFile read = read_by_shape(shipped_unless_there(options.case_file), kind);
  const Profile& p = read.profile;
  GeometrySpec geometry;
  (p.kind() == ProfileKind::rail ? geometry.rail_profile : geometry.wheel_profile) = options.case_file.string();
  const Profile none = builtin_profile(p.kind() == ProfileKind::rail ? ProfileKind::wheel : ProfileKind::rail, "flat");
  const std::vector<std::string> doubts =
      p.kind() == ProfileKind::rail ? profile_doubts(geometry, none, p) : profile_doubts(geometry, p, none);
  if (!options.out.empty()) {
    const FolderHold hold = prepare_output_folder(options.out, options.force);
    write_profile(options.out, p);
  }
  if (options.json) {
    fmt::print("{}\n", profile_json(read, doubts).dump(2));
    return ExitCode::ok;
  }
  fmt::print("{:<14} {}: a {}\n", "profile", options.case_file.string(),
             p.kind() == ProfileKind::rail ? "rail" : "wheel");
  for (const ProfileFact& fact : profile_facts(p)) fmt::print("{:<14} {}\n", fact.label, fact.text);
  for (const std::string& note : read.notes) spdlog::info("{}", note);
  for (const std::string& doubt : doubts) spdlog::warn("{}", doubt);
  if (!options.out.empty())
    spdlog::info("profile.svg, .csv and files of Simpack and MiniProf are in {}", options.out.string());
  return ExitCode::ok;
}

}  // namespace railstrata
