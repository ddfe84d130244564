#include "io/checkpoint_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/faults.hpp"
#include "io/provenance.hpp"
#include "record/output_file.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
using Damage = CheckpointDamage;

constexpr std::size_t kHeader = 512;  // HDF5 looks for its superblock at 0, 512, 1024, …

/// The first kHeader bytes of a file with this image.
std::string header_of(std::string_view image, int format = kCheckpointFormat) {
  std::string text = fmt::format(
      "RailStrata checkpoint\nformat {}\nbytes {}\nsha256 {}\nHDF5 from byte {} on; go on with: railstrata run "
      "--resume <this folder>\n",
      format, image.size(), sha256_of(image), kHeader);
  text.resize(kHeader, ' ');
  text.back() = '\n';
  return text;
}

/// The number of a format that is read. Throws Damage for any other.
int readable_format(std::string_view format) {
  int number = 0;
  const auto [end, error] = std::from_chars(format.data(), format.data() + format.size(), number);
  if (error != std::errc{} || end != format.data() + format.size())
    throw Damage{fmt::format("its format is {}, this program's is {}", format.substr(0, 20), kCheckpointFormat)};
  if (number >= kOldestCheckpointFormat && number <= kCheckpointFormat) return number;
  throw Damage{fmt::format("it was written by {} RailStrata (its format is {}, this program's is {})",
                           number < kCheckpointFormat ? "an older" : "a newer", number, kCheckpointFormat),
               "start the run anew with --force, or go on with the program that wrote it"};
}

/// Throws Damage unless every byte is as it was written.
void verify(std::string_view bytes) {
  constexpr std::string_view kStart = "RailStrata checkpoint\nformat ";
  if (bytes.empty()) throw Damage{"it is empty"};
  if (!bytes.starts_with(kStart)) throw Damage{"it does not begin like a checkpoint"};
  if (bytes.size() <= kHeader) throw Damage{"it is cut off"};
  const std::string_view header = bytes.substr(0, kHeader);
  const int format = readable_format(header.substr(kStart.size(), header.find('\n', kStart.size()) - kStart.size()));
  if (header != header_of(bytes.substr(kHeader), format))
    throw Damage{"its checksum does not agree with its bytes: it is cut off or was changed"};
}

/// At the end of what asks HDF5 for memory.
struct GivesMemoryBack {
  ~GivesMemoryBack() { give_memory_back(); }
};

std::string read_bytes(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw Damage{"it is not a file"};  // a pipe would be waited for
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  if (!in) throw Damage{std::strerror(errno)};
  bytes << in.rdbuf();
  return std::move(bytes).str();
}

}  // namespace

std::string sealed_checkpoint(std::string_view image) { return header_of(image).append(image); }

std::string checkpoint_bytes(const CheckpointOrigin& origin, const RunState& run, const std::string& name) {
  try {
    std::string bytes = checkpoint_image(origin, run, kHeader);
    header_of(std::string_view(bytes).substr(kHeader)).copy(bytes.data(), kHeader);
    return bytes;
  } catch (const Damage& d) {
    throw EnvironmentError(
        fmt::format("cannot make {}: {}", name, d.what),
        "free memory; `railstrata run --resume` goes on from the checkpoint before it, if there is one");
  }
}

Checkpoint checkpoint_of(std::string_view bytes, const fs::path& file) {
  try {
    verify(bytes);
    return checkpoint_of_image(bytes.substr(kHeader));
  } catch (const Damage& d) {
    throw CaseError(fmt::format("this checkpoint cannot be used: {}", d.what), d.remedy, file.string());
  }
}

fs::path checkpoint_file(const fs::path& folder) { return folder / "checkpoint.h5"; }
fs::path previous_checkpoint_file(const fs::path& folder) { return folder / "checkpoint.h5.previous"; }

void write_checkpoint(const fs::path& folder, const CheckpointOrigin& origin, const RunState& run) {
  const GivesMemoryBack at_the_end;
  const fs::path file = checkpoint_file(folder);
  write_whole_file(file, checkpoint_bytes(origin, run, file.string()), previous_checkpoint_file(folder));
}

FoundCheckpoint read_checkpoint(const fs::path& folder, const std::string& case_sha256) {
  const GivesMemoryBack at_the_end;
  FoundCheckpoint found;
  std::string remedy;  // of the newest
  for (const fs::path& file : {checkpoint_file(folder), previous_checkpoint_file(folder)}) {
    if (!fs::exists(file)) continue;
    std::optional<Checkpoint> checkpoint;
    const auto note = [&](const std::string& what, const std::string& what_to_do) {
      found.notes.push_back(fmt::format("{}: {}", file.string(), what));
      if (remedy.empty()) remedy = what_to_do;
    };
    try {
      checkpoint = checkpoint_of(read_bytes(file), file);
    } catch (const Damage& d) {
      note(d.what, d.remedy);
    } catch (const CaseError& e) {
      note(e.diagnostics.front().message, e.diagnostics.front().remedy);
    }
    if (!checkpoint) continue;
    if (checkpoint->origin.case_sha256 != case_sha256)
      throw CaseError("this checkpoint belongs to another case: the folder's case.toml or a profile was changed since",
                      "restore the old files, or start the new case in its own folder", file.string());
    found.checkpoint = std::move(*checkpoint);
    return found;
  }
  if (found.notes.empty())
    throw CaseError(fmt::format("there is nothing to resume in {}: it has no checkpoint", folder.string()),
                    "start the run again; runs write a checkpoint every ten minutes (--checkpoint-every) and when they "
                    "are stopped while rolling");
  std::vector<Diagnostic> all;
  for (const std::string& note : found.notes) all.push_back({"", note, ""});
  all.back().remedy = remedy;
  throw CaseError(all);
}

void remove_checkpoints(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().filename().string().starts_with("checkpoint.h5")) fs::remove(entry.path(), ignored);
}

}  // namespace railstrata
