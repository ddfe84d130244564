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
    if (count(k) < 4 || own[k].name != table.axes[k].name ||
        !std::equal(own[k].at.begin(), own[k].at.end(), table.axes[k].at.begin(), same))
      throw CaseError(fmt::format("the axis {} of a scaled table does not have its fixed values", own[k].name), remedy);
    check_axis(scaling.asked[k]);
    others /= table.axes[k].at.size();
  }
  for (const TableNumber& k : scaling.stiffness) check_number(k, others);
  const bool load = index_of(table.axes, "load") || scaling.load > 0,
             friction = index_of(table.axes, "friction") || scaling.friction > 0;
  if (!load || !friction || !(scaling.largest_size > 0 && scaling.largest_size < 1) ||
      !(scaling.spin_low < scaling.spin_high))
    throw CaseError("a scaled table needs load, friction, largest size and the ends of its spin", remedy);
}

/// A stiffness at a point of the axes after the third.
CreepStiffness stiffness_at(const TableScaling& scaling, std::size_t outer) {
  return {scaling.stiffness[0].values[outer], scaling.stiffness[1].values[outer], scaling.stiffness[2].values[outer]};
}

/// The place of a point of the first three axes.
ScaledPlace place_of(const TableScaling& scaling, const std::vector<double>& point) {
  return {point[0], scaling.spin_low + point[1] * (scaling.spin_high - scaling.spin_low),
          point[2] * scaling.largest_size};
}

/// Of the sum of waves through `count` even points around a turn: the weight of the one that is an angle away.
double weight_around(double away, std::size_t count) {
  const auto n = static_cast<double>(count);
  const double half = 0.5 * away;
  return std::sin(n * half) / (n * (count % 2 == 0 ? std::tan(half) : std::sin(half)));
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
  std::vector<TableAxis> out{{"creepage_angle", "", {}}, {"spin_share", "", {}}, {"creepage_size", "", {}}};
  for (int k = 0; k < angles; ++k) out[0].at.push_back(kTurn * (static_cast<double>(k) / angles - 0.5));
  for (int k = 0; k < spins; ++k) out[1].at.push_back(static_cast<double>(k) / (spins - 1));
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
      place_of(scaling, out),
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
  normal_ = index_of(divided_, "normal_force");
  bound_ = index_of(divided_, "bound");
  for (std::size_t point = 0; point < table_->points(); ++point) {
    const std::vector<double> place = grid_place(*table_, point);
    const ScaledLoad at = load_at(*table_, place.data());
    const double radius = creep_radius(place_of(*table_->scaling, place));
    for (TableNumber& number : divided_) {
      const double growth = growth_of(number.name, at.friction, at.load, radius);
      number.values[point] = growth > 0 ? number.values[point] / growth : 0;
    }
    if (force_[0] && force_[1]) turn(divided_[*force_[0]].values[point], divided_[*force_[1]].values[point], place[0]);
  }
  refine_angles();
}

/// Puts points of the waves between those of the table, so near that cubics do for them.
void TableInterpolation::refine_angles() {
  constexpr std::size_t kFiner = 4, kMany = 64;  // angles that are fine already
  const std::size_t count = table_->axes[0].at.size(), plane = stride_[0], finer = count < kMany ? kFiner : 1;
  angles_ = finer * count;
  for (TableNumber& number : divided_) {
    std::vector<double> fine(angles_ * plane, 0.0);
    for (std::size_t i = 0; i < angles_; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        const double steps = static_cast<double>(i) / static_cast<double>(finer) - static_cast<double>(j);
        if (i % finer == 0 && i != finer * j) continue;
        const double weight = i == finer * j ? 1.0 : weight_around(kTurn * steps / static_cast<double>(count), count);
        for (std::size_t k = 0; k < plane; ++k) fine[i * plane + k] += weight * number.values[j * plane + k];
      }
    number.values = std::move(fine);
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

/// The same around the turn, whose first angle is -pi.
TableInterpolation::Place TableInterpolation::around(double value) const {
  const double steps = (value / kTurn + 0.5) * static_cast<double>(angles_), k = std::floor(steps);
  constexpr double kPoints[]{-1, 0, 1, 2};
  Place out{{}, lagrange_stencil(kPoints, 4, steps - k).weight, 4};
  for (std::size_t i = 0; i < 4; ++i)
    out.index[i] = (static_cast<std::size_t>(k) + angles_ + i - 1) % angles_ * stride_[0];
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
  ScaledPlace place = scaled_place({point[0], point[1], point[2]}, creep_units(stiffness, at.load, at.friction));
  if (!std::isfinite(place.size + place.spin)) return void(std::fill_n(out, divided_.size(), NAN));
  place.size = std::min(place.size, scaling.largest_size);
  place.spin = std::clamp(place.spin, scaling.spin_low, scaling.spin_high);
  const std::vector<TableAxis>& axes = table_->axes;
  places[0] = around(place.angle);
  places[1] = cubic(axes[1].at, (place.spin - scaling.spin_low) / (scaling.spin_high - scaling.spin_low), stride_[1]);
  places[2] = cubic(axes[2].at, place.size / scaling.largest_size, stride_[2]);
  add_corners(divided_, places, 0, 0, 1, out);
  if (force_[0] && force_[1]) turn(out[*force_[0]], out[*force_[1]], -place.angle);
  for (std::size_t n = 0; n < divided_.size(); ++n)
    out[n] *= growth_of(divided_[n].name, at.friction, at.load, creep_radius(place));
  if (force_[0] && force_[1] && normal_ && bound_)  // not smooth where the forces are zero
    out[*bound_] = std::hypot(out[*force_[0]], out[*force_[1]]) / (at.friction * out[*normal_]);
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
