#pragma once
// Files of the way through the last pass and of the section: loops.csv (a row a station of each point), along.csv (a
// row a station of each row of depth), section.vtp (the section for ParaView and VTK).
#include <filesystem>
#include <string>
#include <vector>

#include "passes/pass_files.hpp"
#include "passes/pass_way.hpp"

namespace railstrata {

/// Of one point, what it sees at the stations in the order in which the load reaches them.
struct WayLoop {
  double y = 0, depth = 0;           ///< m, of the point
  std::vector<double> x;             ///< m, of the stations from the load
  std::vector<StationState> states;  ///< as many
};
/// loops.csv; remarks: "#" lines before its own.
void write_loops(const std::filesystem::path& file, std::vector<std::string> remarks,
                 const std::vector<WayLoop>& loops);

void write_way(const std::filesystem::path& folder, const std::vector<std::string>& provenance, const RailPasses& rail,
               const PassWay& way);

/// A cell a point of the section, at x = 0, z upward: residual_stress_MPa and plastic_strain (symmetric tensors),
/// plastic_p, accumulated_strain and net_strain of the last pass, class, zone. Of a line contact one column as wide as
/// the stations are long.
void write_section_vtk(const std::filesystem::path& file, const RailPasses& rail, const PassSeries& series,
                       const PassResult& last);

}  // namespace railstrata
