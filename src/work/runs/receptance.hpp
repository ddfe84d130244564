#pragma once
// Receptance of the rail on the track of a case, as a table and a page: displacement over force of a vertical force on
// the rail at midspan and over a sleeper.
#include <complex>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fem/rail_on_track.hpp"
#include "model/rail_beam.hpp"
#include "record/csv.hpp"

namespace railstrata {

struct ReceptanceCurve {
  std::string name;                          ///< "beam_midspan"
  std::string shown;                         ///< of a chart's line
  std::vector<std::complex<double>> values;  ///< m/N, by frequency
};

/// A measurement to hold them against.
struct MeasuredReceptance {
  std::string name;                          ///< of its file
  std::vector<double> frequency;             ///< Hz, above 0
  std::vector<std::complex<double>> values;  ///< m/N
  bool has_phase = false;
};

struct Receptance {
  std::vector<double> frequency;  ///< Hz, 0 first: at rest
  double pinned_pinned = 0;       ///< Hz, of the beam
  std::vector<ReceptanceCurve> curves;
  std::vector<MeasuredReceptance> measured = {};
};

/// A table with the columns frequency, one of receptance, mobility and accelerance (displacement, velocity,
/// acceleration over force), and phase where it was measured. Throws CaseError with file, line and remedy.
MeasuredReceptance read_receptance(const std::filesystem::path& file);
/// Root mean square difference of each measurement and each curve in decibels over the frequencies of both, in words.
std::vector<std::string> differences_in_words(const Receptance& receptance);

/// Up to `largest` [Hz], every 10 Hz.
std::vector<double> receptance_frequencies(double largest);

/// The beam's curves. Throws CaseError for a case without a track.
Receptance beam_receptances(const Model& model, const std::vector<double>& frequency);

/// Adds those of finite elements: a blow of a hammer on the head at the midspan and the sleeper next to the rail's
/// middle, followed for `time` [s]; displacement over force as Fourier transforms of both, up to rest at 0 Hz. Two
/// curves a place: the mean of the section by mass, and the running surface where the force acts, which has the local
/// compliance too. progress: share done. Returns the energies of the blows.
std::vector<BlowEnergy> add_hammer_receptances(const Model& model, double time,
                                               const std::function<void(double)>& progress, Receptance& receptance);

/// Modulus and phase of every curve.
std::vector<CsvColumn> receptance_table(const Receptance& receptance);

void write_receptance_page(const std::filesystem::path& page, const std::string& title, const Receptance& receptance);

}  // namespace railstrata
