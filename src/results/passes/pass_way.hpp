#pragma once
// The way of a rail's points through the last pass: loops of stress against strain at a few of them, and the equivalent
// stress of a longitudinal section as the rail yields beside that of elastic bodies. Files of both and of the section:
// loops.csv (a row a station of each point), along.csv (a row a station of each row of depth), section.vtp (the section
// for ParaView and VTK).
#include <filesystem>
#include <string>
#include <vector>

#include "passes/pass_files.hpp"
#include "record/vtk.hpp"

namespace railstrata {

/// The governing point: where the net strain of the last pass is largest; where nothing flowed, where plastic strain is
/// largest; where there is none, below the middle of the patch where the elastic stress comes nearest to yield.
struct PassWay {
  int row = 0, column = 0;                ///< of the governing point; the longitudinal section is at its column
  std::vector<PassLoop> loops;            ///< of the governing point, then in its column of the first row and of the
                                          ///< rows above and below the lower border of each layer
  std::vector<double> elastic, yielding;  ///< Pa, von Mises per row and active station, [row * stations + i]; stress of
                                          ///< the process is in both
};

/// contact: the strain of the last pass.
PassWay pass_way(const RailPasses& rail, const SteadyBody& body, const Field& contact, const PassResult& last,
                 const PassState& state);

/// loops.csv; remarks: "#" lines before its own.
void write_loops(const std::filesystem::path& file, std::vector<std::string> remarks,
                 const std::vector<PassLoop>& loops);

void write_way(const std::filesystem::path& folder, const std::vector<std::string>& provenance, const RailPasses& rail,
               const PassWay& way);

/// A cell of the mesh a point, at x = 0, z upward: residual_stress_MPa and plastic_strain (symmetric tensors),
/// plastic_strain_accumulated, of passes accumulated_strain and net_strain of the last one and class; zone.
void write_points_vtk(const std::filesystem::path& file, VtkQuads mesh, const std::vector<PassPoint>& points,
                      PointColumns which);
/// The section of the stationary method. Of a line contact one column as wide as the stations are long.
void write_section_vtk(const std::filesystem::path& file, const RailPasses& rail, const PassSeries& series,
                       const PassResult& last);

}  // namespace railstrata
