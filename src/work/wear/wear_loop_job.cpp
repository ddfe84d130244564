#include "wear/wear_loop_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collective/collective_files.hpp"
#include "geometry/profile_texts.hpp"
#include "record/output_file.hpp"
#include "tables/load_rows.hpp"
#include "wear/wear_loop_page.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
/// A step as a row of wear_loop.csv, in its units.
struct WearLoopRow {
  double step = 0, passages = 0;  ///< with this step
  double deepest = 0;             ///< of this step
  double area = 0;                ///< worn off with this step
  double area_error = 0;          ///< of this step's area against that of its streamlines
  double gauge = 0;               ///< on the rail before the step; so the following
  double pressure = 0;            ///< largest of all loads
  double t_gamma = 0;             ///< likewise
  double layer_left = 0;          ///< least of the rail's uppermost layer after the step; NaN without one
  double layer_y = 0;             ///< there, from the rail's axis
  double traffic = 0;             ///< kg gross, with this step
  double first_y = 0;             ///< where the first load touches, from the rail's axis
};
using R = WearLoopRow;

constexpr JobKind kWearLoop{"wear loop", "wear_loop.id", "the case and the --set of its beginning"};
constexpr const char *kWearTable = "wear_loop.csv", *kWearLoads = "wear_loads.csv", *kUnworn = "unworn.csv",
                     *kWearPage = "report.html", *kProfile = "rail_profile.csv";
constexpr const char* kStepFiles[] = {kProfile, "rail_profile.prr", "rail_profile.ban", "collective.csv",
                                      "rail_damage.csv"};
const StateColumns<R> kColumns{{"step", &R::step},
                               {"passages", &R::passages},
                               {"deepest_of_step", &R::deepest, unit::kMicrometres},
                               {"worn_area", &R::area, unit::kSquareMillimetres},
                               {"area_error", &R::area_error},
                               {"gauge", &R::gauge, unit::kMillimetres},
                               {"p_max", &R::pressure, unit::kMPa},
                               {"t_gamma_max", &R::t_gamma, unit::kNewtons},
                               {"layer_left", &R::layer_left, unit::kMicrometres},
                               {"layer_left_y", &R::layer_y, unit::kMillimetres},
                               {"traffic", &R::traffic, unit::kMGT},
                               {"rail_y_first", &R::first_y, unit::kMillimetres}};

WearLoopRow row_of(const WearStep& step, double area_before, double traffic_before) {
  double pressure = 0, t_gamma = 0;
  for (const CollectiveRow& row : step.rows) {
    pressure = std::max(pressure, row.summary.contact.patch.p_max);
    t_gamma = std::max(t_gamma, row.summary.damage.t_gamma);
  }
  const CollectiveRow& first = step.rows.front();
  return in_table(kColumns, {.step = static_cast<double>(step.rail.step),
                             .passages = step.rail.passages,
                             .deepest = step.deepest,
                             .area = step.rail.area,
                             .area_error = (step.rail.area - area_before) / step.wanted_area - 1,
                             .gauge = step.gauge,
                             .pressure = pressure,
                             .t_gamma = t_gamma,
                             .layer_left = step.layer_left,
                             .layer_y = step.layer_y,
                             .traffic = traffic_before + 1e3 * step.tonnes,
                             .first_y = model_to_rail(first.track, first.patches.front().contact.point).y});
}

/// The worn rail for other programs.
void write_exchange_profiles(const fs::path& folder, const std::string& title, const WornRail& rail) {
  const std::string remark = fmt::format("{}, {:.6g} passages", title, rail.passages);
  write_whole_file(folder / "rail_profile.prr", simpack_text(ProfileKind::rail, rail.points, remark));
  write_whole_file(folder / "rail_profile.ban", miniprof_text(ProfileKind::rail, rail.points, remark));
}

class WearLoopJob : public CaseJob {
 public:
  WearLoopJob(LoadedCase loaded, WearLoopOrder order, Control& control)
      : CaseJob(kWearLoop, std::move(loaded), order, control),
        wanted_(std::move(order)),
        original_(place(loaded_.spec, loaded_.folder())) {
    options_.collective.bem.cell = wanted_.cell;
    options_.collective.bem.cache = &cache_;
    options_.collective.wanted = kContactAlone;
    options_.collective.control = &control;
    options_.max_wear = wanted_.max_wear;
    rail_ = unworn(original_, wanted_.cell);
    plan_collective(loaded_.spec);
    if (loaded_.spec.life.grinding.every) control.warn("[grinding] is ignored: the wear loop does not grind the rail");
  }
  const WornRail& rail() const { return rail_; }

 private:
  fs::path step_folder(double step) const { return folder() / fmt::format("step_{:04}", static_cast<int>(step)); }

  /// Nothing of an older loop stands beside the steps of this one.
  void remove_older_steps() const {
    std::error_code ignored;
    for (int step = 1; fs::is_directory(step_folder(step), ignored); ++step) {
      for (const char* name : kStepFiles) fs::remove(step_folder(step) / name, ignored);
      if (fs::is_empty(step_folder(step), ignored)) fs::remove(step_folder(step), ignored);
    }
  }

  std::vector<std::string> older_results() const override { return {kWearPage, kWearLoads}; }

  void begin() override {
    remove_older_steps();
    CaseJob::begin();
    write_profile_table(folder() / kUnworn, origin(), rail_.points);
    write_rows(folder() / kWearTable, origin(), kColumns, rows_);
  }

  void resume() override {
    rows_ = read_rows(folder() / kWearTable, kColumns);
    if (rows_.empty()) return;
    const WearLoopRow last = in_si(kColumns, rows_.back());
    rail_ = {static_cast<int>(last.step), last.passages, last.area, {}, step_folder(last.step) / kProfile};
    rail_.points = read_profile_table(rail_.file);
    if (fs::exists(folder() / kWearLoads)) loads_ = read_rows(folder() / kWearLoads, wear_load_columns());
    std::erase_if(loads_, [&](const WearLoad& load) { return load.step > last.step; });  // a kill came before their row
  }

  bool worn_through() const { return !rows_.empty() && rows_.back().layer_left <= 0; }

  bool finished() const override {
    return worn_through() || (wanted_.steps > 0 && rail_.step >= wanted_.steps) ||
           (wanted_.passages > 0 && rail_.passages >= wanted_.passages * (1 - 1e-12));
  }

  bool step() override {
    options_.passages_left = wanted_.passages > 0 ? wanted_.passages - rail_.passages : 0;
    WearStep step = wear_step(loaded_.spec, loaded_.folder(), original_, rail_, options_);
    control_.progress("");
    if (step.stopped) return false;
    keep(std::move(step));
    return true;
  }

  /// The table last: a step counts once its row is there.
  void keep(WearStep step) {
    const fs::path in = step_folder(step.rail.step);
    make_folder(in);
    step.rail.file = in / kProfile;
    write_profile_table(step.rail.file, origin(), step.rail.points);
    write_exchange_profiles(in, loaded_.spec.title, step.rail);
    write_collective_table(in / "collective.csv", origin(), step.rows);
    write_rail_damage(in / "rail_damage.csv", origin(), step.damage);
    for (const WearLoad& load : wear_loads(step, rail_.passages)) loads_.push_back(load);
    write_rows(folder() / kWearLoads, origin(), wear_load_columns(), loads_);
    rows_.push_back(row_of(step, rail_.area, rows_.empty() ? 0 : rows_.back().traffic / unit::kMGT.factor));
    write_rows(folder() / kWearTable, origin(), kColumns, rows_);
    warn_of_jump();
    const WearLoopRow& row = rows_.back();
    control_.info("step {}: {:.4g} passages, deepest {:.3g} µm, {:.4g} mm² in all, p_max {:.0f} MPa", row.step,
                  row.passages, row.deepest, row.area, row.pressure);
    rail_ = std::move(step.rail);
    rail_.points = read_profile_table(rail_.file);  // as resume() has them
  }

  /// A jump of the contact shows a step that is too long: wear of that depth moves it further than it can follow.
  void warn_of_jump() const {
    constexpr double kJump = 0.2;
    if (rows_.size() < 2) return;
    const double before = rows_[rows_.size() - 2].pressure, now = rows_.back().pressure;
    if (std::abs(now / before - 1) > kJump)
      control_.warn(
          "step {}: the largest pressure jumped from {:.0f} to {:.0f} MPa: the steps are too long and later profiles "
          "are not reliable; start again with a smaller --max-wear",
          rows_.back().step, before, now);
  }

  void finish() override {
    if (worn_through())
      control_.warn(
          "the rail's uppermost layer is worn through at y = {:.1f} mm after {:.6g} passages, {:.4g} MGT; the loop "
          "ends here",
          rows_.back().layer_y, rail_.passages, rows_.back().traffic);
    control_.info("{:.6g} passages in {} steps, {:.4g} mm² worn off; the worn rail: {}", rail_.passages, rail_.step,
                  unit::kSquareMillimetres.factor * rail_.area, rail_.file.string());
  }

  bool write_page() override {
    if (rows_.empty()) return true;
    WearLoopHistory history;
    history.title = loaded_.spec.title;
    for (std::size_t i = 0; i < loaded_.spec.loads.size(); ++i) history.loads.push_back(load_name(loaded_.spec, i));
    history.unworn = read_profile_table(folder() / kUnworn);
    for (const WearLoopRow& row : rows_)
      history.profiles.push_back({static_cast<int>(row.step),
                                  row.passages,
                                  in_si(kColumns, row).area,
                                  read_profile_table(step_folder(row.step) / kProfile),
                                  {}});
    history.contacts = loads_;
    history.traffic = in_si(kColumns, rows_.back()).traffic;
    write_wear_loop_page(folder() / kWearPage, history);
    control_.info("everything on one page: {}", (folder() / kWearPage).string());
    return true;
  }

  void stop() override {
    if (order_.page) write_page();
  }

  std::string how_far() const override {
    return fmt::format("after step {}; what is done is in {}", rail_.step, folder().string());
  }

  const WearLoopOrder wanted_;
  Placement original_;
  InfluenceCache cache_;
  WearStepOptions options_;
  WornRail rail_;
  std::vector<WearLoopRow> rows_;
  std::vector<WearLoad> loads_;
};

}  // namespace

JobEnd carry_out_wear_loop(LoadedCase loaded, const WearLoopOrder& order, Control& control,
                           const std::function<void(const WornRail&)>& at_end) {
  WearLoopJob job(std::move(loaded), order, control);
  return job.carry_out([&] {
    if (at_end) at_end(job.rail());
  });
}

}  // namespace railstrata
