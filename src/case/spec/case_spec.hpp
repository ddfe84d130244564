#pragma once
// The options of a case, in SI units, with every default. case/case_file reads it; case/option_table gives names,
// units, ranges, the words of the choices and documentation. Who needs one section includes that one.
#include <string>
#include <vector>

#include "geometry/irregularity.hpp"
#include "spec/drive_spec.hpp"
#include "spec/geometry_spec.hpp"
#include "spec/history_spec.hpp"
#include "spec/layer_spec.hpp"
#include "spec/run_spec.hpp"

namespace railstrata {

struct CaseSpec {
  std::string title = "untitled";
  GeometrySpec geometry;
  MaterialSpec rail_material, wheel_material;
  std::vector<LayerSpec> layers;
  std::vector<StretchSpec> stretches;
  std::vector<Irregularity> irregularities;
  VehicleSpec vehicle;
  TrackSpec track;
  DriveSpec drive;
  FrictionSpec friction;
  ThirdBodySpec third_body;
  MeshSpec mesh;
  RunSpec run;
  BemSpec bem;
  TransientSpec transient;
  std::vector<LoadSpec> loads;
  CollectiveSpec collective;
  LifeSpec life;
  PassesSpec passes;
};

}  // namespace railstrata
