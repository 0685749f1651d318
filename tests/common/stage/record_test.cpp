#include "common/stage/record.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace record_test {

class RecordTest : public ::testing::Test {
 protected:
  Record record(const std::string& text) { return Record::from_file(scratch_.file("press.yaml", text)); }
  std::string file() const { return (scratch_ / "press.yaml").string(); }
  ScratchFolder scratch_;
};

TEST_F(RecordTest, FindsWhatIsThereAndNothingElse) {
  const Record r =
      record("a: {b: 1.5e-05, n: 7, yes: true, word: x y}\nlist:\n  - {k: 1}\n  - {k: 2}\npair: [1, -2.5]\n");
  EXPECT_EQ(r.section("a").number("b"), 1.5e-5);
  EXPECT_EQ(r.section("a").count("n"), 7);
  EXPECT_EQ(r.section("a").flag("yes"), true);
  EXPECT_EQ(r.section("a").text("word"), "x y");
  EXPECT_EQ(r.numbers("pair", 2), (std::vector<double>{1, -2.5}));
  ASSERT_EQ(r.sections("list").size(), 2u);
  EXPECT_EQ(r.sections("list")[1].number("k"), 2.0);
  EXPECT_EQ(r.section("none").section("deeper").number("x"), std::nullopt);
  EXPECT_EQ(r.text("none"), std::nullopt);
  EXPECT_EQ(r.numbers("none", 2), std::nullopt);
  EXPECT_TRUE(r.sections("none").empty());
  EXPECT_EQ(r.range("pair"), std::pair(1.0, -2.5));
  EXPECT_EQ(r.section("a").range("b"), std::pair(1.5e-5, 1.5e-5));
  EXPECT_EQ(r.range("none"), std::nullopt);
}

TEST_F(RecordTest, NamesThePlaceOfWhatIsMissingOrOfTheWrongType) {
  const Record r = record("a: {b: many, n: -3, f: .nan, yes: 1}\nlist: [{k: x}]\npair: [1]\n");
  const auto said = [](auto&& look) { return message_of<DataError>(look); };
  EXPECT_EQ(said([&] { r.section("a").number("b"); }), file() + ": a.b: expected a number, found 'many'");
  EXPECT_EQ(said([&] { r.section("a").number("f"); }), file() + ": a.f: expected a number, found '.nan'");
  EXPECT_EQ(said([&] { r.section("a").count("n"); }), file() + ": a.n: expected a whole number from 0, found '-3'");
  EXPECT_EQ(said([&] { r.section("a").flag("yes"); }), file() + ": a.yes: expected true or false, found '1'");
  EXPECT_EQ(said([&] { r.numbers("pair", 2); }), file() + ": pair: expected a list of 2 numbers");
  EXPECT_EQ(said([&] { r.range("pair"); }), file() + ": pair: expected a list of 2 numbers");
  EXPECT_EQ(said([&] { r.section("a").range("b"); }), file() + ": a.b: expected a number, found 'many'");
  EXPECT_EQ(said([&] { r.sections("list")[0].number("k"); }), file() + ": list[0].k: expected a number, found 'x'");
  EXPECT_EQ(said([&] { r.section("a").required_number("z"); }), file() + ": a.z: missing");
  EXPECT_EQ(said([&] { r.section("none").required_flag("z"); }), file() + ": none.z: missing");
}

}  // namespace record_test
}  // namespace tacipc
