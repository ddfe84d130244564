#pragma once
// The handle of a contact.
#include <optional>
#include <string>

#include "bem/solve_bem.hpp"
#include "capi/next_start.hpp"
#include "capi/railstrata.h"
#include "model/model.hpp"
#include "reader/case_file.hpp"
#include "result/summary.hpp"

/// The case with its profiles read once, what solutions share, and the last one.
struct rs_contact {
  railstrata::LoadedCase loaded;
  railstrata::Placement placement;
  railstrata::BemOptions options;
  railstrata::InfluenceCache cache;
  railstrata::capi::NextStart start;
  std::optional<railstrata::BemResult> last;
  std::optional<rs_state> state;  ///< of the last answer; none: there is none
  std::string remarks;
};

namespace railstrata::capi {

/// Whether a state leaves the wheel where it is.
bool same_place(const GeometrySpec& a, const GeometrySpec& b);
/// The placement of the case's profiles where a state has moved the wheel.
Placement placed(const rs_contact& contact, const CaseSpec& spec);

int cells_with_pressure(const ContactField& field);

/// The numbers of a result.
rs_forces forces_of(const BemResult& result, const Summary& summary);

/// One tolerance t of all parts: t of slip, friction's force and the weight, 0.01 t of the gap.
void set_tolerance(BemOptions& options, double t);

/// Throws CaseError: NULL.
void require(const rs_contact* contact);
/// Of the last solution. Throws CaseError: there is none, or not this patch.
const BemPatch& patch_of(const rs_contact* contact, int patch);

}  // namespace railstrata::capi
