// Checkpoints as damage leaves them. First byte even: the file follows; odd: changes (place, place, value) of the bytes
// of a whole checkpoint.
#include "checkpoint_sample.hpp"
#include "reader.hpp"

using namespace railstrata;
using fuzz::promise;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string whole = [] {
    const std::string sample = fuzz::sample_checkpoint();
    promise(fuzz::accepts([&] { checkpoint_of(sample, "checkpoint.h5"); }), "a whole checkpoint is taken");
    return sample;
  }();
  if (size == 0) return 0;
  const std::string_view rest = fuzz::text_of(data + 1, size - 1);
  if (data[0] % 2 == 0) {
    fuzz::accepts([&] { checkpoint_of(rest, "checkpoint.h5"); });
    return 0;
  }
  std::string bytes = whole;
  const bool changed = fuzz::change(bytes, fuzz::Bytes(rest));
  promise(!(changed && fuzz::accepts([&] { checkpoint_of(bytes, "checkpoint.h5"); })), "every changed byte is found");
  return 0;
}
