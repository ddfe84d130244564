#pragma once
// Blocks of points below (z < 0) and above (z >= 0) the contact plane, and the stresses there.
//
// Homogeneous bodies: the sum of the closed forms of every element's constant traction, as CONTACT has it. Layered
// ones: bem/subsurface.hpp, which is bicubic between the elements' centres.
#include <span>

#include "cntc/problem.hpp"

namespace railstrata::cntc {

inline constexpr int kBlockColumns = 21;

/// A caller's input for one block; z in the user's unit of length, x and y too where ISUBS = 9.
struct BlockInput {
  int number = 0, kind = 0;
  std::span<const double> x, y, z;
};

/// Takes block `number`, 1 to one more than there are; those from there on are forgotten. 0: all are.
void add_block(Problem& problem, const BlockInput& input);

/// The tables of all blocks.
void solve_blocks(Problem& problem);

/// Numbers of points along x, y, z.
std::array<int, 3> block_size(const Problem& problem, int number);

/// A column, 1 to 21, in the user's units.
std::vector<double> block_column(const Problem& problem, int number, int column);

}  // namespace railstrata::cntc
