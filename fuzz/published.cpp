// Tables of published numbers.
#include "study/published.hpp"

#include <cmath>

#include "reader.hpp"

using namespace railstrata;
using fuzz::promise;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::accepts([&] {
    const Published p = parse_published(std::string(fuzz::text_of(data, size)), "published.toml");
    for (const PublishedNumber& n : p.numbers)
      promise(std::isfinite(n.value) && std::isfinite(n.factor) && n.within >= 0, "published numbers are numbers");
    for (const PublishedClaim& c : p.claims)
      promise(std::isfinite(c.limit) && std::isfinite(c.factor), "limits are numbers");
  });
  return 0;
}
