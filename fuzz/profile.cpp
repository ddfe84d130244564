// Profile files. First byte: odd for a wheel, else a rail; its half mod 3: columns, Simpack, MiniProf. Then the file.
#include <algorithm>
#include <cmath>

#include "geometry/read_profile.hpp"
#include "reader.hpp"

using namespace railstrata;
using fuzz::promise;

namespace {

bool finite(Vec2 v) { return std::isfinite(v.y) && std::isfinite(v.z); }

void check(const Profile& p) {
  const std::vector<double>& knots = p.knots();
  promise(knots.size() >= 2 && std::is_sorted(knots.begin(), knots.end(), std::less_equal<>()), "knots increase");
  promise(std::isfinite(p.s_min()) && std::isfinite(p.s_max()), "the arc length is finite");
  promise(p.s_max() - p.s_min() > 4e-3 && p.s_max() - p.s_min() < 1, "a profile measures between 5 and 500 mm");
  promise(p.y_min() <= 0 && p.y_max() >= 0 && p.y_min() < p.y_max(), "the running surface covers y = 0");
  promise(std::abs(p.height(0)) < 1e-7, "z is zero at y = 0");
  constexpr int n = 16;
  for (int i = 0; i <= n; ++i) {
    const ProfilePoint at = p.at(i == n ? p.s_max() : p.s_min() + (p.s_max() - p.s_min()) * i / n);
    promise(finite(at.position) && finite(at.tangent) && std::isfinite(at.curvature), "points are finite");
    promise(std::abs(norm(at.tangent) - 1) < 1e-9 && std::abs(dot(at.tangent, at.outward)) < 1e-9,
            "tangent and normal are unit vectors");
    const double y = p.y_min() + (p.y_max() - p.y_min()) * i / n;
    promise(std::abs(p.at(p.s_at_y(y)).position.y - y) < 1e-6, "the running surface is a graph over y");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const ProfileKind kind = data[0] & 1 ? ProfileKind::wheel : ProfileKind::rail;
  const std::string_view text = fuzz::text_of(data + 1, size - 1);
  static const std::filesystem::path kNames[] = {"profile.csv", "profile.prr", "profile.ban"};
  std::vector<std::string> notes;
  fuzz::accepts([&] { check(parse_profile(kind, text, kNames[data[0] / 2 % 3], &notes)); });
  return 0;
}
