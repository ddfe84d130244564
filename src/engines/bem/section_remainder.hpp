#pragma once
// What the section of a body gives beyond the half-space of the same layers, at stations across its running surface.
#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <numeric>
#include <vector>

#include "bem/patch_grid.hpp"
#include "halfspace/layered.hpp"
#include "model/model.hpp"
#include "section/section_interior.hpp"

namespace railstrata {

struct SectionRemainder {
  static constexpr double kSmoothTo = 500;  ///< 1/m, the largest wave number of a remainder that is smooth
  double radius = 0;                        ///< m, of a wheel where the stations are; 0: a rail
  bool in_full = false;  ///< a layer ends near the patch: stations as near as rows of cells, waves as short as cells
  std::vector<Vec2> stations;       ///< m, in the axes of the model; of a wheel relative to its axle
  std::vector<double> by_rotation;  ///< SectionCompliance::by_rotation
  /// 1/N, of a rail on springs: stretch of the running surface along x under a vertical load, over that of a held foot.
  double stretch_by_load = 0;
  std::vector<double> k;  ///< 1/m, wave numbers
  /// Compliance of the section and, in the contact plane, of the half-space at each k. Index direction * stations +
  /// station.
  std::vector<Eigen::MatrixXd> own, half_space;

  /// Both at other wave numbers, less themselves at the largest k but for the coupling of x, which is odd in k.
  struct AtWaves {
    std::vector<double> k;
    std::vector<Eigen::MatrixXd> own, half_space;
  };
  std::shared_ptr<const AtWaves> at(const std::vector<double>& waves) const;  ///< kept from the first time on

 private:
  struct KeptWaves {
    std::mutex mutex;
    std::vector<std::shared_ptr<const AtWaves>> all;
  };
  std::shared_ptr<KeptWaves> kept_ = std::make_shared<KeptWaves>();
};

/// The contact plane in the axes of a body's section.
struct SectionPlane {
  Vec2 contact;                                                      ///< m, its origin, where the stations are given
  double angle = 0;                                                  ///< rad
  std::vector<double> along(const std::vector<Vec2>& points) const;  ///< m, places of points along it
};
SectionPlane section_plane(const CaseSpec& spec, const Placement& placement, BodyId body);

/// One of the sections that are kept on both sides of a place, and its share there.
struct RemainderShare {
  std::shared_ptr<const SectionRemainder> remainder;
  double share = 1;
};

/// One of the interiors that are kept on both sides of a place, and its share there.
struct InteriorShare {
  std::shared_ptr<const SectionInterior> difference;
  double share = 1;
};

inline std::size_t numbers_of(const SectionRemainder& of) { return 2 * of.k.size() * of.own.front().size(); }
inline std::size_t numbers_of(const SectionInterior& of) { return of.k.size() * of.at.front().size(); }

/// What was made before, by its key. Safe to share between threads.
template <class Made>
class KeptByKey {
 public:
  template <class Make>
  std::shared_ptr<const Made> get(const std::vector<double>& key, Make&& make) {
    constexpr std::size_t kEntries = 64, kNumbers = 64 << 20;  // 512 MiB
    const std::lock_guard lock(mutex_);
    for (const Entry& entry : entries_)
      if (entry.key == key) return entry.made;
    auto made = std::make_shared<const Made>(make());
    entries_.push_back({key, made});
    const auto add = [](std::size_t sum, const Entry& entry) { return sum + numbers_of(*entry.made); };
    while (entries_.size() > 1 && (entries_.size() > kEntries ||
                                   std::accumulate(entries_.begin(), entries_.end(), std::size_t{0}, add) > kNumbers))
      entries_.erase(entries_.begin());
    return made;
  }

 private:
  struct Entry {
    std::vector<double> key;
    std::shared_ptr<const Made> made;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;
};

/// Sections that were asked for before. Safe to share between threads.
class SectionStore {
 public:
  /// Of the section with its foot or bore held, around the contact, at least as wide as the grid where the running
  /// surface is: a contact that wanders meets one kept section after the other, without jumps where layers do not end
  /// nearby. half_space: its layers. Throws CaseError where the section cannot be meshed.
  std::vector<RemainderShare> get(const CaseSpec& spec, const Placement& placement, BodyId body,
                                  const LayeredHalfSpace& half_space, const PatchGrid& grid);
  /// The states below the surface, less those of a large block with the same layers.
  std::vector<InteriorShare> below(const CaseSpec& spec, const Placement& placement, BodyId body,
                                   const LayeredHalfSpace& half_space, const PatchGrid& grid);

 private:
  KeptByKey<SectionRemainder> remainders_;
  KeptByKey<SectionInterior> interiors_, blocks_;
};

}  // namespace railstrata
