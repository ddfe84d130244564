#include "bem/influence_cache.hpp"

#include <list>
#include <memory>
#include <mutex>
#include <utility>

namespace railstrata {

namespace {

bool same(const LayeredHalfSpace& a, const LayeredHalfSpace& b) {
  if (!(a.substrate == b.substrate) || a.layers.size() != b.layers.size()) return false;
  for (std::size_t i = 0; i < a.layers.size(); ++i)
    if (a.layers[i].thickness != b.layers[i].thickness || !(a.layers[i].material == b.layers[i].material)) return false;
  return true;
}

}  // namespace

struct InfluenceCache::State {
  struct Entry {
    LayeredHalfSpace wheel, rail;
    int nx, ny;
    double dx, dy, film;
    bool line;
    SurfaceCompliance pair;
    std::shared_ptr<const InfluenceOperator> op;
  };
  static constexpr std::size_t kEntries = 32;
  std::mutex mutex;
  std::list<Entry> entries;  // most recently used first
};

InfluenceCache::InfluenceCache() : state_(std::make_unique<State>()) {}
InfluenceCache::~InfluenceCache() = default;

std::shared_ptr<const InfluenceOperator> InfluenceCache::get(const LayeredHalfSpace& wheel,
                                                             const LayeredHalfSpace& rail, const PatchGrid& g,
                                                             double film) {
  SurfaceCompliance pair;
  {
    const std::lock_guard lock(state_->mutex);
    for (auto it = state_->entries.begin(); it != state_->entries.end(); ++it) {
      if (!same(it->wheel, wheel) || !same(it->rail, rail)) continue;
      pair = it->pair;
      if (it->nx != g.nx || it->ny != g.ny || it->dx != g.dx || it->dy != g.dy || it->film != film ||
          it->line != g.line)
        continue;
      state_->entries.splice(state_->entries.begin(), state_->entries, it);
      return it->op;
    }
  }
  if (pair.empty()) pair = combined_compliance(layered_compliance(wheel), layered_compliance(rail));
  auto op = std::make_shared<const InfluenceOperator>(pair, g.nx, g.ny, g.dx, g.dy, film, g.line);
  const std::lock_guard lock(state_->mutex);
  state_->entries.push_front({wheel, rail, g.nx, g.ny, g.dx, g.dy, film, g.line, std::move(pair), op});
  if (state_->entries.size() > State::kEntries) state_->entries.pop_back();
  return op;
}

}  // namespace railstrata
