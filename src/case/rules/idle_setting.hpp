#pragma once
// A setting of a case that has no effect, apart from the table that gives the reason (clashes.hpp).
#include <string>

namespace railstrata {

struct Feature;
struct Use;

/// In one sentence, and the feature that takes its effect away; null: it needs one.
struct IdleSetting {
  const Feature* by;
  std::string text;
};

}  // namespace railstrata
