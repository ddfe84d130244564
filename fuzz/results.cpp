// Results read back by compare, report and study: summary.json, then after a byte 1 patch.csv.
#include <cmath>

#include "io/result_folder.hpp"
#include "reader.hpp"

using namespace railstrata;
using fuzz::promise;

namespace {

void check(const ResultFolder& r) {
  const ContactField& f = r.field;
  promise(f.columns >= 2 && f.stations >= 1, "the patch is a grid");
  const std::size_t n = static_cast<std::size_t>(f.columns) * static_cast<std::size_t>(f.stations);
  for (const auto* values : {&f.x, &f.y, &f.z, &f.area, &f.p, &f.q_x, &f.q_y, &f.slip_x, &f.slip_y}) {
    promise(values->size() == n, "every quantity has a value at every point");
    for (const double v : *values) promise(std::isfinite(v), "values are finite");
  }
  promise(f.state.size() == n, "every point has a state");
  for (const ContactState s : f.state)
    promise(s == ContactState::separated || s == ContactState::stick || s == ContactState::slip,
            "states are known ones");
  for (const char* path : {"/contact/p_max_Pa", "/run/wall_seconds", "/checks/0/value", ""}) r.number(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view all = fuzz::text_of(data, size);
  const std::size_t cut = std::min(all.find('\1'), all.size());
  fuzz::accepts([&] {
    check(parse_results(std::string(all.substr(0, cut)), std::string(all.substr(std::min(cut + 1, all.size()))),
                        "folder"));
  });
  return 0;
}
