#pragma once
// Forward declarations of a case's types, for headers that only pass them on.

namespace railstrata {

struct CaseSpec;
struct LoadSpec;
struct MaterialSpec;
struct PassesSpec;
struct VehicleSpec;

}  // namespace railstrata
