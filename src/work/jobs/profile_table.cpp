#include "jobs/profile_table.hpp"

#include "jobs/state_table.hpp"

namespace railstrata {
namespace {

const StateColumns<Vec2> kPoints{{"y", &Vec2::y, unit::kMillimetres}, {"z", &Vec2::z, unit::kMillimetres}};

}  // namespace

void write_profile_table(const std::filesystem::path& file, const std::vector<std::string>& origin,
                         const std::vector<Vec2>& points) {
  std::vector<Vec2> rows;
  for (const Vec2& p : points) rows.push_back(in_table(kPoints, p));
  write_rows(file, origin, kPoints, rows);
}

std::vector<Vec2> read_profile_table(const std::filesystem::path& file) {
  std::vector<Vec2> points = read_rows(file, kPoints);
  for (Vec2& p : points) p = in_si(kPoints, p);
  return points;
}

}  // namespace railstrata
