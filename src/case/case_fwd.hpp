#pragma once
// Names of what a case says, for headers that only pass it on.

namespace railstrata {

struct CaseSpec;
struct LoadSpec;
struct MaterialSpec;
struct PassesSpec;
struct VehicleSpec;

}  // namespace railstrata
