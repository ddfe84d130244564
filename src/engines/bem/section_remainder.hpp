#pragma once
// What the section of a body gives beyond the half-space of the same layers, at stations across its running surface.
#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <vector>

#include "bem/patch_grid.hpp"
#include "halfspace/layered.hpp"
#include "model/model.hpp"

namespace railstrata {

struct SectionRemainder {
  static constexpr double kSmoothTo = 500;  ///< 1/m, the largest wave number of a remainder that is smooth
  double radius = 0;                        ///< m, of a wheel where the stations are; 0: a rail
  bool in_full = false;  ///< a layer ends near the patch: stations as near as rows of cells, waves as short as cells
  std::vector<Vec2> stations;       ///< m, in the axes of the model; of a wheel relative to its axle
  std::vector<double> by_rotation;  ///< SectionCompliance::by_rotation
  std::vector<double> k;            ///< 1/m, wave numbers
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

/// One of the sections that are kept on both sides of a place, and its share there.
struct RemainderShare {
  std::shared_ptr<const SectionRemainder> remainder;
  double share = 1;
};

struct SectionSizes;

/// Remainders of sections that were asked for before. Safe to share between threads.
class SectionStore {
 public:
  /// Of the section with its foot or bore held, around the contact, at least as wide as the grid where the running
  /// surface is: a contact that wanders meets one kept section after the other, without jumps where layers do not end
  /// nearby. half_space: its layers. Throws CaseError where the section cannot be meshed.
  std::vector<RemainderShare> get(const CaseSpec& spec, const Placement& placement, BodyId body,
                                  const LayeredHalfSpace& half_space, const PatchGrid& grid);

 private:
  std::shared_ptr<const SectionRemainder> at(const CaseSpec& spec, const Placement& placement, BodyId body,
                                             const LayeredHalfSpace& half_space, const SectionSizes& sizes);
  struct Entry {
    std::vector<double> key;
    std::shared_ptr<const SectionRemainder> remainder;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;
};

}  // namespace railstrata
