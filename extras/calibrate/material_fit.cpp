#include "calibrate/material_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "calibrate/test_curves.hpp"
#include "core/faults.hpp"
#include "io/provenance.hpp"
#include "reader/case_file.hpp"
#include "record/unit.hpp"
#include "report/pictures.hpp"
#include "text/text_file.hpp"
#include "text/units.hpp"

namespace railstrata {
namespace {

constexpr int kDrawn = 200;  // points of a fitted curve

std::string file_text(const std::filesystem::path& file) {
  return read_text_file(file, "name a CSV file of a test; cases/material has examples");
}

/// Adds the place to the error of a fit.
template <class Work>
auto at_place(const std::string& place, Work&& work) {
  try {
    return work();
  } catch (const std::invalid_argument& e) {
    throw CaseError(e.what(),
                    "docs/material.md describes what a fit needs: enough rows over the plastic strains of interest",
                    place);
  }
}

std::string megapascal(double value) { return fmt::format("\"{:.10g} MPa\"", kToMega * value); }

PlotCurve measured(const std::string& name, const std::vector<CurvePoint>& points) {
  PlotCurve out{name, {}, {}, true};
  for (const CurvePoint& p : points) {
    out.x.push_back(kToPercent * p.plastic_strain);
    out.y.push_back(kToMega * p.stress);
  }
  return out;
}

template <class Stress>
PlotCurve fitted(double from, double to, Stress&& stress) {
  PlotCurve out{"fit", {}, {}, false};
  for (int i = 0; i <= kDrawn; ++i) {
    const double e = from + (to - from) * i / kDrawn;
    out.x.push_back(kToPercent * e);
    out.y.push_back(kToMega * stress(e));
  }
  return out;
}

double longest(const std::vector<CurvePoint>& points) {
  double out = 0;
  for (const CurvePoint& p : points) out = std::max(out, p.plastic_strain);
  return out;
}

constexpr double kDoubtful = 0.05, kNoClaim = 0.1;  // of plastic strain

/// Strains above 0.5 are probably per cent without a unit. No message up to `from`.
void note_large_strains(const std::vector<CurvePoint>& points, const std::string& place, double from,
                        std::vector<std::string>& notes) {
  double largest = 0;
  for (const CurvePoint& p : points) largest = std::max(largest, std::abs(p.plastic_strain));
  if (largest > from)
    notes.push_back(fmt::format(
        "{}: plastic strain reaches {:.1f} %: {}; percents need their unit in the column's name, \"strain [%]\"", place,
        kToPercent * largest,
        largest > kNoClaim ? "small strain no longer describes it, the fit is no claim"
                           : "the law is one of small strain, stresses are some per cent off"));
}

/// A compression curve as the law has it: with both signs changed.
std::vector<CurvePoint> as_tension(std::vector<CurvePoint> curve, const std::string& place,
                                   std::vector<std::string>& notes) {
  const auto pulled = [](const CurvePoint& p) { return p.stress > 0; };
  if (curve.empty() || std::any_of(curve.begin(), curve.end(), pulled)) return curve;
  for (CurvePoint& p : curve) p = {-p.plastic_strain, -p.stress};
  notes.push_back(fmt::format("{}: a curve of compression, taken as tension with both signs changed", place));
  return curve;
}

void note_rate_at_edge(const PlasticParameters<double>& law, const std::vector<CurvePoint>& monotonic,
                       const std::string& place, std::vector<std::string>& notes) {
  constexpr double kNear = 1.05;
  const RateBounds bounds = rate_bounds(monotonic);
  if (law.saturation == 0 || (law.rate > kNear * bounds.low && kNear * law.rate < bounds.high)) return;
  notes.push_back(
      fmt::format("{}: the rate b = {:.4g} lies at the edge of its search, {:.4g} to {:.4g}: the curve does "
                  "not determine it; give points of {} plastic strains",
                  place, law.rate, bounds.low, bounds.high, law.rate <= kNear * bounds.low ? "larger" : "smaller"));
}

MaterialFit fit_shear_yield(const std::filesystem::path& file) {
  MaterialFit out;
  out.of_shear_yield = true;
  out.monotonic = read_shear_yield(file_text(file), file);
  out.whole = out.stabilised = at_place(file.string(), [&] { return fit_yield_stresses(out.monotonic); });
  note_rate_at_edge(out.whole.law, out.monotonic, file.string(), out.notes);
  if (out.whole.law.saturation < 0)
    out.notes.push_back(fmt::format(
        "{}: the yield stress falls as strain grows, and sheared steel hardens: look at the columns", file.string()));
  if (longest(out.monotonic) > kNoClaim)
    out.notes.push_back(fmt::format(
        "{}: plastic strain reaches {:.0f} %: the card has the strength of sheared steel, no law of small strains",
        file.string(), kToPercent * longest(out.monotonic)));
  return out;
}

}  // namespace

MaterialFit fit_curves(MaterialCurves curves) {
  MaterialFit out;
  out.notes = std::move(curves.notes);
  note_large_strains(curves.cyclic, curves.cyclic_place, kDoubtful, out.notes);
  out.of_loop = curves.of_loop;
  out.cyclic = std::move(curves.cyclic);
  out.stabilised = at_place(curves.cyclic_place, [&] {
    if (!out.of_loop) return fit_amplitudes(out.cyclic, curves.backstresses);
    const Loop loop = loop_of(out.cyclic);
    out.amplitude = loop.amplitude;
    out.cyclic = loop.points;
    return fit_loop(loop, curves.backstresses);
  });
  out.whole = out.stabilised;
  if (curves.monotonic.empty()) return out;
  constexpr double kElastic = 2e-4;  // plastic strain; a tensile test does not resolve less
  note_large_strains(curves.monotonic, curves.monotonic_place, kNoClaim, out.notes);  // tension goes to some per cent
  out.monotonic = as_tension(std::move(curves.monotonic), curves.monotonic_place, out.notes);
  std::erase_if(out.monotonic, [](const CurvePoint& p) { return !(p.plastic_strain > kElastic); });
  out.whole = at_place(curves.monotonic_place, [&] {
    if (out.monotonic.empty()) throw std::invalid_argument("no point flows: plastic strains stay below 0.02 %");
    return with_isotropic_part(out.stabilised, out.monotonic);
  });
  note_rate_at_edge(out.whole.law, out.monotonic, curves.monotonic_place, out.notes);
  return out;
}

MaterialFit fit_material(const MaterialTests& tests, double young) {
  if (!tests.shear_yield.empty()) return fit_shear_yield(tests.shear_yield);
  MaterialCurves curves;
  curves.of_loop = !tests.loop.empty();
  curves.backstresses = tests.backstresses;
  const std::filesystem::path& cyclic = curves.of_loop ? tests.loop : tests.amplitudes;
  curves.cyclic_place = cyclic.string();
  curves.cyclic = read_test_curve(file_text(cyclic), cyclic, curves.of_loop ? TestCurve::curve : TestCurve::amplitudes,
                                  young, &curves.notes);
  if (!tests.monotonic.empty()) {
    curves.monotonic_place = tests.monotonic.string();
    std::vector<std::string> notes;
    curves.monotonic = read_test_curve(file_text(tests.monotonic), tests.monotonic, TestCurve::curve, young, &notes);
    curves.notes.insert(curves.notes.end(), notes.begin(), notes.end());
  }
  return fit_curves(std::move(curves));
}

std::vector<std::string> fit_remarks(const MaterialFit& fit, const std::string& cyclic, const std::string& monotonic) {
  std::vector<std::string> out{fmt::format(
      "Fitted by RailStrata {} to {}: error {:.2f} % of the largest stress (root mean square), {:.2f} % at most",
      version_text(), cyclic, kToPercent * fit.stabilised.error, kToPercent * fit.stabilised.largest_error)};
  if (!monotonic.empty())
    out.push_back(fmt::format("and to {}: error {:.2f} %, {:.2f} % at most", monotonic, kToPercent * fit.whole.error,
                              kToPercent * fit.whole.largest_error));
  else if (fit.of_shear_yield)
    out.emplace_back("isotropic hardening alone, of shear yield stresses times the root of 3");
  else
    out.emplace_back("yield_strength is that of the stabilised cycle: a monotonic curve (--monotonic) gives Q and b");
  return out;
}

PlasticParameters<double> rounded(const PlasticParameters<double>& law) {
  const auto five = [](double v) { return std::stod(fmt::format("{:.5g}", v)); };
  PlasticParameters<double> out{0, five(law.yield), five(law.saturation), five(law.rate), {}, {}};
  for (int k = 0; k < kMostBackstresses; ++k) {
    out.modulus[k] = five(law.modulus[k]);
    out.recall[k] = five(law.recall[k]);
  }
  return out;
}

std::string material_card(const MaterialSpec& elastic, const PlasticParameters<double>& law,
                          const std::vector<std::string>& remarks) {
  std::string out;
  for (const std::string& remark : remarks) out += fmt::format("# {}\n", remark);
  out += fmt::format("[material.rail]\nyoung = \"{}\"\npoisson = {}\nyield_strength = {}\n",
                     format_quantity(elastic.young, dimension::kPressure), elastic.poisson, megapascal(law.yield));
  if (law.saturation != 0)
    out +=
        fmt::format("isotropic_hardening = {{ saturation = {}, rate = {:g} }}\n", megapascal(law.saturation), law.rate);
  std::string terms;
  for (int k = 0; k < kMostBackstresses; ++k)
    if (law.modulus[k] > 0)
      terms += fmt::format("{}{{ modulus = {}, recall = {:g} }}", terms.empty() ? "" : ", ", megapascal(law.modulus[k]),
                           law.recall[k]);
  if (!terms.empty()) out += fmt::format("kinematic_hardening = [{}]\n", terms);
  try {
    static_cast<void>(parse_case(out, "fit"));
  } catch (const CaseError& e) {
    throw CaseError(fmt::format("the fit gives numbers that no material has: {}", e.diagnostics.front().message),
                    "look at the test: units, both branches of a loop, Young's modulus of the card");
  }
  return out;
}

std::string fit_picture(const std::string& title, const MaterialFit& fit, const std::vector<std::string>& remarks) {
  const PlasticParameters<double>& law = fit.whole.law;
  std::vector<Plot> plots;
  if (fit.of_loop)
    plots.push_back({"plastic strain [%]",
                     "stress of the stabilised loop [MPa]; falling branch with both signs changed",
                     {measured("test", fit.cyclic), fitted(-fit.amplitude, fit.amplitude, [&](double e) {
                        return loop_stress(law, fit.amplitude, e);
                      })}});
  else if (!fit.of_shear_yield)
    plots.push_back({"plastic strain amplitude [%]",
                     "stress amplitude [MPa]",
                     {measured("test", fit.cyclic),
                      fitted(0, longest(fit.cyclic), [&](double e) { return amplitude_of(law, e); })}});
  if (!fit.monotonic.empty())
    plots.push_back(
        {"plastic strain [%]",
         fit.of_shear_yield ? "yield stress, root of 3 times that in shear [MPa]" : "stress of monotonic tension [MPa]",
         {measured("test", fit.monotonic),
          fitted(0, longest(fit.monotonic), [&](double e) { return monotonic_stress(law, e); })}});
  return plots_svg(title, plots, remarks);
}

}  // namespace railstrata
