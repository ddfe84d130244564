#include "runs/material_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case/material_tables.hpp"
#include "case/text_file.hpp"
#include "case/units.hpp"
#include "core/faults.hpp"
#include "report/plots.hpp"

namespace railstrata {
namespace {

constexpr double kMega = 1e-6, kPercent = 100;
constexpr int kDrawn = 200;  // points of a fitted curve

std::string file_text(const std::filesystem::path& file) {
  return read_text_file(file, "name a CSV file of a test; cases/material has examples");
}

/// What a fit refuses, at its file.
template <class Work>
auto at_file(const std::filesystem::path& file, Work&& work) {
  try {
    return work();
  } catch (const std::invalid_argument& e) {
    throw CaseError(e.what(),
                    "docs/material.md says what a fit needs: enough rows over the plastic strains of interest",
                    file.string());
  }
}

std::string megapascal(double value) { return fmt::format("\"{:.10g} MPa\"", kMega * value); }

PlotCurve measured(const std::string& name, const std::vector<CurvePoint>& points) {
  PlotCurve out{name, {}, {}, true};
  for (const CurvePoint& p : points) {
    out.x.push_back(kPercent * p.plastic_strain);
    out.y.push_back(kMega * p.stress);
  }
  return out;
}

template <class Stress>
PlotCurve fitted(double from, double to, Stress&& stress) {
  PlotCurve out{"fit", {}, {}, false};
  for (int i = 0; i <= kDrawn; ++i) {
    const double e = from + (to - from) * i / kDrawn;
    out.x.push_back(kPercent * e);
    out.y.push_back(kMega * stress(e));
  }
  return out;
}

double longest(const std::vector<CurvePoint>& points) {
  double out = 0;
  for (const CurvePoint& p : points) out = std::max(out, p.plastic_strain);
  return out;
}

}  // namespace

MaterialFit fit_material(const MaterialTests& tests, double young) {
  MaterialFit out;
  out.of_loop = !tests.loop.empty();
  const std::filesystem::path& cyclic = out.of_loop ? tests.loop : tests.amplitudes;
  out.cyclic =
      read_test_curve(file_text(cyclic), cyclic, out.of_loop ? TestCurve::curve : TestCurve::amplitudes, young);
  out.stabilised = at_file(cyclic, [&] {
    if (!out.of_loop) return fit_amplitudes(out.cyclic, tests.backstresses);
    const Loop loop = loop_of(out.cyclic);
    out.amplitude = loop.amplitude;
    out.cyclic = loop.points;
    return fit_loop(loop, tests.backstresses);
  });
  out.whole = out.stabilised;
  if (tests.monotonic.empty()) return out;
  std::vector<CurvePoint> tension =
      read_test_curve(file_text(tests.monotonic), tests.monotonic, TestCurve::curve, young);
  constexpr double kElastic = 2e-4;  // of plastic strain: a tensile test tells nothing of less
  std::erase_if(tension, [](const CurvePoint& p) { return !(p.plastic_strain > kElastic); });
  out.monotonic = tension;
  out.whole = at_file(tests.monotonic, [&] { return with_isotropic_part(out.stabilised, tension); });
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
  else
    plots.push_back({"plastic strain amplitude [%]",
                     "stress amplitude [MPa]",
                     {measured("test", fit.cyclic),
                      fitted(0, longest(fit.cyclic), [&](double e) { return amplitude_of(law, e); })}});
  if (!fit.monotonic.empty())
    plots.push_back({"plastic strain [%]",
                     "stress of monotonic tension [MPa]",
                     {measured("test", fit.monotonic),
                      fitted(0, longest(fit.monotonic), [&](double e) { return monotonic_stress(law, e); })}});
  return plots_svg(title, plots, remarks);
}

}  // namespace railstrata
