#pragma once
// Wear of pearlitic steel by its hardness: an estimate for steels whose wear nobody has measured.

namespace railstrata {

/// Wear rate over that of R260, between the rails with a measured one (R200, R260, R350HT; material/steels.hpp), each
/// at the middle of its range of hardness: straight lines in the logarithms of both. Softer than the softest and harder
/// than the hardest of them the value there is held, never extrapolated. Vickers.
///
/// Of pearlite alone: bainite and austenite wear otherwise at the same hardness. That of a harder metal is a guess on
/// the side of more wear: clads have half of R260 at most, and down to a twentieth. [Lu2019]
double pearlite_wear(double vickers);

/// Hardness from and up to which the rails lie.
struct WearHardness {
  double softest = 0, hardest = 0;  ///< HV
};
WearHardness pearlite_wear_range();

}  // namespace railstrata
