#include "table/force_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "core/lagrange.hpp"

namespace railstrata {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::size_t below(const std::vector<double>& at, double value) {
  return static_cast<std::size_t>(std::upper_bound(at.begin() + 1, at.end() - 1, value) - at.begin()) - 1;
}

bool ascends(const std::vector<double>& at) {
  if (!std::all_of(at.begin(), at.end(), [](double v) { return std::isfinite(v); })) return false;
  return std::adjacent_find(at.begin(), at.end(), [](double a, double b) { return !(a < b); }) == at.end();
}

void check_axis(const TableAxis& axis) {
  if (axis.at.size() < 2 || !ascends(axis.at))
    throw CaseError(fmt::format("the axis {} must be in ascending order", axis.name),
                    "give at least two values, each once");
}

void check_number(const TableNumber& number, std::size_t points) {
  if (number.values.size() != points)
    throw CaseError(fmt::format("{} has {} values, but there are {} points", number.name, number.values.size(), points),
                    "give one value for each point");
}

template <class Part>
std::optional<std::size_t> index_of(const std::vector<Part>& parts, const char* name) {
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (parts[k].name == name) return k;
  return std::nullopt;
}

void check_scaling(const ForceTable& table, const TableScaling& scaling) {
  const std::string remedy = "compute the table again with railstrata creep --scaled";
  if (table.axes.size() < kScaledAxes)
    throw CaseError(fmt::format("a scaled table with {} axes", table.axes.size()), remedy);
  const auto count = [&](std::size_t k) { return static_cast<int>(table.axes[k].at.size()); };
  const std::vector<TableAxis> own = scaled_axes(count(0), count(1), count(2));
  std::size_t others = table.points();
  for (std::size_t k = 0; k < kScaledAxes; ++k) {
    const auto same = [](double a, double b) { return std::abs(a - b) < 1e-12; };
    if (count(k) < 4 || !std::equal(own[k].at.begin(), own[k].at.end(), table.axes[k].at.begin(), same))
      throw CaseError(fmt::format("the axis {} of a scaled table does not have its fixed values", own[k].name), remedy);
    check_axis(scaling.asked[k]);
    others /= table.axes[k].at.size();
  }
  for (const TableNumber& k : scaling.stiffness) check_number(k, others);
  const bool load = index_of(table.axes, "load") || scaling.load > 0,
             friction = index_of(table.axes, "friction") || scaling.friction > 0;
  if (!load || !friction || !(scaling.largest_size > 0 && scaling.largest_size < 1))
    throw CaseError("a scaled table needs load, friction and largest size", remedy);
}

/// A stiffness at a point of the axes after the third.
CreepStiffness stiffness_at(const TableScaling& scaling, std::size_t outer) {
  return {scaling.stiffness[0].values[outer], scaling.stiffness[1].values[outer], scaling.stiffness[2].values[outer]};
}

/// A force in the direction of an angle and across it; by the negative angle, back.
void turn(double& x, double& y, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), along = c * x + s * y;
  y = c * y - s * x;
  x = along;
}

}  // namespace

std::size_t ForceTable::points() const {
  std::size_t n = 1;
  for (const TableAxis& axis : axes) n *= axis.at.size();
  return n;
}

const TableAxis& ForceTable::asked(std::size_t axis) const {
  return scaling && axis < kScaledAxes ? scaling->asked[axis] : axes[axis];
}

std::vector<TableAxis> scaled_axes(int angles, int spins, int sizes) {
  std::vector<TableAxis> out{{"creepage_angle", "", {}}, {"spin_angle", "", {}}, {"creepage_size", "", {}}};
  for (int k = 0; k < angles; ++k) out[0].at.push_back(kTurn * (static_cast<double>(k) / angles - 0.5));
  for (int k = 0; k < spins; ++k) out[1].at.push_back(0.5 * kTurn * (static_cast<double>(k) / (spins - 1) - 0.5));
  for (int k = 0; k < sizes; ++k) out[2].at.push_back(static_cast<double>(k) / (sizes - 1));
  return out;
}

void check(const ForceTable& table) {
  if (table.axes.empty() || table.axes.size() > kMostAxes)
    throw CaseError(fmt::format("a table of {} axes", table.axes.size()), fmt::format("give 1 to {}", kMostAxes));
  for (const TableAxis& axis : table.axes) check_axis(axis);
  for (const TableNumber& number : table.numbers) check_number(number, table.points());
  if (table.scaling) check_scaling(table, *table.scaling);
}

std::vector<double> grid_place(const ForceTable& table, std::size_t point) {
  std::vector<double> out(table.axes.size());
  for (std::size_t k = out.size(); k-- > 0; point /= table.axes[k].at.size())
    out[k] = table.axes[k].at[point % table.axes[k].at.size()];
  return out;
}

std::vector<double> asked_place(const ForceTable& table, std::size_t point) {
  std::vector<double> out = grid_place(table, point);
  if (!table.scaling) return out;
  const TableScaling& scaling = *table.scaling;
  const ScaledLoad at = load_at(table, out.data());
  const Creepages creepages = creepages_at(
      {out[0], out[1], out[2] * scaling.largest_size},
      creep_units(stiffness_at(scaling, point % scaling.stiffness[0].values.size()), at.load, at.friction));
  std::copy(creepages.begin(), creepages.end(), out.begin());
  return out;
}

ScaledLoad load_at(const ForceTable& table, const double* place) {
  const auto load = index_of(table.axes, "load"), friction = index_of(table.axes, "friction");
  return {load ? place[*load] : table.scaling->load, friction ? place[*friction] : table.scaling->friction};
}

TableInterpolation::TableInterpolation(const ForceTable& table) : table_(&table), stride_(table.axes.size()) {
  check(table);
  std::size_t stride = 1;
  for (std::size_t k = table.axes.size(); k-- > 0;) {
    stride_[k] = stride;
    stride *= table.axes[k].at.size();
  }
  if (table.scaling) divide();
}

/// What is divided by r is 0 at rest: it falls faster than r does.
void TableInterpolation::divide() {
  divided_ = table_->numbers;
  force_ = {index_of(divided_, "force_x"), index_of(divided_, "lateral_force")};
  for (std::size_t point = 0; point < table_->points(); ++point) {
    const std::vector<double> place = grid_place(*table_, point);
    const ScaledLoad at = load_at(*table_, place.data());
    const double radius = creep_radius(place[2] * table_->scaling->largest_size);
    for (TableNumber& number : divided_) {
      const double growth = growth_of(number.name, at.friction, at.load, radius);
      number.values[point] = growth > 0 ? number.values[point] / growth : 0;
    }
    if (force_[0] && force_[1]) turn(divided_[*force_[0]].values[point], divided_[*force_[1]].values[point], place[0]);
  }
}

TableInterpolation::Place TableInterpolation::linear(const std::vector<double>& at, double value, std::size_t stride) {
  const std::size_t k = below(at, value);
  const double share = (value - at[k]) / (at[k + 1] - at[k]);
  return {{k * stride, (k + 1) * stride}, {1 - share, share}, 2};
}

TableInterpolation::Place TableInterpolation::cubic(const std::vector<double>& at, double value, std::size_t stride) {
  const LagrangeStencil stencil = lagrange_stencil(at.data(), static_cast<int>(at.size()), value);
  Place out{{}, stencil.weight, 4};
  for (std::size_t i = 0; i < 4; ++i) out.index[i] = (static_cast<std::size_t>(stencil.first) + i) * stride;
  return out;
}

/// The same on an axis of a whole turn at equal steps, whose first value is -pi.
TableInterpolation::Place TableInterpolation::around(const std::vector<double>& at, double value, std::size_t stride) {
  const std::size_t n = at.size();
  const double steps = (value / kTurn + 0.5) * static_cast<double>(n), k = std::floor(steps);
  constexpr double kPoints[]{-1, 0, 1, 2};
  Place out{{}, lagrange_stencil(kPoints, 4, steps - k).weight, 4};
  for (std::size_t i = 0; i < 4; ++i) out.index[i] = (static_cast<std::size_t>(k) + n + i - 1) % n * stride;
  return out;
}

template <class Numbers>
void TableInterpolation::add_corners(const Numbers& numbers, const Places& places, std::size_t axis, std::size_t index,
                                     double weight, double* out) const {
  if (axis == stride_.size()) {
    for (std::size_t n = 0; n < numbers.size(); ++n) out[n] += weight * numbers[n].values[index];
    return;
  }
  const Place& place = places[axis];
  for (std::size_t c = 0; c < place.corners; ++c)
    if (place.weight[c] != 0)
      add_corners(numbers, places, axis + 1, index + place.index[c], weight * place.weight[c], out);
}

void TableInterpolation::scaled(const double* point, Places& places, double* out) const {
  const TableScaling& scaling = *table_->scaling;
  CreepStiffness stiffness{};
  add_corners(scaling.stiffness, places, kScaledAxes, 0, 1, stiffness.data());
  const ScaledLoad at = load_at(*table_, point);
  const ScaledPlace place = scaled_place({point[0], point[1], point[2]}, creep_units(stiffness, at.load, at.friction));
  if (!std::isfinite(place.size)) return void(std::fill_n(out, divided_.size(), NAN));
  const std::vector<TableAxis>& axes = table_->axes;
  const double size = std::min(place.size, scaling.largest_size);
  places[0] = around(axes[0].at, place.angle, stride_[0]);
  places[1] = cubic(axes[1].at, place.spin_angle, stride_[1]);
  places[2] = cubic(axes[2].at, size / scaling.largest_size, stride_[2]);
  add_corners(divided_, places, 0, 0, 1, out);
  if (force_[0] && force_[1]) turn(out[*force_[0]], out[*force_[1]], -place.angle);
  for (std::size_t n = 0; n < divided_.size(); ++n)
    out[n] *= growth_of(divided_[n].name, at.friction, at.load, creep_radius(size));
}

int TableInterpolation::at(const double* point, double* out) const {
  constexpr double kRoundOff = 1e-9;  // of an axis
  std::array<double, kMostAxes> inside{};
  Places places;
  int beyond = 0;
  for (std::size_t k = 0; k < table_->axes.size(); ++k) {
    const std::vector<double>& at = table_->asked(k).at;
    inside[k] = std::clamp(point[k], at.front(), at.back());
    beyond += std::abs(inside[k] - point[k]) > kRoundOff * (at.back() - at.front());
    if (!table_->scaling || k >= kScaledAxes) places[k] = linear(at, inside[k], stride_[k]);
  }
  std::fill_n(out, table_->numbers.size(), 0.0);
  if (table_->scaling)
    scaled(inside.data(), places, out);
  else
    add_corners(table_->numbers, places, 0, 0, 1, out);
  return beyond;
}

}  // namespace railstrata
