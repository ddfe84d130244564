#include "app/mpi_ranks.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/faults.hpp"
#include "record/this_process.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

int number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? 0 : std::atoi(text);
}

// Open MPI gives the number of ranks; srun with PMIx gives a rank, and Slurm the number of tasks.
bool started_among_ranks() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr) return number_in_environment("OMPI_COMM_WORLD_SIZE") > 1;
  return std::getenv("PMIX_RANK") != nullptr && number_in_environment("SLURM_NTASKS") > 1;
}

fs::path plug_in() {
  const fs::path program = program_file().parent_path();
  for (const fs::path& folder : {program, program / "../lib/railstrata"})
    if (fs::exists(folder / kRankPlugIn)) return folder / kRankPlugIn;
  throw EnvironmentError("this program was started as one of several ranks, but its plug-in for MPI is not here",
                         "install the package railstrata-mpi, or libopenmpi-dev and openmpi-bin and build it again; or "
                         "start it without mpirun");
}

RailstrataJoin join_function() {
  const fs::path file = plug_in();
  // global: Open MPI loads plug-ins of its own, which look for its symbols
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* const symbol = library == nullptr ? nullptr : dlsym(library, kJoinSymbol);
  if (symbol == nullptr) {
    const char* const why = dlerror();
    throw EnvironmentError(fmt::format("cannot load {}: {}", file.string(), why == nullptr ? "no reason given" : why),
                           "build it again with the MPI of this machine");
  }
  return reinterpret_cast<RailstrataJoin>(symbol);
}

void require(const char* trouble) {
  if (trouble != nullptr)
    throw EnvironmentError(trouble, "look for the message of the rank that ended first; checkpoints stay as they are");
}

// Ranks other than 0 wait here.
void wait_for_the_end() {
  constexpr unsigned kSeconds = 5;  // signals wake; what ends the others when rank 0 has ended comes sooner
  for (unsigned left = kSeconds; left > 0;) left = sleep(left);
}

void gather(void* context, double* all, const std::ptrdiff_t* sizes) {
  require(static_cast<const RailstrataRanks*>(context)->gather(all, sizes));
}

}  // namespace

MpiRanks::MpiRanks() {
  if (started_among_ranks()) require(join_function()(&joined_));
}

Ranks MpiRanks::ranks() { return {joined_.count, joined_.rank, &joined_, gather}; }

void MpiRanks::leave() {
  if (joined_.leave != nullptr) require(joined_.leave());
}

bool MpiRanks::any_asked(bool this_one) { return largest_of_all(ranks(), this_one ? 1 : 0) > 0; }

void MpiRanks::wait_for_rank_0() const {
  if (joined_.rank > 0) wait_for_the_end();
}

void refuse_ranks(const std::string& command) {
  if (started_among_ranks())
    throw CaseError(fmt::format("{} was started as several ranks, and shares no work among them", command),
                    "start it without mpirun; `run` shares one case among ranks, `study` its cases among processes");
}

void log_on_rank_0_only() {
  if (!started_among_ranks()) return;
  const bool by_mpirun = std::getenv("OMPI_COMM_WORLD_RANK") != nullptr;
  if (number_in_environment(by_mpirun ? "OMPI_COMM_WORLD_RANK" : "PMIX_RANK") > 0) wait_for_the_end();
}

void start_children_alone() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK"}) unsetenv(name);
}

}  // namespace railstrata
