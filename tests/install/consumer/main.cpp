// Another program that uses the library: solves a shipped layered case by half-spaces and receives an error.
#include <cmath>
#include <cstdio>

#include <railstrata/railstrata.hpp>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    railstrata::HalfSpaceSettings settings;
    settings.threads = 1;
    const railstrata::LoadedCase quick = railstrata::load_case(argv[1]);
    const railstrata::CaseResult result = railstrata::solve_by_half_spaces(quick, settings);
    double largest = 0;
    for (const double p : result.patch.p) largest = std::fmax(largest, p);
    std::printf("%s: p_max %.17g Pa, %d cells\n", railstrata::version_text().c_str(),
                result.summary.contact.patch.p_max, result.patch.size());
    // what `railstrata bem cases/quick` prints: 1146.0 MPa, the top of the parabola through the cells
    if (std::fabs(result.summary.contact.patch.p_max - 1145.97e6) > 0.01e6) return 1;
    if (std::fabs(largest - result.summary.contact.patch.p_max) > 1e6) return 1;
  } catch (const railstrata::CaseError& e) {
    std::printf("unexpected: %s\n", e.what());
    return 1;
  }
  try {
    railstrata::parse_case("[mesh]\nelement_size = 1\n", "wrong.toml");
  } catch (const railstrata::CaseError& e) {
    return e.diagnostics.size() == 1 ? 0 : 1;
  }
  return 1;
}
