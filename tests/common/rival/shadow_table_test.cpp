#include "common/rival/shadow_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/error.h"
#include "common/format/npy.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace shadow_table_test {

TEST(ShadowTable, ListsEndAtTheirFirstZero) {
  const ScratchFolder scratch;
  std::vector<double> codes(3 * 63 * 2 * 4, 0.0);
  const std::size_t at = ((1 * 63 + 62) * 2 + 1) * 4;  // green, the last direction, the second depth
  codes[at] = -20.0;
  codes[at + 1] = -12.5;
  codes[at + 3] = -99.0;  // behind the end
  write_npy(scratch / "shadows.npy", {3, 63, 2, 4}, codes.data());
  const ShadowTable table = ShadowTable::read(scratch / "shadows.npy");
  EXPECT_THAT(table.list(1, 62, 1), testing::ElementsAre(-20.0, -12.5));
  EXPECT_TRUE(table.list(1, 62, 0).empty());
  EXPECT_TRUE(table.list(2, 0, 0).empty());
}

TEST(ShadowTable, OtherArraysAreRefused) {
  const ScratchFolder scratch;
  std::vector<double> codes(3 * 63 * 2, -1.0);
  const auto message = [&](const std::vector<std::size_t>& shape) {
    write_npy(scratch / "s.npy", shape, codes.data());
    return message_of<DataError>([&] { ShadowTable::read(scratch / "s.npy"); });
  };
  EXPECT_THAT(message({3, 63, 2}), testing::EndsWith("s.npy: is no table of 3 x 63 x depths x steps"));
  EXPECT_THAT(message({3, 21, 3, 2}), testing::HasSubstr("is no table"));
  codes[7] = 2.0;
  EXPECT_THAT(message({3, 63, 1, 2}), testing::EndsWith("holds 2, expected darkenings of at most 0"));
  codes[7] = std::nan("");
  EXPECT_THAT(message({3, 63, 1, 2}), testing::HasSubstr("expected darkenings"));
}

}  // namespace shadow_table_test
}  // namespace tacipc
