// Without HDF5 there are no checkpoints: what would write or read one says so.
#include "io/checkpoint_file.hpp"

#include "core/faults.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse() {
  throw EnvironmentError("the program for Windows writes and reads no checkpoints: it has no HDF5",
                         "give --checkpoint-every 0 and let the run end in one go, or run it on Linux");
}

}  // namespace

std::string sealed_checkpoint(std::string_view) { refuse(); }

std::string checkpoint_bytes(const CheckpointOrigin&, const RunState&) { refuse(); }

Checkpoint checkpoint_of(std::string_view, const fs::path&) { refuse(); }

fs::path checkpoint_file(const fs::path& folder) { return folder / "checkpoint.h5"; }
fs::path previous_checkpoint_file(const fs::path& folder) { return folder / "checkpoint.h5.previous"; }

void write_checkpoint(const fs::path&, const CheckpointOrigin&, const RunState&) { refuse(); }

FoundCheckpoint read_checkpoint(const fs::path&, const std::string&) { refuse(); }

void remove_checkpoints(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& file : {checkpoint_file(folder), previous_checkpoint_file(folder)}) fs::remove(file, ignored);
}

}  // namespace railstrata
