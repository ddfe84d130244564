#pragma once
// The state of a run as the bytes of an HDF5 file, and back. Nothing touches the disk.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "fem/rolling_run.hpp"

namespace railstrata {

struct CheckpointOrigin {
  std::string case_sha256;              ///< of the resolved case and its profiles
  std::string program;                  ///< version_text() of the writer
  std::vector<std::string> provenance;  ///< "#" lines of the run's tables
};
struct Checkpoint {
  CheckpointOrigin origin;
  RunState run;
};

/// A fault of the bytes of a checkpoint, and the remedy.
struct CheckpointDamage {
  std::string what;
  std::string remedy = "start the run anew with --force, or put a whole copy of the file back";
};

/// The image behind so many bytes of 0. Throws CheckpointDamage where HDF5 gives up (no memory).
std::string checkpoint_image(const CheckpointOrigin& origin, const RunState& run, std::size_t room_before);
/// Throws CheckpointDamage: it is no such image.
Checkpoint checkpoint_of_image(std::string_view image);

/// Gives free memory back to the system where it is left. HDF5 keeps up to 16 MiB of blocks for files to come, though
/// those of a history that grows fit no later file, and malloc twice the largest block that it has seen, up to 64 MiB:
/// both until the end of the run.
void give_memory_back();

}  // namespace railstrata
