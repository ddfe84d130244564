#include <array>
#include <cmath>
#include <memory>

#include "ask/answer.hpp"
#include "bridge/records.hpp"
#include "clock/wheel_life.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "core/stop_request.hpp"
#include "io/output_folder.hpp"
#include "io/summary_json.hpp"
#include "model/model.hpp"
#include "runs/write_half_space_result.hpp"
#include "runs/write_transient.hpp"

namespace railstrata::bridge {
namespace {

/// A solution with what its stresses and files need.
struct HalfSpaceRun {
  LoadedCase loaded;
  Placement placement;
  Answer answer;
  const BemPatch& patch(std::size_t index) const {
    return index == 0 ? answer.result : answer.result.further.at(index - 1);
  }
};

void answer_half_space(Call& call) {
  const auto loaded = call.made<LoadedCase>("case");
  Wanted wanted = call.flag("stresses") ? Wanted{} : kContactAlone;
  wanted.other_fits = call.flag("stresses");
  wanted.maps = call.flag("maps");
  wanted.single_track = wanted.maps || call.flag("single_track");
  const auto run = std::make_shared<HalfSpaceRun>(HalfSpaceRun{*loaded, place(loaded->spec, loaded->folder()), {}});
  AskOptions how{.threads = call.whole("threads"), .control = &call.control};
  how.bem.cell = call.number("cell");
  how.life_of = life_of_wheels(loaded->folder(), &call.control);
  how.observer = [&](const TransientState& state) {
    call.report(Json::array({static_cast<double>(state.step) / state.steps}));
  };
  run->answer = with_places(*loaded, [&] { return ask(loaded->spec, run->placement, wanted, how); });
  if (run->answer.stopped) throw Interrupted("stopped");
  call.answer["summary"] = summary_json(run->answer.summary);
  std::vector<std::string> notes = run->placement.doubts;
  notes.insert(notes.end(), run->placement.notes.begin(), run->placement.notes.end());
  notes.insert(notes.end(), run->answer.result.notes.begin(), run->answer.result.notes.end());
  call.answer["notes"] = notes;
  call.answer["patches"] = Json::array({patch_of(run->patch(0).field)});
  for (const BemPatch& patch : run->answer.result.further) call.answer["patches"].push_back(patch_of(patch.field));
  call.make(run);
}

Subsurface interior(const HalfSpaceRun& run, const std::string& body, std::size_t patch) {
  if (body == "rail") return rail_interior(run.answer.result.rail, run.patch(patch));
  return wheel_interior(run.answer.result.wheel, run.patch(patch));
}

std::size_t patch_asked(const Call& call) { return static_cast<std::size_t>(call.whole("patch")); }

/// (n, 6) stresses at (n, 3) points.
void stresses_at(Call& call) {
  const auto run = call.made<HalfSpaceRun>("run");
  const StopRequest stop(&call.control.stop);
  const std::vector<InteriorPoint> found = interior(*run, call.text("body"), patch_asked(call))
                                               .at(points_of(call.array("points")), call.flag("below_interface"));
  std::vector<Sym3> out;
  for (const InteriorPoint& point : found) out.push_back(point.stress);
  answer_stresses(call, out);
}

/// (6, nx, ny) stresses in the cells of the patch's grid at a depth.
void stress_plane(Call& call) {
  const auto run = call.made<HalfSpaceRun>("run");
  const double depth = call.number("depth");
  const bool below_interface = call.flag("below_interface");
  if (!(depth >= 0 && std::isfinite(depth))) throw std::invalid_argument("depth: a length of 0 or more is wanted");
  const PatchGrid& grid = run->patch(patch_asked(call)).grid;
  std::vector<double> out(6 * grid.size());
  const Subsurface inside = interior(*run, call.text("body"), patch_asked(call));
  const StatePlane plane = inside.plane(depth);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const std::array<double, 6> numbers = components(inside.stress(plane, k, below_interface));
    for (std::size_t c = 0; c < 6; ++c) out[c * grid.size() + k] = numbers[c];
  }
  call.answer["stresses"] =
      call.kept(std::move(out), {6, static_cast<std::size_t>(grid.nx), static_cast<std::size_t>(grid.ny)});
}

void grid_axes(Call& call) {
  const auto run = call.made<HalfSpaceRun>("run");
  const PatchGrid& grid = run->patch(patch_asked(call)).grid;
  std::vector<double> x, y;
  for (int i = 0; i < grid.nx; ++i) x.push_back(grid.x(i));
  for (int j = 0; j < grid.ny; ++j) y.push_back(grid.y(j));
  call.answer["x"] = call.kept(std::move(x), {static_cast<std::size_t>(grid.nx)});
  call.answer["y"] = call.kept(std::move(y), {static_cast<std::size_t>(grid.ny)});
}

void write(Call& call) {
  const auto run = call.made<HalfSpaceRun>("run");
  const std::string folder = call.text("folder");
  require_apart(folder, run->loaded);
  const FolderHold hold = prepare_output_folder(folder, call.flag("force"));
  clear_old_results(folder);
  write_origin(folder, run->loaded, {"railstrata.bem (Python)"}, max_threads());
  write_half_space_result(folder, table_origin(run->loaded), run->loaded.spec, run->placement, run->answer);
}

}  // namespace

Functions half_space_functions() {
  return {{"solve_half_space", answer_half_space},
          {"stresses_at", stresses_at},
          {"stress_plane", stress_plane},
          {"grid", grid_axes},
          {"write_half_space", write}};
}

}  // namespace railstrata::bridge
