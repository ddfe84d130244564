#pragma once
// Checkpoints of a run: a RunState with what its result files need, as one HDF5 file that h5py and h5dump open.
//
// The file begins with a block of 512 bytes for people and for the check ("RailStrata checkpoint", format, SHA-256 of
// all that follows), which HDF5 skips. Every byte of the file is covered. HDF5 works in memory only: the bytes reach
// the disk as those of any other result do (record/output_file), under a new name that is renamed when the disk has
// them, so readers that hold the old file open keep it and no lock stands in the way.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "hdf5/checkpoint_image.hpp"

namespace railstrata {

/// 2: the columns of contact_facets have their own names. A checkpoint of another format is refused, the message gives
/// which program wrote it.
inline constexpr int kCheckpointFormat = 7;
/// Those from this one on are read too; 6 has no sleepers.
inline constexpr int kOldestCheckpointFormat = 6;

/// The file's bytes, and back. checkpoint_bytes throws EnvironmentError, checkpoint_of CaseError with the fault in the
/// bytes; `name`, `file`: their name in the message.
std::string checkpoint_bytes(const CheckpointOrigin& origin, const RunState& run,
                             const std::string& name = "a checkpoint");
Checkpoint checkpoint_of(std::string_view bytes, const std::filesystem::path& file);

/// An HDF5 image behind the text of 512 bytes that vouches for it.
std::string sealed_checkpoint(std::string_view image);

/// checkpoint.h5 of a result folder, and the one before it.
std::filesystem::path checkpoint_file(const std::filesystem::path& folder);
std::filesystem::path previous_checkpoint_file(const std::filesystem::path& folder);

/// Writes checkpoint.h5; the one that was there becomes checkpoint.h5.previous. Throws EnvironmentError, and leaves the
/// old ones as they were.
void write_checkpoint(const std::filesystem::path& folder, const CheckpointOrigin& origin, const RunState& run);

struct FoundCheckpoint {
  Checkpoint checkpoint;
  std::vector<std::string> notes;  ///< what was wrong with a newer one
};

/// The newest whole checkpoint of the folder. Throws CaseError if there is none, or if it belongs to another case.
FoundCheckpoint read_checkpoint(const std::filesystem::path& folder, const std::string& case_sha256);

/// Removes the checkpoints of a folder and the unfinished files of a killed writer.
void remove_checkpoints(const std::filesystem::path& folder);

}  // namespace railstrata
