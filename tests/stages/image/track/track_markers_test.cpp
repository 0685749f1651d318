#include "stages/image/track/track_markers.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "stages/image/track/agreement.h"
#include "stages/image/track/find_dots.h"
#include "stages/image/track/flow.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"
#include "tests/stages/image/track/drawn_dots.h"

namespace tacipc {
namespace track_markers_test {

constexpr int kWidth = 100, kHeight = 84;
constexpr double kPitch = 16.0, kRadius = 3.5;

TrackConfig config() { return {.least_diameter_px = 4, .most_diameter_px = 16}; }

/// Where a bump that is dragged along x takes a point: most near the middle.
Eigen::Vector2d dragged(const Eigen::Vector2d& p, double way) {
  const double r2 = (p - Eigen::Vector2d(50, 42)).squaredNorm();
  return p + way * std::exp(-r2 / 800.0) * Eigen::Vector2d(1.0, 0.3);
}

std::vector<Eigen::Vector2d> places(double way) {
  std::vector<Eigen::Vector2d> centers;
  for (const Eigen::Vector2d& p : dot_grid(5, 6, kPitch, {10.4, 10.2})) centers.push_back(dragged(p, way));
  return centers;
}

/// Light that changes from frame to frame, as under a pressed object.
ByteImage photograph(double way) {
  return drawn_dots(kWidth, kHeight, places(way), kRadius, 0.1, [&](double x, double y) {
    return 0.35 + 0.1 * std::sin(0.05 * x + 0.2 * way) + 0.05 * std::cos(0.07 * y);
  });
}

TEST(TrackMarkers, FollowDotsOverMoreThanHalfTheirSpacing) {
  const auto tracks = track_markers(
      6, [](int f) { return photograph(2.5 * f); }, config(), std::nullopt);
  ASSERT_EQ(tracks.num_markers, 30);
  EXPECT_NEAR(tracks.rest_diameter_px, 2 * kRadius, 0.1);
  for (int f = 0; f < 6; ++f) {
    const auto known = places(2.5 * f);
    for (std::size_t m = 0; m < known.size(); ++m) {
      EXPECT_EQ(tracks.quality[static_cast<std::size_t>(f)][m], TrackQuality::center) << f << " " << m;
      EXPECT_LT((tracks.px[static_cast<std::size_t>(f)][m] - known[m]).norm(), 0.05) << f << " " << m;
    }
  }
}

TEST(TrackMarkers, AHiddenDotIsLostAndFoundAgain) {
  const auto image = [](int f) {
    auto centers = places(2.0 * f);
    if (f == 1) centers.erase(centers.begin() + 14);
    return drawn_dots(kWidth, kHeight, centers, kRadius, 0.1, even_light);
  };
  const auto tracks = track_markers(3, image, config(), std::nullopt);
  EXPECT_NE(tracks.quality[1][14], TrackQuality::center);
  EXPECT_EQ(tracks.quality[1][13], TrackQuality::center);
  ASSERT_EQ(tracks.quality[2][14], TrackQuality::center);
  EXPECT_LT((tracks.px[2][14] - places(4.0)[14]).norm(), 0.05);
}

TEST(TrackMarkers, StartSaysWhichAndInWhatOrder) {
  const std::vector<Eigen::Vector2d> start{
      places(0)[8], {98, 2}, places(0)[3] + Eigen::Vector2d(2, -1), Eigen::Vector2d::Constant(std::nan(""))};
  const auto tracks = track_markers(
      2, [](int f) { return photograph(2.0 * f); }, config(), start);
  ASSERT_EQ(tracks.num_markers, 4);
  EXPECT_LT((tracks.px[1][0] - places(2.0)[8]).norm(), 0.05);
  EXPECT_EQ(tracks.quality[0][1], TrackQuality::lost);
  EXPECT_LT((tracks.px[1][2] - places(2.0)[3]).norm(), 0.05);
  EXPECT_EQ(tracks.quality[1][3], TrackQuality::lost);
  const Agreement found = agreement(tracks, {places(0), places(2.0)});
  EXPECT_EQ(found.markers, 2);
  EXPECT_EQ(found.visible, 4);
  EXPECT_EQ(found.lost, 0);
  EXPECT_GT(found.max_px, 0.0);
  EXPECT_LT(found.max_px, 0.05);
  EXPECT_LE(found.mean_px, found.max_px);
  const std::string csv = tracks_csv(tracks, {0, 7});
  EXPECT_THAT(csv, ::testing::StartsWith("marker,frame,x_px,y_px,dx_px,dy_px,quality\n0,0,"));
  EXPECT_THAT(csv, ::testing::HasSubstr("\n1,7,,,,,0\n"));
}

TEST(TrackMarkers, WhatCannotBeTrackedIsSaid) {
  const auto empty = [](int) { return drawn_dots(kWidth, kHeight, {}, kRadius, 0.1, even_light); };
  EXPECT_EQ(message_of<DataError>([&] { track_markers(2, empty, config(), std::nullopt); }),
            "the first image shows no markers: no spots of 4 to 16 px that are darker by 0.3");
  const auto growing = [](int f) { return drawn_dots(kWidth, kHeight + f, places(0), kRadius, 0.1, even_light); };
  EXPECT_EQ(message_of<DataError>([&] { track_markers(2, growing, config(), std::nullopt); }),
            "image 1 is 100 x 85 pixels, those before 100 x 84");
}

TEST(Agreement, CountsWhatIsSeenButLost) {
  const std::vector<Eigen::Vector2d> at{{10, 10}, {20, 10}};
  const Eigen::Vector2d nowhere = Eigen::Vector2d::Constant(std::nan(""));
  const MarkerTracks tracks{.num_markers = 2,
                            .px = {at, {{12, 10}, nowhere}, {{14, 10}, {24, 10}}},
                            .quality = {{TrackQuality::center, TrackQuality::center},
                                        {TrackQuality::center, TrackQuality::lost},
                                        {TrackQuality::center, TrackQuality::flow}},
                            .rest_diameter_px = 4.0};
  const Agreement found = agreement(tracks, {at, {{12, 10}, {22, 10}}, {{14, 13}, nowhere}});
  EXPECT_EQ(found.markers, 2);
  EXPECT_EQ(found.visible, 5);
  EXPECT_EQ(found.lost, 1);
  EXPECT_DOUBLE_EQ(found.max_px, 3.0);
  EXPECT_DOUBLE_EQ(found.mean_px, 0.75);
}

TEST(Flow, FindsAShiftAndNothingBeyondTheImage) {
  const auto image = [](double shift) {
    auto centers = dot_grid(5, 6, kPitch, {10.4, 10.2});
    for (auto& c : centers) c.x() += shift;
    return drawn_dots(kWidth, kHeight, centers, kRadius, 0.1, even_light);
  };
  const auto moved = flow(image(0), image(3.0), {{42.4, 42.2}, {-40.0, 42.0}}, kPitch, config());
  ASSERT_TRUE(moved[0]);
  EXPECT_NEAR(moved[0]->x(), 45.4, 0.2);
  EXPECT_NEAR(moved[0]->y(), 42.2, 0.2);
  EXPECT_FALSE(moved[1]);
}

TEST(TrackConfig, ReadsItsKeys) {
  const auto read = config_from_text<TrackConfig>(
      "curve: linear\ndots: {least_diameter_px: 5, most_diameter_px: 9}\nflow: {levels: 0}\n", "t.yaml");
  EXPECT_EQ(read.curve, "linear");
  EXPECT_EQ(read.flow_levels, 0);
  EXPECT_EQ(read.flow_window_px, 21);
  EXPECT_EQ(faults_in<TrackConfig>("dots: {least_diameter_px: 5, most_diameter_px: 4}\n", "t.yaml"),
            std::vector<std::string>{"t.yaml:1:48: dots.most_diameter_px: 4 is outside [5, 500]"});
}

}  // namespace track_markers_test
}  // namespace tacipc
