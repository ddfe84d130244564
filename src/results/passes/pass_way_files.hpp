#pragma once
// Files of the way through the last pass and of the section: loops.csv (a row a station of each point), along.csv (a
// row a station of each row of depth), section.vtp (the section for ParaView and VTK).
#include <filesystem>
#include <string>
#include <vector>

#include "passes/pass_files.hpp"
#include "passes/pass_way.hpp"
#include "record/vtk.hpp"

namespace railstrata {

/// Loops of a history by the stationary method.
std::vector<PassLoop> loops_of(const RailPasses& rail, const PassWay& way);
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
