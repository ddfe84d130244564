#include "rules/feature_keys.hpp"

#include <array>

#include "spec/case_spec.hpp"

namespace railstrata {

Keys keys_of_layers(const CaseSpec& c, const char* key, bool (*has)(const LayerSpec&)) {
  Keys out;
  for (std::size_t i = 0; i < c.layers.size(); ++i)
    if (has(c.layers[i])) out.push_back("layer." + std::to_string(i) + "." + key);
  return out;
}

Keys given_in_layers(const CaseSpec& c, const CaseSource* text, std::initializer_list<const char*> keys) {
  Keys out;
  for (const char* key : keys)
    for (const std::string& all : keys_of_layers(c, key, [](const LayerSpec&) { return true; }))
      if (text && text->has(all)) out.push_back(all);
  return out;
}

Keys keys_of_sleepers(const CaseSpec& c, const CaseSource*) {
  if (c.track.held()) return {};
  constexpr std::array<const char*, 4> kWords{"held", "delft", "medium", "cn60"};
  const SleeperTrack &own = c.track.support, &set = *named_track(kWords[static_cast<std::size_t>(c.track.preset)]);
  Keys out;
  const auto add = [&](const char* key, auto SleeperTrack::*member) {
    if (own.*member != set.*member) out.emplace_back(key);
  };
  add("track.phase", &SleeperTrack::phase);
  add("track.pad_damping", &SleeperTrack::pad_damping);
  add("track.pad_length", &SleeperTrack::pad_length);
  add("track.sleeper_mass", &SleeperTrack::sleeper_mass);
  add("track.ballast_damping", &SleeperTrack::ballast_damping);
  add("track.bays", &SleeperTrack::bays);
  return out;
}

}  // namespace railstrata
