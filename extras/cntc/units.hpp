#pragma once
// The units of a contact problem, flag 1933. Inside everything is SI and on body 1, the upper one.
#include "cntc/codes.hpp"

namespace railstrata::cntc {

struct Units {
  int code = 1934;       ///< 1934 CONTACT (mm, N, on body 1), 1935 SIMPACK (m, N, on body 2), 1936 SI (m, N, on body 1)
  double length = 1e-3;  ///< m in the user's unit of length
  double body = 1;       ///< -1: results are those of body 2

  double area() const { return length * length; }
};

/// Throws Refused for units that there are none of.
inline Units units_of(int code) {
  if (code == 1934) return {code, 1e-3, 1};
  if (code == 1935) return {code, 1, -1};
  if (code == 1936) return {code, 1, 1};
  throw Refused(kOther,
                "units (flag 1933) are 1934 (CONTACT), 1935 (SIMPACK) or 1936 (SI), not " + std::to_string(code));
}

}  // namespace railstrata::cntc
