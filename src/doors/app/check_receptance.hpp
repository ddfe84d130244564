#pragma once
// `check --receptance`: displacement over force of the rail on its track.
#include <string>

#include "app/commands.hpp"

namespace railstrata {

struct ReceptanceOptions {
  double largest = 3000;       ///< --largest, Hz
  std::string time = "0.1 s";  ///< --time: how long a blow is followed
  bool beam = false;           ///< --beam: without finite elements
};

/// Writes receptance.csv and the page.
ExitCode check_receptance(const ReceptanceOptions& wanted, const CommandOptions& options);

}  // namespace railstrata
