#pragma once
namespace railstrata::cntc {

/// A row of elements of a patch on a curved surface: its place in the plane of the patch's reference and its
/// inclination to it.
struct CurvedRow {
  double s = 0, n = 0;  ///< m, from the reference
  double turn = 0;      ///< rad
};

}  // namespace railstrata::cntc
