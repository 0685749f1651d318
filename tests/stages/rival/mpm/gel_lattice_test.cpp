// Particles of the gel: how many, where, and the front they carry.
#include "stages/rival/mpm/gel_lattice.h"

#include <gtest/gtest.h>

#include <numbers>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace gel_lattice_test {

GelShape disc(double radius_m, double thickness_m) {
  return {.outline = GelShape::Outline::disc, .radius_m = radius_m, .thickness_m = thickness_m};
}

TEST(GelLattice, PublishedBlock) {
  const GelLattice lattice = make_gel_lattice(
      {.counts = std::array{101, 101, 21}, .spacing_m = 0.2e-3, .on_faces = true, .fixed_layers = 3}, disc(1.0, 1.0));
  EXPECT_EQ(lattice.rest_m.rows(), 214221);
  EXPECT_LT((lattice.rest_m.colwise().minCoeff() - Eigen::RowVector3d(-0.01, -0.01, -0.004)).norm(), 1e-15);
  EXPECT_LT((lattice.rest_m.colwise().maxCoeff() - Eigen::RowVector3d(0.01, 0.01, 0.0)).norm(), 1e-15);
  EXPECT_EQ(lattice.first_of_top(), 20 * 101 * 101);
  EXPECT_NEAR(lattice.rest_m(3 * 101 * 101 - 1, 2), -3.6e-3, 1e-15) << "the third layer ends there";
}

TEST(GelLattice, InsideADiscTheVolumeIsTheGels) {
  const GelLattice lattice = make_gel_lattice({.spacing_m = 0.1e-3}, disc(5e-3, 1e-3));
  const double volume = static_cast<double>(lattice.rest_m.rows()) * 1e-12;
  EXPECT_NEAR(volume, std::numbers::pi * 25e-6 * 1e-3, 0.002 * volume);
  EXPECT_EQ(lattice.layers, 10);
  EXPECT_NEAR(lattice.rest_m.col(2).maxCoeff(), -0.05e-3, 1e-12);
  EXPECT_NEAR(lattice.rest_m.col(2).minCoeff(), -0.95e-3, 1e-12);
  EXPECT_NEAR(lattice.rest_m.col(0).sum(), 0.0, 1e-9);
  EXPECT_LE(lattice.rest_m.leftCols<2>().rowwise().norm().maxCoeff(), 5e-3 * (1.0 + 1e-8));
  for (int c = 0; c < lattice.num_columns(); ++c) {
    const auto [i, j] = lattice.columns[static_cast<std::size_t>(c)];
    EXPECT_EQ(lattice.at(i, j), c);
  }
  EXPECT_EQ(lattice.at(0, 0), -1);
  EXPECT_EQ(lattice.at(-1, 5), -1);
}

TEST(GelLattice, RectangleOnItsFaces) {
  const GelLattice lattice = make_gel_lattice(
      {.spacing_m = 0.5e-3, .on_faces = true},
      {.outline = GelShape::Outline::rectangle, .width_m = 4e-3, .height_m = 3e-3, .thickness_m = 1e-3});
  EXPECT_EQ(lattice.sides, (std::array{9, 7}));
  EXPECT_EQ(lattice.layers, 3);
  EXPECT_NEAR(lattice.rest_m(0, 0), -2e-3, 1e-15);
}

TEST(GelLattice, SaysWhatDoesNotFit) {
  EXPECT_EQ(message_of<DataError>([] { make_gel_lattice({.spacing_m = 0.3e-3}, disc(5e-3, 1e-3)); }),
            "the gel's thickness of 1 mm is not a multiple of the spacing of 0.3 mm");
  EXPECT_EQ(message_of<DataError>([] { make_gel_lattice({.spacing_m = 0.5e-3, .fixed_layers = 2}, disc(5e-3, 1e-3)); }),
            "the gel has 2 layers of particles; 2 are fixed");
  EXPECT_EQ(message_of<DataError>([] { make_gel_lattice({.spacing_m = 1e-3}, disc(0.6e-3, 1e-3)); }),
            "a spacing of 1 mm leaves 1 x 1 columns of particles; at least 2 x 2 are needed");
  GelShape dome = disc(5e-3, 1e-3);
  dome.dome_radius_m = 0.1;
  EXPECT_EQ(message_of<DataError>([&] { make_gel_lattice({.spacing_m = 0.5e-3}, dome); }),
            "the sensor's gel is domed; material points fill flat gels only");
}

TEST(Triangulate, LooksUpAndCoversTheGel) {
  const GelLattice lattice = make_gel_lattice({.spacing_m = 0.25e-3}, disc(3e-3, 1e-3));
  const Positions front = front_at_rest(lattice);
  EXPECT_EQ(front.col(2).cwiseAbs().maxCoeff(), 0.0);
  const Triangles triangles = triangulate(lattice, front);
  double area = 0.0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Vector3 a = front.row(triangles(t, 0)), b = front.row(triangles(t, 1)), c = front.row(triangles(t, 2));
    const double up = 0.5 * (b - a).cross(c - a).z();
    EXPECT_GT(up, 0.0);
    area += up;
  }
  // The outermost half spacing has no particles around it.
  EXPECT_GT(area, std::numbers::pi * 2.6e-3 * 2.6e-3);
  EXPECT_LT(area, std::numbers::pi * 3e-3 * 3e-3);
}

TEST(Triangulate, TakesTheDiagonalOfDelaunay) {
  const GelLattice lattice = make_gel_lattice({.counts = std::array{2, 2, 1}, .spacing_m = 1.0}, {});
  Positions front = front_at_rest(lattice);
  const int from = lattice.at(0, 0), to = lattice.at(1, 1);
  const auto cut_from_first = [&] {
    const Triangles triangles = triangulate(lattice, front);
    return (triangles.row(0).array() == from).any() && (triangles.row(0).array() == to).any() &&
           (triangles.row(1).array() == from).any() && (triangles.row(1).array() == to).any();
  };
  EXPECT_TRUE(cut_from_first()) << "a square can be cut either way";
  front.col(0) += 0.3 * front.col(1);  // the diagonal from the first corner becomes the longer one
  EXPECT_FALSE(cut_from_first());
  front.col(0) -= 0.6 * front.col(1);
  EXPECT_TRUE(cut_from_first());
}

}  // namespace gel_lattice_test
}  // namespace tacipc
