#include "device/contact_arrays.hpp"

#include <algorithm>
#include <cmath>

#include "fem/contact_step.hpp"

namespace railstrata::device {
namespace {

std::vector<double> of_each(const std::vector<double>& angles, double (*function)(double)) {
  std::vector<double> out;
  for (double t : angles) out.push_back(function(t));
  return out;
}

// Most stations that a length of them can cover.
int most_stations(const std::vector<double>& at, double length) {
  std::size_t most = 0, first = 0;
  for (std::size_t end = 0; end < at.size(); ++end) {
    while (at[end] - at[first] > length) ++first;
    most = std::max(most, end - first + 1);
  }
  return static_cast<int>(most);
}

double finest(const std::vector<double>& at) {
  double out = at[1] - at[0];
  for (std::size_t k = 2; k < at.size(); ++k) out = std::min(out, at[k] - at[k - 1]);
  return out;
}
double coarsest(const std::vector<double>& at) {
  double out = at[1] - at[0];
  for (std::size_t k = 2; k < at.size(); ++k) out = std::max(out, at[k] - at[k - 1]);
  return out;
}

std::vector<double> across(const ContactSurface& s) {
  std::vector<double> out;
  for (const Vec2 n : s.node) out.push_back(n.y);
  return out;
}

double smallest_radius(const ContactSurface& wheel) {
  double out = std::abs(wheel.node.front().z);
  for (const Vec2 n : wheel.node) out = std::min(out, std::abs(n.z));
  return out;
}

// Wheel nodes in a direction that the facets around a rail node can touch, and one more.
int nodes_across(double rail_facet, double wheel_facet) {
  return static_cast<int>(std::ceil(2 * mortar_law::kFarPoint * rail_facet / wheel_facet)) + 3;
}

// Largest distance of the rail's stations where a contact can be: near its finest.
double contact_facet(const std::vector<double>& at) { return 1.001 * finest(at); }

}  // namespace

SurfaceArrays::SurfaceArrays(Device& device, const ContactSurface& s)
    : origin_(s.origin),
      yaw_(s.yaw),
      columns_(s.columns),
      stride_(s.stride),
      first_line_(s.first_line),
      node_(on_device(device, s.node)),
      outward_(on_device(device, s.outward)),
      sagitta_(on_device(device, s.sagitta)),
      at_(on_device(device, s.stations.at)),
      width_(on_device(device, s.width)),
      sine_(on_device(device, of_each(s.stations.at, [](double t) { return std::sin(t); }))),
      cosine_(on_device(device, of_each(s.stations.at, [](double t) { return std::cos(t); }))) {}

SurfaceView SurfaceArrays::view() const {
  return {origin_,         yaw_,          columns_,     stride_,
          first_line_,     {at_.view()},  node_.view(), outward_.view(),
          sagitta_.view(), width_.view(), sine_.view(), cosine_.view()};
}

ContactArrays::ContactArrays(Device& device, const RollingSystem& sys, double dt)
    : rail_(device, sys.rail_surface()), wheel_(device, sys.wheel_surface()) {
  const ContactSurface &rail = sys.rail_surface(), &wheel = sys.wheel_surface();
  const SearchWindow search = search_window(sys);
  const EnforcementOptions& o = sys.options.contact;
  ContactTables& t = tables_;
  t.rail = rail_.view();
  t.wheel = wheel_.view();
  t.enforcement.law = row_law(o, dt);
  t.enforcement.max_sweeps = o.max_sweeps;
  t.enforcement.tolerance = o.tolerance;
  t.search.half_length = search.half_length;
  t.search.gap = search.gap;
  t.inner = rail.columns - 2;
  t.apart = mortar_law::independent_distance(rail, wheel);
  const double radius = smallest_radius(wheel);
  t.search.reach = 1.05 * search.half_length / radius;
  t.window = most_stations(rail.stations.at, 2 * search.half_length) + 1;
  constexpr int kMore = 8;  // stations beyond the reach, to both sides
  t.band = std::min(static_cast<int>(std::ceil(2 * t.search.reach / finest(wheel.stations.at))) + kMore,
                    wheel.stations.nodes());
  t.patch = nodes_across(coarsest(across(rail)), finest(across(wheel))) *
            nodes_across(contact_facet(rail.stations.at), radius * finest(wheel.stations.at));

  const auto nodes = static_cast<std::size_t>(rail.columns) * static_cast<std::size_t>(rail.stations.nodes());
  const auto slots = static_cast<std::size_t>(t.slots()), band = static_cast<std::size_t>(band_nodes());
  const auto make = [&](auto& array, auto& view, std::size_t size) {
    array = {device, size};
    view = array.view();
  };
  make(tractions_, t.kept.tractions, nodes);
  make(corrections_, t.kept.corrections, 4 * nodes);
  make(active_, t.kept.active, nodes);
  make(near_, t.found.near, slots);
  make(edge_, t.found.at_edge, slots);
  make(hits_, t.hits, 4 * (static_cast<std::size_t>(t.window) + 1) * static_cast<std::size_t>(rail.columns));
  make(rows_, t.rows, slots);
  make(weights_, t.weights, slots * static_cast<std::size_t>(t.patch));
  make(starts_, t.starts, slots);
  make(slips_, t.slips, slots);
  make(changes_, t.changes, std::max(slots, std::size_t{kRowNumbers}));
  const auto make_nodes = [&](Nodes& nodes_of, auto& views, std::size_t size) {
    make(nodes_of.before, views.before, size);
    make(nodes_of.after, views.after, size);
    make(nodes_of.force, views.force, size);
    make(nodes_of.answer, views.answer, size);
  };
  make_nodes(rail_nodes_, t.rail_nodes, slots);
  make_nodes(wheel_nodes_, t.wheel_nodes, band);
  make(numbers_, t.totals.numbers, kRowNumbers * slots);
  make(parts_, t.totals.parts, std::size_t{kRowNumbers} * kRowParts);
}

void ContactArrays::load(const RestartState& state) {
  tractions_.upload(state.state.tractions.all());
  const std::size_t nodes = active_.size();
  std::vector<int> active(nodes, 0);
  std::vector<Tangential> corrections(4 * nodes);
  for (const MortarContact::Facet& f : state.facets) {
    const auto at = static_cast<std::size_t>(f.station) * static_cast<std::size_t>(tables_.rail.columns) +
                    static_cast<std::size_t>(f.column);
    active[at] = 1;
    std::copy(f.correction, f.correction + 4, corrections.begin() + static_cast<std::ptrdiff_t>(4 * at));
  }
  active_.upload(active);
  corrections_.upload(corrections);
}

void ContactArrays::store(RestartState& state) const {
  tractions_.download(state.state.tractions.all());
  const std::vector<int> active = active_.values();
  const std::vector<Tangential> corrections = corrections_.values();
  state.facets.clear();
  for (std::size_t at = 0; at < active.size(); ++at) {
    if (!active[at]) continue;
    const int columns = tables_.rail.columns, k = static_cast<int>(at);
    MortarContact::Facet f{k % columns, k / columns, {}};
    std::copy_n(corrections.begin() + static_cast<std::ptrdiff_t>(4 * at), 4, f.correction);
    state.facets.push_back(f);
  }
}

}  // namespace railstrata::device
