#pragma once
// A half-space summary with the stresses of both bodies, without shakedown.
#include "judge/bem_summary.hpp"

namespace railstrata {

inline Summary whole_summary(const CaseSpec& spec, const BemResult& r) {
  Summary s = bem_contact_summary(spec, r);
  s.rail = bem_stress(r, BodyId::rail, s.contact);
  s.wheel = bem_stress(r, BodyId::wheel, s.contact);
  s.warnings = bem_warnings(s, spec, r);
  return s;
}

}  // namespace railstrata
