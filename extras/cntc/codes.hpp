#pragma once
// Numbers of CONTACT's library interface: error codes, flags, fields. [eve70a/CONTACT, matlab_intfc]
#include <stdexcept>
#include <string>

namespace railstrata::cntc {

inline constexpr int kInterfaceVersion = 2510;
inline constexpr int kMostElements = 999, kMostProblems = 9;

enum ErrorCode : int {
  kSearch = -25,        ///< failure of the contact search
  kTotalForce = -26,    ///< no solution for given total forces
  kNormal = -27,        ///< no convergence of the normal problem
  kTangential = -28,    ///< no convergence of the tangential problem
  kWrongProblem = -31,  ///< no such result element or contact problem
  kProfile = -32,       ///< a profile that cannot be read
  kFriction = -33,      ///< invalid friction
  kGrid = -34,          ///< invalid discretisation
  kInputFile = -39,
  kOther = -99
};

enum Flag : int {
  kUnits = 1933,
  kConfiguration = 1967,
  kTime = 1970,
  kBound = 1971,
  kTang = 1972,
  kNorm = 1973,
  kForce = 1974,
  kFrictionLaw = 1976,
  kDiscretisation = 1977,
  kInfluence = 1978,
  kMaterialLaw = 1979,
  kExtraSlip = 1980,
  kDebug = 1981,
  kHeat = 1982,
  kEstimate = 1983,
  kOutput = 1984,
  kFlow = 1985,
  kReturn = 1986,
  kMatFile = 1987,
  kSensitivities = 1988,
  kInfluenceMethod = 1989,
  kInfluenceVariant = 1990,
  kBlockOutput = 1991,
  kBlockFile = 1992,
  kMostCells = 1993,
  kPrintLevel = 2000,
  kLicenceTrace = 2001,
  kWriteInput = 2002,
  kThreads = 2003,
  kTimers = 2004,
  kCaseNumber = 2005
};

enum Field : int {
  kGap = 1,
  kFrictionField = 2,
  kTractionX = 3,
  kTractionY = 4,
  kPressure = 5,
  kDisplacementX = 7,
  kDisplacementY = 8,
  kDisplacementN = 9,
  kFilmStrength = 11,
  kSlipX = 15,
  kSlipY = 16,
  kTemperature1 = 20,
  kTemperature2 = 21
};

/// A request that is not supported or not possible: CONTACT's code and a line for the user.
struct Refused : std::runtime_error {
  Refused(int error_code, const std::string& text) : std::runtime_error(text), code(error_code) {}
  int code;
};

}  // namespace railstrata::cntc
