#pragma once
// The wear loop (study/wear_loop.hpp) as a job: a folder with a row a step in wear_loop.csv, what every load did in
// wear_loads.csv, the worn rail and its damage in step_0001, step_0002 and so on, and report.html.
#include <vector>

#include "jobs/job.hpp"
#include "study/wear_loop.hpp"
#include "study/wear_loop_page.hpp"

namespace railstrata {

struct WearLoopOrder : JobOrder {
  int steps = 0;               ///< end after so many; 0: no limit
  double passages = 0;         ///< of the whole collective; 0: no limit
  double max_wear = 0.005e-3;  ///< m, at the deepest place in one step
  double cell = 0.25e-3;       ///< m
};

/// A step as a row of wear_loop.csv, in its units.
struct WearLoopRow {
  double step = 0, passages = 0;  ///< with this step
  double deepest = 0;             ///< um, of this step
  double area = 0;                ///< mm², worn off with this step
  double area_error = 0;          ///< of this step's area against that of its streamlines
  double gauge = 0;               ///< mm, on the rail before the step; so the following
  double pressure = 0;            ///< MPa, largest of all loads
  double t_gamma = 0;             ///< N, likewise
  double first_y = 0;             ///< mm, where the first load touches, from the rail's axis
};

class WearLoopJob : public CaseJob {
 public:
  /// Throws CaseError: the case has no collective, its profiles are faulty.
  WearLoopJob(LoadedCase loaded, WearLoopOrder order, Control& control);
  const WornRail& rail() const { return rail_; }

 private:
  void begin() override;
  void resume() override;
  bool finished() const override;
  bool step() override;
  void finish() override;
  bool write_page() override;
  std::vector<std::string> older_results() const override;
  void stop() override;
  std::string how_far() const override;

  std::filesystem::path step_folder(double step) const;
  void remove_older_steps() const;
  void keep(WearStep step);
  void warn_of_jump() const;

  const WearLoopOrder wanted_;
  Placement original_;
  InfluenceCache cache_;
  WearStepOptions options_;
  WornRail rail_;
  std::vector<WearLoopRow> rows_;
  std::vector<WearLoad> loads_;
};

}  // namespace railstrata
