#include "rules/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "spec/case_spec.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

std::string key_of(std::size_t index, const char* key) { return fmt::format("layer.{}.{}", index, key); }

std::string way_text(double value) { return format_quantity(value, dimension::kLength); }

/// One message for each name, at the second layer that has it.
void check_name(const CaseSpec& spec, std::size_t i, CaseSource& source) {
  const auto same = [&](const LayerSpec& other) {
    return other.name == spec.layers[i].name && other.on == spec.layers[i].on;
  };
  const auto begin = spec.layers.begin(), here = begin + static_cast<std::ptrdiff_t>(i);
  if (std::count_if(begin, here, same) != 1) return;
  const auto others = std::count_if(begin, spec.layers.end(), same) - 1;
  source.complain(key_of(i, "name"),
                  fmt::format("layer.{}.name = \"{}\": {} of the {} {} this name", i, spec.layers[i].name,
                              others == 1 ? "another layer" : fmt::format("{} other layers", others),
                              body_word(spec.layers[i].on), others == 1 ? "has" : "have"),
                  "give every layer a name of its own");
}

/// Where a layer begins and ends along the rail.
void check_ends(const CaseSpec& spec, std::size_t i, CaseSource& source) {
  const LayerSpec& layer = spec.layers[i];
  const std::string from = key_of(i, "from"), to = key_of(i, "to"), taper = key_of(i, "taper_length");
  if (!source.sound({from, to, taper})) return;
  if (!layer.ends()) {
    if (layer.taper_length > 0)
      source.complain(taper, fmt::format("{} needs from or to: an endless layer has no ends", taper),
                      "say where the layer begins or ends, or take it out");
    return;
  }
  if (!(layer.begin() < layer.end()))
    return source.complain(
        to, fmt::format("{} = {}: must be beyond from = {}", to, way_text(*layer.to), way_text(*layer.from)),
        "exchange the two");
  const int ends = layer.from && layer.to ? 2 : 1;
  if (ends * layer.taper_length > layer.end() - layer.begin())
    source.complain(taper,
                    fmt::format("{} = {}: two of them are longer than the layer, {}", taper,
                                way_text(layer.taper_length), way_text(layer.end() - layer.begin())),
                    "it lies within from and to: make it shorter");
  if (layer.on == BodyId::wheel && ends < 2)
    source.complain(layer.from ? from : to,
                    fmt::format("{} on a wheel needs {}", layer.from ? from : to, layer.from ? "to" : "from"),
                    "a wheel is round: give both ends of the layer");
}

/// Stretches where the layer has come off: of the rail, where the layer is as thick as it is.
void check_unbonded(const CaseSpec& spec, std::size_t i, CaseSource& source) {
  const LayerSpec& layer = spec.layers[i];
  const std::string key = key_of(i, "unbonded");
  if (layer.unbonded.empty() || !source.sound({key, key_of(i, "from"), key_of(i, "to")})) return;
  if (layer.on == BodyId::wheel)
    return source.complain(key, fmt::format("{} is of layers of the rail: this one is on the wheel", key),
                           "take it out, or give on = \"rail\"");
  const double begin = layer.begin() + layer.taper_length, end = layer.end() - layer.taper_length;
  for (std::size_t k = 0; k < layer.unbonded.size(); ++k)
    if (layer.unbonded[k].from < begin || layer.unbonded[k].to > end)
      return source.complain(fmt::format("{}.{}", key, k),
                             fmt::format("{} reaches from {} to {}: the layer is not there, or tapers", key,
                                         way_text(layer.unbonded[k].from), way_text(layer.unbonded[k].to)),
                             "let it lie between from and to of the layer, without the taper_length at these ends");
}

/// Springs so soft that they hold nothing within the length of a rail.
void check_interface(const CaseSpec& spec, std::size_t i, CaseSource& source) {
  const std::string key = key_of(i, "interface_shear_stiffness");
  const double stiffness = spec.layers[i].interface_shear_stiffness.value_or(0);
  if (stiffness > 0 && stiffness < kSoftestInterface && source.sound({key}))
    source.complain(
        key,
        fmt::format("{} = {}: must be 0 or at least {}", key, format_quantity(stiffness, dimension::kPressureGradient),
                    format_quantity(kSoftestInterface, dimension::kPressureGradient)),
        "give 0 for a smooth interface");
}

/// One interface slides, of the rail.
void check_sliding(const CaseSpec& spec, CaseSource& source) {
  bool one = false;
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const LayerSpec& layer = spec.layers[i];
    if (!layer.slides()) continue;
    const std::string key = key_of(i, layer.interface_shear_limit ? "interface_shear_limit" : "interface_friction");
    if (layer.on == BodyId::wheel)
      source.complain(key, fmt::format("{} is of layers of the rail: this one is on the wheel", key),
                      "take it out, or give on = \"rail\"");
    else if (std::exchange(one, true))
      source.complain(key, fmt::format("{}: one interface of the rail may have a shear limit", key),
                      "take out those of the others");
  }
}

/// Layers of a body of which any ends are meshed as one stack.
void check_widths(const CaseSpec& spec, BodyId body, CaseSource& source) {
  std::vector<std::size_t> on;
  for (std::size_t i = 0; i < spec.layers.size(); ++i)
    if (spec.layers[i].on == body) on.push_back(i);
  if (std::none_of(on.begin(), on.end(), [&](std::size_t i) { return spec.layers[i].ends(); })) return;
  const double width = spec.layers[on.front()].width;
  for (const std::size_t i : on)
    if (const std::string key = key_of(i, "width"); spec.layers[i].width != width && source.sound({key}))
      return source.complain(
          key,
          fmt::format("{} = {}: must be that of layer.{}, {}: layers that begin and end along "
                      "the {} have one width with the others on it",
                      key, way_text(spec.layers[i].width), on.front(), way_text(width), body_word(body)),
          "give all of them one width");
}

/// Beside a layer that varies across the others of its body are the same all along.
void check_varying(const CaseSpec& spec, std::size_t i, CaseSource& source) {
  const LayerSpec& layer = spec.layers[i];
  for (std::size_t k = 0; layer.varies_across() && k < spec.layers.size(); ++k)
    if (k != i && spec.layers[k].on == layer.on && spec.layers[k].changes_along())
      return source.complain(key_of(i, "thickness_table"),
                             fmt::format("{}: layer.{} changes along the {}; both at once are not meshed",
                                         key_of(i, "thickness_table"), k, body_word(layer.on)),
                             "give layer.thickness, or layers that are the same all along");
}

void check_stretch(const StretchSpec& stretch, std::size_t i, CaseSource& source) {
  const std::string key = fmt::format("stretch.{}.along", i);
  if (source.sound({key}) && stretch.along.empty())
    source.complain(key, fmt::format("{} is missing: a stretch needs places and factors", key),
                    R"(write along = [["190 mm", 1.0, 1.0], ["195 mm", 1.0, 0.75], ["200 mm", 1.0, 1.0]])");
}

}  // namespace

void check_layers(const CaseSpec& spec, CaseSource& source) {
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    check_name(spec, i, source);
    check_ends(spec, i, source);
    check_unbonded(spec, i, source);
    check_interface(spec, i, source);
    check_varying(spec, i, source);
  }
  check_sliding(spec, source);
  for (const BodyId body : kBodies) check_widths(spec, body, source);
  for (std::size_t i = 0; i < spec.stretches.size(); ++i) check_stretch(spec.stretches[i], i, source);
}

}  // namespace railstrata
