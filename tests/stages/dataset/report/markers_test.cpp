#include "stages/dataset/report/markers.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/stages/dataset/report/sheared_folder.h"

namespace tacipc {
namespace markers_test {

namespace fs = std::filesystem;

class MarkersTest : public ::testing::Test {
 protected:
  MarkersTest() {
    fs::create_directories(press_);
    write_sheared_arrays(press_);
  }
  std::vector<MarkerPicture> pictures(const std::vector<int>& chosen, std::optional<int> press_end = 2) const {
    return read_marker_pictures(press_, 5, press_end, chosen);
  }
  std::string refused() const {
    return message_of<DataError>([&] { pictures({4}); });
  }

  ScratchFolder scratch_;
  fs::path press_ = scratch_ / "press";
};

TEST_F(MarkersTest, DisplacementIsFromRestAndFromTheEndOfThePress) {
  const auto all = pictures({2, 3, 4});
  ASSERT_EQ(all.size(), 4u);  // frames 2 and 4 since rest, 3 and 4 since the press
  EXPECT_EQ(all[0].frame, 2);
  EXPECT_FALSE(all[0].since_press);
  EXPECT_EQ(all[1].frame, 3);
  EXPECT_TRUE(all[1].since_press);
  EXPECT_EQ(all[2].frame, 4);
  EXPECT_FALSE(all[2].since_press);
  EXPECT_TRUE(all[3].since_press);

  const MarkerArrow rest = all[2].arrows.at(1), press = all[3].arrows.at(1);
  EXPECT_DOUBLE_EQ(rest.x_mm, 1.0);  // drawn from where it was at rest
  EXPECT_NEAR(rest.dx_mm, 0.01, 1e-12);
  EXPECT_NEAR(rest.dy_mm, 0.4, 1e-12);
  EXPECT_NEAR(press.x_mm, 1.01, 1e-12);  // and from where it was at the end of the press
  EXPECT_NEAR(press.dx_mm, 0.0, 1e-12);
  EXPECT_NEAR(press.dy_mm, 0.4, 1e-12);
}

TEST_F(MarkersTest, ContactsAreWhereTheirVerticesAre) {
  const auto all = pictures({1, 3, 4});
  EXPECT_TRUE(all[0].contacts.empty());
  ASSERT_EQ(all[1].contacts.size(), 2u);
  EXPECT_FALSE(all[1].contacts[0].slips);
  EXPECT_TRUE(all[1].contacts[1].slips);
  EXPECT_DOUBLE_EQ(all[1].contacts[1].x_mm, 1.0);
  EXPECT_DOUBLE_EQ(all[1].contacts[1].y_mm, 0.2);
  EXPECT_TRUE(all[2].contacts[0].slips);
}

TEST_F(MarkersTest, WithoutAPressAllIsSinceRest) {
  for (const MarkerPicture& picture : pictures({2, 4}, std::nullopt)) EXPECT_FALSE(picture.since_press);
}

TEST_F(MarkersTest, NeitherMarkersNorContactsIsNoPicture) {
  fs::remove(press_ / "markers.npy");
  EXPECT_EQ(pictures({4}).front().arrows.size(), 0u);
  EXPECT_EQ(pictures({4}).front().contacts.size(), 2u);
  fs::remove(press_ / "contact_state.npy");
  EXPECT_TRUE(pictures({4}).empty());
  const double none = 0;
  write_npy(press_ / "markers.npy", {5, 0, 3}, &none);
  write_npy(press_ / "marker_displacement.npy", {5, 0, 2, 3}, &none);
  EXPECT_TRUE(pictures({4}).empty());
}

TEST_F(MarkersTest, ArraysThatDoNotFitAreRefused) {
  const std::vector<double> zeros(200, 0.0);
  write_npy(press_ / "marker_displacement.npy", {5, 3, 2, 3}, zeros.data());
  EXPECT_EQ(refused(),
            (press_ / "marker_displacement.npy").string() + ": has the shape (5, 3, 2, 3), expected (5, 2, 2, 3)");
  write_npy(press_ / "markers.npy", {4, 2, 3}, zeros.data());
  EXPECT_EQ(refused(), (press_ / "markers.npy").string() + ": has the shape (4, 2, 3), expected (5, #M, 3)");
  write_sheared_arrays(press_);
  const std::vector<double> outside{1, 4};
  write_npy(press_ / "front_vertices.npy", {2}, outside.data());
  EXPECT_EQ(refused(), (press_ / "front_vertices.npy").string() + ": 4 is not a row of positions.npy");
  write_sheared_arrays(press_);
  const std::vector<double> bad(60, std::numeric_limits<double>::quiet_NaN());
  write_npy(press_ / "marker_displacement.npy", {5, 2, 2, 3}, bad.data());
  EXPECT_EQ(refused(),
            (press_ / "marker_displacement.npy").string() + ": frame 4: the value at [0, 0, 0] is not finite");
}

}  // namespace markers_test
}  // namespace tacipc
