// The program for Windows has no HDF5: writing or reading a checkpoint throws.
#include "hdf5/checkpoint_image.hpp"

#include "core/faults.hpp"

namespace railstrata {
namespace {

[[noreturn]] void refuse() {
  throw EnvironmentError("the program for Windows writes and reads no checkpoints: it has no HDF5",
                         "give --checkpoint-every 0 and let the run end in one go, or run it on Linux");
}

}  // namespace

std::string checkpoint_image(const CheckpointOrigin&, const RunState&, std::size_t) { refuse(); }

Checkpoint checkpoint_of_image(std::string_view) { refuse(); }

void give_memory_back() {}

}  // namespace railstrata
