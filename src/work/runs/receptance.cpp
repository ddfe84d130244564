#include "runs/receptance.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/parallel.hpp"
#include "fem/rolling_system.hpp"
#include "record/output_file.hpp"
#include "report/page.hpp"
#include "rules/support.hpp"
#include "tables/column_words.hpp"
#include "tables/unit_table.hpp"
#include "text/text_file.hpp"

namespace railstrata {
namespace {

constexpr double kFrequencyStep = 10;  // Hz
constexpr double kAtRest = 0.5;        // Hz, in place of 0: an endless beam is at rest nowhere

struct ForcePlace {
  const char *name, *shown;
  double phase;  // of a force at x = 0
};
constexpr ForcePlace kForcePlaces[] = {{"midspan", "midspan", 0.5}, {"sleeper", "over a sleeper", 0}};

double decibels(std::complex<double> value) { return 20 * std::log10(std::abs(value)); }

ReportSeries receptance_line(const Receptance& r, const ReceptanceCurve& curve, bool dashed,
                             double (*value)(std::complex<double>)) {
  ReportSeries out{.name = curve.shown, .x = {}, .y = {}, .markers = false, .dash = dashed ? "dash" : "solid"};
  for (std::size_t k = 1; k < r.frequency.size(); ++k) {
    out.x.push_back(r.frequency[k]);
    out.y.push_back(value(curve.values[k]));
  }
  return out;
}

ReportChart receptance_chart(const Receptance& r, const char* id, const char* title, const char* y,
                             double (*value)(std::complex<double>), bool of_phase = false) {
  ReportChart out{id, title, "", "frequency, Hz", y, {}};
  out.log = of_phase ? "x" : "xy";
  for (const ReceptanceCurve& c : r.curves)
    out.series.push_back(receptance_line(r, c, c.name.starts_with("beam"), value));
  for (const MeasuredReceptance& m : r.measured) {
    if (of_phase && !m.has_phase) continue;
    ReportSeries line{.name = m.name, .x = m.frequency, .y = {}, .markers = false, .dash = "dot"};
    for (const std::complex<double>& v : m.values) line.y.push_back(value(v));
    out.series.push_back(std::move(line));
  }
  return out;
}

/// dB, root mean square over the measured frequencies that the curve has; NaN without any.
double difference_in_decibels(const Receptance& r, const ReceptanceCurve& curve, const MeasuredReceptance& m) {
  double sum = 0;
  int places = 0;
  for (std::size_t i = 0; i < m.frequency.size(); ++i) {
    const auto after = std::lower_bound(r.frequency.begin() + 1, r.frequency.end(), m.frequency[i]);
    if (after == r.frequency.end() || m.frequency[i] < r.frequency[1]) continue;
    const auto k = std::max<std::ptrdiff_t>(after - r.frequency.begin(), 2);
    const double share = (m.frequency[i] - r.frequency[k - 1]) / (r.frequency[k] - r.frequency[k - 1]);
    const double computed =
        (1 - share) * decibels(curve.values[k - 1]) + share * decibels(curve.values[static_cast<std::size_t>(k)]);
    sum += std::pow(decibels(m.values[i]) - computed, 2);
    ++places;
  }
  return places == 0 ? std::nan("") : std::sqrt(sum / places);
}

/// Integral of values e^(-i omega t) dt, samples of the time steps.
std::complex<double> fourier(const std::vector<double>& values, double dt, double frequency) {
  const double angle = 2 * std::numbers::pi * frequency * dt;
  std::complex<double> sum = 0;
  for (std::size_t n = 0; n < values.size(); ++n)
    if (values[n] != 0) sum += values[n] * std::polar(dt, -angle * static_cast<double>(n));
  return sum;
}

ReceptanceCurve over_force(const ForcePlace& place, const char* of, const BlowResponse& blow,
                           const std::vector<double>& displacement, const std::vector<double>& frequency) {
  ReceptanceCurve out{fmt::format("{}_{}", of, place.name), fmt::format("{}, {}", of, place.shown), {}};
  out.values.resize(frequency.size());
  for_each(static_cast<std::ptrdiff_t>(frequency.size()), [&](std::ptrdiff_t k) {
    out.values[k] = fourier(displacement, blow.dt, frequency[k]) / fourier(blow.force, blow.dt, frequency[k]);
  });
  return out;
}

}  // namespace

MeasuredReceptance read_receptance(const std::filesystem::path& file) {
  const auto number = [](const char* key, const Dimension& dimension, const Range& range) {
    return Option{key, nullptr, "", dimension, range};
  };
  constexpr double kMost = 1e6;  // of any of them, SI
  const Option frequency = number("frequency", dimension::kRate, {1e-3, 1e6}),
               phase = number("phase", dimension::kAngle, {-1e4, 1e4});
  const Option over_force[] = {number("receptance", dimension::kReceptance, {0, kMost}),
                               number("mobility", dimension::kMobility, {0, kMost}),
                               number("accelerance", dimension::kAccelerance, {0, kMost})};
  UnitTableForm form{{{&frequency, "frequency"}, {&phase, "phase"}},
                     {{"receptance", "mobility", "accelerance"}},
                     "a measured receptance",
                     "frequency [Hz]; receptance [nm/N]; phase [deg]"};
  for (const Option& o : over_force) form.columns.push_back({&o, o.key});
  for (const UnitTableForm::Column& c : std::vector(form.columns))
    for (const std::string_view word : words_of(c.key)) form.columns.push_back({c.option, word});
  const UnitTable table = read_unit_table(read_text_file(file, "name a CSV file"), file, form);
  MeasuredReceptance out{file.filename().string(), {}, {}, table.has("phase")};
  const auto column =
      std::find_if(std::begin(over_force), std::end(over_force), [&](const Option& o) { return table.has(o.key); });
  if (!table.has("frequency") || column == std::end(over_force))
    refuse_in_table(file, table.line, "no columns of frequency and receptance, mobility or accelerance",
                    fmt::format("begin with {}", form.example));
  for (const UnitTable::Row& row : table.rows) {
    double f = 0, modulus = 0, angle = 0;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      const double value = row.cells[k].number.value();
      (table.columns[k] == &frequency ? f : table.columns[k] == &phase ? angle : modulus) = value;
    }
    if (!(modulus > 0)) refuse_in_table(file, row.line, "nothing moves under this force", "leave the row out");
    // a time derivative is i omega
    const std::complex<double> per_motion(0, 2 * std::numbers::pi * f);
    const auto derivatives = static_cast<int>(column - std::begin(over_force));
    out.frequency.push_back(f);
    out.values.push_back(std::polar(modulus, angle) / std::pow(per_motion, derivatives));
  }
  return out;
}

std::vector<std::string> differences_in_words(const Receptance& r) {
  std::vector<std::string> out;
  for (const MeasuredReceptance& m : r.measured) {
    std::vector<std::string> from;
    for (const ReceptanceCurve& c : r.curves)
      if (const double dB = difference_in_decibels(r, c, m); std::isfinite(dB))
        from.push_back(fmt::format("{:.1f} dB from {}", dB, c.shown));
    out.push_back(from.empty() ? fmt::format("{} has no frequency that was computed", m.name)
                               : fmt::format("{} is {} (root mean square)", m.name, fmt::join(from, ", ")));
  }
  return out;
}

std::vector<double> receptance_frequencies(double largest) {
  std::vector<double> out{0};
  for (int k = 1; k * kFrequencyStep <= largest; ++k) out.push_back(k * kFrequencyStep);
  return out;
}

Receptance beam_receptances(const Model& model, const std::vector<double>& frequency) {
  const TrackSpec& track = model.spec.track;
  require_support(uses::kReceptance, model.spec);
  const RailBeam beam = rail_beam(model);
  Receptance out{frequency, pinned_pinned_frequency(beam, track.support.spacing), {}};
  for (const ForcePlace& place : kForcePlaces) {
    SleeperTrack below = track.support;
    below.phase = place.phase;
    ReceptanceCurve curve{fmt::format("beam_{}", place.name), fmt::format("beam, {}", place.shown), {}};
    curve.values.resize(frequency.size());
    for_each(static_cast<std::ptrdiff_t>(frequency.size()), [&](std::ptrdiff_t k) {
      curve.values[k] = beam_receptance(beam, below, 0, std::max(kAtRest, frequency[k]));
    });
    out.curves.push_back(std::move(curve));
  }
  return out;
}

std::vector<BlowEnergy> add_hammer_receptances(const Model& model, double time,
                                               const std::function<void(double)>& progress, Receptance& r) {
  const SleeperTrack& track = model.spec.track.support;
  const Body rail(model.rail, model.rail_materials, element_options(model.spec));
  const RailPads pads = rail_pads(rail, track);
  const std::vector<double>& at = model.rail.blocks[model.rail.contact.block].stations.at;
  const double middle = 0.5 * (at.front() + at.back());
  std::vector<BlowEnergy> out;
  for (const ForcePlace& place : kForcePlaces) {
    const double offset = (track.phase + place.phase) * track.spacing;
    const HammerBlow blow{offset + track.spacing * std::round((middle - offset) / track.spacing),
                          1 / r.frequency.back(), time, model.spec.run.step_safety};
    const double done = static_cast<double>(out.size()) / std::size(kForcePlaces);
    const BlowResponse response = strike(rail, pads, blow, [&](double share) {
      if (progress) progress(done + share / std::size(kForcePlaces));
    });
    r.curves.push_back(over_force(place, "rail", response, response.section, r.frequency));
    r.curves.push_back(over_force(place, "head", response, response.head, r.frequency));
    out.push_back(response.energy);
  }
  return out;
}

std::vector<CsvColumn> receptance_table(const Receptance& r) {
  const auto name = [](const std::string& of, const Unit& unit) { return fmt::format("{}{}", of, unit.column_ending); };
  std::vector<CsvColumn> out{{name("frequency", unit::kHertz), r.frequency}};
  for (const ReceptanceCurve& c : r.curves) {
    CsvColumn modulus{name(c.name, unit::kNanometresPerNewton), {}}, phase{name(c.name + "_phase", unit::kDegrees), {}};
    for (const std::complex<double>& v : c.values) {
      modulus.values.push_back(unit::kNanometresPerNewton.column_factor * std::abs(v));
      phase.values.push_back(unit::kDegrees.column_factor * std::arg(v));
    }
    out.push_back(std::move(modulus));
    out.push_back(std::move(phase));
  }
  return out;
}

/// Largest values that stand above what lies half an octave beside them, of the first curve.
std::vector<std::string> resonances(const Receptance& r) {
  constexpr double kBeside = 1.2;
  std::vector<std::string> out;
  const std::vector<std::complex<double>>& u = r.curves.back().values;
  for (std::size_t k = 1; k + 1 < u.size(); ++k) {
    bool peak = std::abs(u[k]) > std::abs(u[k - 1]) && std::abs(u[k]) > std::abs(u[k + 1]);
    for (std::size_t j = 1; j < u.size() && peak; ++j)
      if (j != k && r.frequency[j] > r.frequency[k] / kBeside && r.frequency[j] < r.frequency[k] * kBeside)
        peak = std::abs(u[j]) < std::abs(u[k]);
    if (peak) out.push_back(fmt::format("{:.0f} Hz ({:.3g} nm/N)", r.frequency[k], 1e9 * std::abs(u[k])));
  }
  return out;
}

ReportAnswer receptance_answer(const Receptance& r) {
  const std::vector<std::string> peaks = resonances(r);
  return {"plain", peaks.empty() ? "No resonance" : fmt::format("Resonances at {}", fmt::join(peaks, ", ")),
          fmt::format("of {}; static compliance {:.3g} nm/N, pinned-pinned mode of the beam at {:.0f} Hz",
                      r.curves.back().shown, 1e9 * std::abs(r.curves.back().values.front()), r.pinned_pinned)};
}

void write_receptance_page(const std::filesystem::path& page, const std::string& title, const Receptance& r) {
  Report report;
  report.title = fmt::format("{}: receptance", title);
  report.answers = {receptance_answer(r)};
  for (const std::string& words : differences_in_words(r)) report.answers.push_back({"plain", "Measured", words});
  report.charts.push_back(receptance_chart(r, "modulus", "Receptance", "|u/F|, nm/N", [](std::complex<double> v) {
    return unit::kNanometresPerNewton.factor * std::abs(v);
  }));
  report.charts.push_back(receptance_chart(
      r, "phase", "Phase", "degrees", [](std::complex<double> v) { return unit::kDegrees.factor * std::arg(v); },
      true));
  ReportChart& modulus = report.charts.front();
  modulus.note = fmt::format(
      "Vertical force on the rail. beam: endless, loss factor 0.01; rail: finite elements, mean of the section by "
      "mass; head: the same where the hammer strikes. "
      "Pinned-pinned mode of the beam: {:.0f} Hz, marked.",
      r.pinned_pinned);
  if (r.pinned_pinned < r.frequency.back()) {
    const auto [low, high] = std::minmax_element(modulus.series.front().y.begin(), modulus.series.front().y.end());
    modulus.series.push_back({.name = "pinned-pinned",
                              .x = {r.pinned_pinned, r.pinned_pinned},
                              .y = {*low, *high},
                              .markers = false,
                              .dash = "dot"});
  }
  ReportTable& at_rest = report.tables.emplace_back();
  at_rest.id = "static";
  at_rest.title = "Static compliance";
  at_rest.columns = {"", "nm/N"};
  for (const ReceptanceCurve& c : r.curves)
    at_rest.rows.push_back({c.shown, unit::kNanometresPerNewton.factor * std::abs(c.values.front())});
  write_whole_file(page, report_page(report));
}

}  // namespace railstrata
