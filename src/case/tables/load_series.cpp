#include "tables/load_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "core/text.hpp"

namespace railstrata {
namespace {

struct Axis {
  std::optional<double> LoadSpec::*member;
  double width;
  bool inverse = false;  ///< bins of 1/value
};
const std::array kAxes{Axis{&LoadSpec::wheel_load, 10e3},
                       Axis{&LoadSpec::lateral_shift, 1e-3},
                       Axis{&LoadSpec::yaw, 1e-3},
                       Axis{&LoadSpec::curve_radius, 1e-3, true},
                       Axis{&LoadSpec::speed, 5},
                       Axis{&LoadSpec::friction_coefficient, 0.02},
                       Axis{&LoadSpec::traction_coefficient, 0.02},
                       Axis{&LoadSpec::lateral_traction_coefficient, 0.02},
                       Axis{&LoadSpec::creepage, 5e-4},
                       Axis{&LoadSpec::lateral_creepage, 5e-4}};
/// Means alone, which part no samples.
const std::array kMeans{&LoadSpec::roll, &LoadSpec::guiding_force, &LoadSpec::t_gamma, &LoadSpec::friction_energy};
using Bin = std::pair<std::string, std::array<std::optional<long>, kAxes.size()>>;

double on_axis(const Axis& axis, double value) { return axis.inverse ? 1 / value : value; }

Bin bin_of(const LoadSpec& load, double scale, bool by_name) {
  Bin out{by_name ? load.name : "", {}};
  for (std::size_t k = 0; k < kAxes.size(); ++k)
    if (const auto& value = load.*kAxes[k].member)
      out.second[k] = std::lround(on_axis(kAxes[k], *value) / (scale * kAxes[k].width));
  return out;
}

bool few_names(const std::vector<LoadSpec>& samples) {
  constexpr std::size_t kMost = 40;
  std::set<std::string> names;
  for (const LoadSpec& sample : samples) {
    names.insert(sample.name);
    if (names.size() > kMost) return false;
  }
  return true;
}

/// "wagon, leading: 107 kN, 4.92 mm"
std::string bin_name(const std::string& samples, std::size_t place, const LoadSpec& mean) {
  std::string out = samples.empty() ? fmt::format("bin {}", place) : samples;
  const char* before = ": ";
  const auto add = [&](const std::optional<double>& value, double factor, const char* unit) {
    if (!value) return;
    out += fmt::format("{}{:.3g} {}", before, factor * *value, unit);
    before = ", ";
  };
  add(mean.wheel_load, 1e-3, "kN");
  add(mean.lateral_shift, 1e3, "mm");
  return out;
}

/// Adds a sample to the sums of its bin.
void add(const LoadSpec& sample, LoadSpec& sums) {
  sums.passages += sample.passages;
  for (const Axis& axis : kAxes)
    if (const auto& value = sample.*axis.member)
      sums.*axis.member = (sums.*axis.member).value_or(0) + sample.passages * on_axis(axis, *value);
  for (const auto member : kMeans)
    if (const auto& value = sample.*member) sums.*member = (sums.*member).value_or(0) + sample.passages * *value;
}

/// A curvature of zero is straight track: no radius.
LoadSpec mean_of(LoadSpec sums) {
  for (const Axis& axis : kAxes)
    if (auto& value = sums.*axis.member) {
      *value /= sums.passages;
      if (axis.inverse && !(std::abs(*value) > 1e-6)) value.reset();
      if (value && axis.inverse) *value = 1 / *value;
    }
  for (const auto member : kMeans)
    if (auto& value = sums.*member) *value /= sums.passages;
  return sums;
}

}  // namespace

bool names_way(std::string_view column) {
  const std::array words{"time", "distance", "Zeit", "Weg"};
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return column.starts_with(word); });
}

bool names_series(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  std::istringstream lines{std::string(text.starts_with(kMark) ? text.substr(kMark.size()) : text)};
  std::string line;
  while (std::getline(lines, line) && trimmed(line.substr(0, line.find('#')), " \t\r").empty()) {
  }
  std::istringstream cells(line);
  for (std::string cell; std::getline(cells, cell, line.find(';') == std::string::npos ? ',' : ';');)
    if (names_way(trimmed(cell, " \t\r\""))) return true;
  return false;
}

std::vector<LoadSpec> binned(const std::vector<LoadSpec>& samples, double scale) {
  const bool by_name = few_names(samples);
  std::map<Bin, LoadSpec> bins;
  for (const LoadSpec& sample : samples) {
    const Bin bin = bin_of(sample, scale, by_name);
    LoadSpec empty;
    empty.name = bin.first;
    empty.passages = 0;
    add(sample, bins.try_emplace(bin, empty).first->second);
  }
  std::vector<LoadSpec> out;
  for (const auto& [bin, sums] : bins) out.push_back(mean_of(sums));
  std::stable_sort(out.begin(), out.end(),
                   [](const LoadSpec& a, const LoadSpec& b) { return a.passages > b.passages; });
  for (std::size_t i = 0; i < out.size(); ++i) out[i].name = bin_name(out[i].name, i + 1, out[i]);
  return out;
}

}  // namespace railstrata
