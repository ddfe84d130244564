#pragma once
// A small checkpoint and changes of its bytes, for both targets of checkpoints.
#include <string>
#include <string_view>

#include "io/checkpoint_file.hpp"

namespace railstrata::fuzz {

inline RunState sample_run() {
  RunState r;
  r.stepper.state.bodies[0].u = {0.1, -0.0, 5e-324};
  r.stepper.state.tractions = SurfaceTractions(1, 2);
  r.stepper.state.groups = {{0.5, -0.5}};
  r.stepper.facets.resize(1);
  r.result.history.resize(2);
  r.result.positions = {{0.3, {RollingSample{}}}};
  r.frame_times = {0, 1e-4};
  return r;
}

inline std::string sample_checkpoint() {
  return checkpoint_bytes({"a case", "a program", {"one", "two"}}, sample_run());
}

/// Bytes one after the other; 0 when there are no more.
class Bytes {
 public:
  explicit Bytes(std::string_view left) : left_(left) {}
  bool empty() const { return left_.empty(); }
  unsigned next() {
    if (left_.empty()) return 0;
    const unsigned byte = static_cast<unsigned char>(left_.front());
    left_.remove_prefix(1);
    return byte;
  }

 private:
  std::string_view left_;
};

inline bool change(std::string& bytes, Bytes in) {
  const std::string before = bytes;
  while (!in.empty()) {
    const unsigned low = in.next(), place = (low << 8 | in.next()) % static_cast<unsigned>(bytes.size());
    bytes[place] = static_cast<char>(in.next());
  }
  return bytes != before;
}

}  // namespace railstrata::fuzz
