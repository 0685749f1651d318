#include "common/format/npy_field.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace npy_field_test {

const NpyField kForce{.file = "force.npy", .type = NpyType::f8, .shape = {"frames", "#V", 2}, .unit = "N"};
const NpyField kCode{.file = "code.npy", .type = NpyType::u1, .shape = {"frames"}, .unit = "code"};
const NpyField kTime{.file = "time.npy", .type = NpyType::f8, .shape = {"#V"}, .unit = "s", .finite = false};

TEST(NpyField, ShapesShowWhatIsKnown) {
  EXPECT_EQ(shape_text(kForce), "(frames, #V, 2)");
  EXPECT_EQ(shape_text(kForce, {{"#V", 7}}), "(frames, 7, 2)");
  EXPECT_EQ(shape_text(kCode), "(frames,)");
}

TEST(NpyField, ASymbolIsOneNumberInAllArrays) {
  Extents known;
  match_shape(kForce, {3, 5, 2}, "a", known);
  EXPECT_EQ(known, (Extents{{"frames", 3}, {"#V", 5}}));
  match_shape(kTime, {5}, "t", known);
  const auto refused = [&](const NpyField& field, const std::vector<std::size_t>& shape) {
    return message_of<DataError>([&] { match_shape(field, shape, "b", known); });
  };
  EXPECT_EQ(refused(kTime, {4}), "b: has the shape (4,), expected (5,)");
  EXPECT_EQ(refused(kForce, {3, 5, 3}), "b: has the shape (3, 5, 3), expected (3, 5, 2)");
  EXPECT_EQ(refused(kForce, {3, 10}), "b: has the shape (3, 10), expected (3, 5, 2)");
}

TEST(NpyField, AShapeThatDoesNotFitTeachesNothing) {
  Extents known;
  EXPECT_THROW(match_shape(kForce, {3, 5, 9}, "a", known), DataError);
  EXPECT_TRUE(known.empty());
}

TEST(NpyField, WrittenValuesReadBackInTheDeclaredType) {
  const ScratchFolder folder;
  write_field(kForce, folder / "force.npy", {{"frames", 2}, {"#V", 1}}, {1.5, -0.0, 3.0, 4.0});
  write_field(kCode, folder / "code.npy", {{"frames", 2}}, {0.0, 200.0});
  Extents known;
  EXPECT_EQ(read_field(kForce, folder / "force.npy", known).data, (std::vector<double>{1.5, -0.0, 3.0, 4.0}));
  EXPECT_EQ(read_field(kCode, folder / "code.npy", known).data, (std::vector<double>{0.0, 200.0}));
  EXPECT_NE(read_file(folder / "code.npy").find("'|u1'"), std::string::npos);
  EXPECT_EQ(message_of<DataError>([&] { write_field(kForce, folder / "x.npy", known, {1.0}); }),
            (folder / "x.npy").string() + ": 1 values for the shape (2, 1, 2)");
}

TEST(NpyField, OnlyWhatMayBeInfiniteIs) {
  const ScratchFolder folder;
  const double infinity = std::numeric_limits<double>::infinity();
  write_field(kTime, folder / "time.npy", {{"#V", 2}}, {1.0, infinity});
  write_field(kForce, folder / "force.npy", {{"frames", 1}, {"#V", 2}}, {1.0, 2.0, infinity, 4.0});
  Extents known;
  EXPECT_EQ(read_field(kTime, folder / "time.npy", known).data[1], infinity);
  EXPECT_EQ(message_of<DataError>([&] { read_field(kForce, folder / "force.npy", known); }),
            (folder / "force.npy").string() + ": the value at [0, 1, 0] is not finite");
}

}  // namespace npy_field_test
}  // namespace tacipc
