#include <gtest/gtest.h>

#include "io/output_folder.hpp"
#include "reader/case_file.hpp"

namespace railstrata {

// A checkpoint of a card is one of the processor: a run may go on elsewhere.
TEST(CaseIdentity, IsThatOfEveryDeviceAndOfNoOtherCase) {
  const auto identity = [](const char* text) { return case_identity(parse_case(text, "a.toml")); };
  EXPECT_EQ(identity("[run]\ndevice = \"gpu\"\n"), identity("[run]\ndevice = \"cpu\"\n"));
  EXPECT_NE(identity("[run]\nprecision = \"single\"\n"), identity(""));
}

}  // namespace railstrata
