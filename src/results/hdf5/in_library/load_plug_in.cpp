// Replaces the room in librailstrata.so: its functions, which load the plug-in at the first call.
#include "hdf5/plug_in.hpp"

#if __has_include(<dlfcn.h>)
#include <dlfcn.h>
#endif
#include <fmt/format.h>

#include <atomic>

#include "core/faults.hpp"

namespace railstrata {
namespace {

#ifdef RAILSTRATA_HDF5_PLUG_IN
constexpr const char* kPlugIn = RAILSTRATA_HDF5_PLUG_IN;

/// The loader looks beside this library, and takes the file for the processor as it took this library.
const Hdf5PlugIn* loaded() {
  void* const library = dlopen(kPlugIn, RTLD_NOW | RTLD_LOCAL);
  void* const symbol = library == nullptr ? nullptr : dlsym(library, "railstrata_hdf5_plug_in");
  if (symbol != nullptr) return static_cast<const Hdf5PlugIn*>(symbol);
  const char* const why = dlerror();
  throw EnvironmentError(fmt::format("cannot load {}: {}", kPlugIn, why == nullptr ? "no reason given" : why),
                         "checkpoints and creep-force tables need it beside librailstrata.so, and the HDF5 library");
}
#else
const Hdf5PlugIn* loaded() {
  throw EnvironmentError("this build has no HDF5, which checkpoints and creep-force tables need",
                         "use a build of RailStrata for Linux");
}
#endif

std::atomic<const Hdf5PlugIn*> found = nullptr;

const Hdf5PlugIn& plug_in() {
  if (found == nullptr) found = loaded();
  return *found;
}

}  // namespace

std::string checkpoint_image(const CheckpointOrigin& origin, const RunState& run, std::size_t room_before) {
  return plug_in().checkpoint_image(origin, run, room_before);
}

Checkpoint checkpoint_of_image(std::string_view image) { return plug_in().checkpoint_of_image(image); }

void give_memory_back() {
  if (const Hdf5PlugIn* const used = found) used->give_memory_back();
}

std::string table_image(const ForceTable& table, const TableRemarks& remarks) {
  return plug_in().table_image(table, remarks);
}

std::optional<ForceTable> table_in_file(const std::filesystem::path& file) { return plug_in().table_in_file(file); }

}  // namespace railstrata
