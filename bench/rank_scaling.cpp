// The model of fem/rank_need.hpp for meshes that need not be made here: what ranks would need and gain, as a table in
// Markdown for docs/ranks.md. Nothing is measured.
//
// usage: rank_scaling CASE RATE ELEMENT_SIZE...   RATE: element steps a second of one rank; sizes with units: "1 mm"
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "core/faults.hpp"
#include "fem/rank_need.hpp"
#include "reader/case_file.hpp"

using namespace railstrata;

namespace {

void print_rows(const Model& model, const std::string& size, double rate) {
  const auto elements = static_cast<double>(model.rail.elements() + model.wheel.elements());
  const double step = elements / rate;
  for (int ranks : {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1000}) {
    const RankNeed need = rank_need(model, ranks);
    if (need.ranks < ranks) {
      fmt::print("| {} | {:.2f} | {} and more | | | | no more than {} pieces |\n", size, 1e-6 * elements, ranks,
                 need.tiles);
      break;
    }
    const double relative = relative_step_time(need, step);
    fmt::print("| {} | {:.2f} | {} | {:.1f} % | {:.1f} % | {:.2f} | {:.1f} |\n", size, 1e-6 * elements, ranks,
               100 * need.kept, 100 * need.largest_share, 1e-6 * need.bytes, 1 / relative);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: rank_scaling CASE RATE ELEMENT_SIZE...\n");
    return 2;
  }
  try {
    fmt::print("| elements of | million | ranks | lines of a rank | largest part | MB a step | times as fast |\n");
    fmt::print("|---|---|---|---|---|---|---|\n");
    for (int k = 3; k < argc; ++k) {
      const LoadedCase loaded = load_case(argv[1], {fmt::format("mesh.element_size=\"{}\"", argv[k])});
      print_rows(build_model(loaded.spec, loaded.folder()), argv[k], std::atof(argv[2]));
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
  return 0;
}
