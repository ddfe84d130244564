#include "geometry/profile_texts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "record/unit.hpp"

namespace railstrata {
namespace {

/// In one line, without what begins a comment or ends a text.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\'' || c == '!' || c == '='; },
      ' ');
  return text;
}

std::string row(Vec2 p, std::string_view between) {
  return fmt::format("{:.10g}{}{:.10g}", kToMilli * p.y, between, kToMilli * p.z);
}

}  // namespace

std::string simpack_text(ProfileKind kind, const std::vector<Vec2>& points, const std::string& remark) {
  std::string out = fmt::format(
      "header.begin\n  version = 1\n  type = {}\nheader.end\nspline.begin\n  comment = '{}'\n  approx.smooth = 0\n"
      "  units.len = 'mm'\n  units.len.f = 1000\n  units.ang = 'rad'\n  units.ang.f = 1\n  point.dist.min = 0\n"
      "  shift.y = 0\n  shift.z = 0\n  rotate = 0\n  bound.y.min = 0\n  bound.y.max = 0\n  bound.z.min = 0\n"
      "  bound.z.max = 0\n  mirror.y = 0\n  mirror.z = 0\n  inversion = 0\n  point.begin\n",
      kind == ProfileKind::wheel ? 1 : 0, one_line(remark));
  for (const Vec2 p : points) out += fmt::format("    {} 1\n", row(p, " "));
  return out + "  point.end\nspline.end\n";
}

std::string miniprof_text(ProfileKind kind, const std::vector<Vec2>& points, const std::string& remark) {
  std::string out = fmt::format("ProgramName=RailStrata\nProfileType={}\nComment={}\nXYPoints={}\nColumnDef=X,Y\n\n",
                                kind == ProfileKind::wheel ? "Wheel" : "Rail", one_line(remark), points.size());
  for (const Vec2 p : points) out += row(p, "\t") + "\n";
  return out;
}

}  // namespace railstrata
