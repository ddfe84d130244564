#pragma once
#include <stdexcept>
#include <string>

namespace railstrata {

/// The value; std::invalid_argument names `what` if it is not above 0.
inline double positive(double value, const char* what) {
  if (!(value > 0)) throw std::invalid_argument(std::string(what) + " must be positive");
  return value;
}

}  // namespace railstrata
