// Runs every kept input through a target, then mutations of them: the same ones on every machine. usage:
// [FUZZ_KEEP=FILE] fuzz_<reader> FOLDER [MUTATIONS]
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "reader.hpp"

namespace {

using Input = std::vector<std::uint8_t>;

Input input_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// One to four flips, cuts and repeated pieces.
Input mutation(Input bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1)); };
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t begin = below(bytes.size()), length = 1 + below(std::min<std::size_t>(bytes.size() - begin, 40));
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(begin),
               last = first + static_cast<std::ptrdiff_t>(length);
    switch (below(4)) {
      case 0:
        *first = static_cast<std::uint8_t>(*first ^ (1u << below(8)));
        break;
      case 1:
        *first = static_cast<std::uint8_t>(random());
        break;
      case 2:
        bytes.erase(first, last);
        break;
      default: {
        const Input piece(first, last);
        const auto to = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
        bytes.insert(to, piece.begin(), piece.end());
      }
    }
  }
  return bytes;
}

/// Keeps the input beside the program while it is at work, if asked to: the one that breaks it stays.
void run(const Input& input) {
  static const char* kept = std::getenv("FUZZ_KEEP");
  if (kept)
    std::ofstream(kept, std::ios::binary)
        .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: %s FOLDER [MUTATIONS]\n", argv[0]), 2;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Input> inputs;
  for (const auto& file : files) {
    std::fprintf(stderr, "%s\r", file.filename().c_str());  // the last line names the one that broke
    run(inputs.emplace_back(input_of(file)));
  }
  if (inputs.empty()) return std::fprintf(stderr, "%s holds no inputs\n", argv[1]), 2;
  const int mutations = argc > 2 ? std::atoi(argv[2]) : 3000;
  std::mt19937 random(1);
  for (int k = 0; k < mutations; ++k) run(mutation(inputs[static_cast<std::size_t>(k) % inputs.size()], random));
  std::printf("%zu kept inputs, %d mutations\n", inputs.size(), mutations);
}
