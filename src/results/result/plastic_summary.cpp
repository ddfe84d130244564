#include "result/plastic_summary.hpp"

#include "model/section_axes.hpp"
#include "model/zone.hpp"

namespace railstrata {
namespace {

void add_place(const RollingSystem& sys, BodyId id, const PlasticPeak& peak, PlasticSummary& out) {
  const Model& model = sys.model;
  const SweptBody& body = sys.body(id).mesh;
  const Block& block = body.blocks[peak.block];
  const Section& section = block.section;
  const Vec2 centre = centre_of(section, peak.quad);
  const bool rail = id == BodyId::rail;
  const SectionAxes axes(model, id);
  out.y = centre.y - axes.point.y;
  out.depth = axes.depth(centre);
  if (const ContactBand& band = body.contact; band.block == peak.block) {
    const int row = peak.quad / band.columns;
    out.depth = 0.5 * (band.depth[row] + band.depth[row + 1]);
  }
  if (rail) out.x = 0.5 * (block.stations.at[peak.station] + block.stations.at[peak.station + 1]);
  out.body = body_word(id);
  out.zone = zone_name(model.spec, id, body.layer_of(block.material(peak.quad, peak.station)));
}

}  // namespace

PlasticSummary plastic_summary(const RollingSystem& system, const RunResult& run) {
  PlasticSummary out;
  out.strain = run.plastic.strain;
  out.accumulated = run.plastic.accumulated;
  out.elements = static_cast<double>(run.plastic.yielded);
  out.work = run.remains.work;
  out.dissipated = run.remains.work - run.remains.backstress;
  if (run.remains.peak.accumulated > 0) add_place(system, run.remains.body, run.remains.peak, out);
  return out;
}

}  // namespace railstrata
