#include "geometry/profile_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "core/nearest_word.hpp"
#include "geometry/builtin_profiles.hpp"

namespace railstrata {
namespace {

using Maker = Profile (*)();

const std::map<std::string, Maker>& makers(ProfileKind kind) {
  static const std::map<std::string, Maker> wheels = {{"LMA", lma_wheel}, {"S1002", s1002_wheel}};
  static const std::map<std::string, Maker> rails = {{"CN60", cn60_rail}, {"UIC60", uic60_rail}, {"UIC54", uic54_rail}};
  return kind == ProfileKind::wheel ? wheels : rails;
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  return text;
}

constexpr double kSmallestArc = 5e-3, kLargestArc = 1000, kNarrowest = 0.5e-3, kWidest = 1;  // m
constexpr const char* kArcRemedy =
    "write for example arc:R=300 mm (convex), arc:R=-450 mm (hollow), or with its width arc:R=300 mm, W=10 mm";

/// A plane or an arc as its name has it.
struct Primitive {
  double radius = std::numeric_limits<double>::infinity(), width = 60e-3;  // m
};

/// "R=300 mm" by its letter.
double length_after(const std::string& name, const std::string& part, double least, double largest) {
  char* end = nullptr;
  const char* begin = part.c_str() + 2;
  const double value = std::strtod(begin, &end);
  std::string unit = end;
  std::erase(unit, ' ');
  const double scale = unit == "mm" ? 1e-3 : unit == "m" ? 1.0 : 0.0, length = value * scale;
  if (end == begin || scale == 0)
    throw CaseError(fmt::format("cannot read {} of the profile '{}'", part, name), kArcRemedy);
  if (!(std::abs(length) >= least && std::abs(length) <= largest))
    throw CaseError(
        fmt::format("{} of the profile '{}' is not between {:g} mm and {:g} m", part, name, 1e3 * least, largest),
        std::string(kArcRemedy) + "; a plane is flat");
  return length;
}

/// Of "flat:W=10 mm", "arc:R=300 mm" or "arc:R=300 mm, W=10 mm".
Primitive primitive_of(const std::string& name) {
  Primitive out;
  const std::size_t colon = name.find(':');
  std::string rest = colon == std::string::npos ? "" : name.substr(colon + 1);
  bool arc = false;
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    std::string part = rest.substr(0, comma);
    part.erase(0, part.find_first_not_of(' '));
    rest = comma == std::string::npos ? "" : rest.substr(comma + 1);
    const std::string key = upper(part.substr(0, 2));
    if (key == "R=") {
      out.radius = length_after(name, part, kSmallestArc, kLargestArc);
      arc = true;
    } else if (key == "W=") {
      out.width = std::abs(length_after(name, part, kNarrowest, kWidest));
    } else {
      throw CaseError("cannot read the profile '" + name + "'", kArcRemedy);
    }
  }
  if (arc != name.starts_with("arc")) throw CaseError("cannot read the profile '" + name + "'", kArcRemedy);
  return out;
}

}  // namespace

bool names_primitive(const std::string& name) {
  const std::string kind = name.substr(0, name.find(':'));
  return upper(kind) == "FLAT" || kind == "arc";
}

std::vector<std::string> builtin_profile_names(ProfileKind kind) {
  std::vector<std::string> names;
  for (const auto& [name, make] : makers(kind)) names.push_back(name);
  names.emplace_back("flat");
  return names;
}

std::string likely_profile(ProfileKind kind, const std::string& name) {
  static const std::map<std::string, std::string> names_of_en_13674 = {{"60E1", "UIC60"}, {"54E1", "UIC54"}};
  if (const auto found = names_of_en_13674.find(upper(name));
      kind == ProfileKind::rail && found != names_of_en_13674.end())
    return found->second;
  return nearest_word(name, builtin_profile_names(kind));
}

Profile builtin_profile(ProfileKind kind, const std::string& name) {
  if (names_primitive(name)) {
    const Primitive p = primitive_of(name);
    return circular_profile(kind, p.radius, 0.5 * p.width);
  }
  const auto found = makers(kind).find(upper(name));
  if (found != makers(kind).end()) return found->second();

  const std::vector<std::string> names = builtin_profile_names(kind);
  const std::string near = likely_profile(kind, name);
  throw CaseError(
      fmt::format("there is no built-in {} profile '{}'", kind == ProfileKind::wheel ? "wheel" : "rail", name),
      fmt::format("{}Known: {}, arc:R=300 mm; or give a file",
                  near.empty() ? "" : fmt::format("did you mean '{}'? ", near), fmt::join(names, ", ")));
}

Profile circular_profile(ProfileKind kind, double radius, double half_width) {
  if (!(half_width > 0) || !(std::abs(radius) > 0))
    throw CaseError("an arc profile needs a radius and a width", kArcRemedy);
  const bool plane = std::isinf(radius);
  const double r = std::abs(radius), w = plane ? half_width : std::min(half_width, 0.7 * r);
  const double body = kind == ProfileKind::rail ? -1.0 : 1.0;  // side of the material
  const double towards_centre = body * std::copysign(1.0, radius);
  const auto on_arc = [&](double y) {
    return Vec2{y, plane ? 0.0 : towards_centre * (y * y / (r + std::sqrt(r * r - y * y)))};
  };
  ProfileSegment g{on_arc(-w), on_arc(w), {0, plane ? 0.0 : towards_centre * r}, plane ? 0.0 : r};
  Profile out =
      Profile::from_segments(kind, plane ? std::string("flat") : fmt::format("arc:R={:g} mm", 1e3 * radius), {g});
  out.primitive_ = true;
  return out;
}

}  // namespace railstrata
