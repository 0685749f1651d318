#include "stages/object/decimate/collapse_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "common/base/error.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace collapse_mesh_test {

using Library = OpenMesh::TriMesh_ArrayKernelT<CollapseTraits>;

CollapseMesh build(const TriangleMesh& mesh) {
  CollapseMesh out;
  std::vector<OpenMesh::Vec3d> points;
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v)
    points.push_back({mesh.positions(v, 0), mesh.positions(v, 1), mesh.positions(v, 2)});
  out.build(points, mesh.triangles);
  return out;
}

/// Faces that are left, each from its lowest corner on.
std::vector<std::array<int, 3>> faces(const Library& mesh) {
  std::vector<std::array<int, 3>> all;
  for (auto f = mesh.faces_sbegin(); f != mesh.faces_end(); ++f) {
    std::array<int, 3> corners{};
    int k = 0;
    for (auto v = mesh.cfv_iter(*f); v.is_valid(); ++v) corners[static_cast<std::size_t>(k++)] = v->idx();
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(CollapseMesh, HasTheFacesItIsBuiltFrom) {
  const TriangleMesh ball = sphere(1.0, 2);
  const CollapseMesh mesh = build(ball);
  ASSERT_EQ(mesh.n_faces(), static_cast<std::size_t>(ball.num_triangles()));
  EXPECT_EQ(mesh.n_edges(), mesh.n_faces() * 3 / 2);
  for (Eigen::Index f = 0; f < ball.num_triangles(); ++f) {
    auto corner = mesh.cfv_iter(mesh.face_handle(static_cast<unsigned>(f)));
    for (int k = 0; k < 3; ++k, ++corner) EXPECT_EQ(corner->idx(), ball.triangles(f, k));
  }
  for (const auto v : mesh.vertices()) EXPECT_GE(mesh.valence(v), 4u);
}

TEST(CollapseMesh, RefusesEdgesThatAreNotBetweenTwoFaces) {
  EXPECT_THROW(build(without_faces(sphere(1.0, 1), {3})), DataError);
  EXPECT_THROW(build(with_face_turned(sphere(1.0, 1), 3)), DataError);
}

TEST(CollapseMesh, RefusesAVertexWhereTwoSheetsMeet) {
  const TriangleMesh two{
      Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
      Triangles{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}}};
  EXPECT_THROW(build(two), DataError);
}

// Any edges in any order, down to where none may collapse: the same answers and the same faces as the library's own.
TEST(CollapseMesh, CollapsesAsTheLibraryDoes) {
  for (const TriangleMesh& shape : {sphere(1.0, 3), bumpy_torus(1.0, 0.3, 0.1, 12, 7)}) {
    CollapseMesh own = build(shape), theirs = own;
    std::mt19937 random(7);
    int collapsed = 0, refused = 0;
    for (int i = 0; i < 20000; ++i) {
      const OpenMesh::HalfedgeHandle h(static_cast<int>(random() % own.n_halfedges()));
      if (own.status(own.edge_handle(h)).deleted()) continue;
      const OpenMesh::VertexHandle from = own.from_vertex_handle(h), to = own.to_vertex_handle(h);
      const OpenMesh::HalfedgeHandle same = theirs.find_halfedge(from, to);  // handles part after collapses
      ASSERT_TRUE(same.is_valid());
      ASSERT_EQ(own.is_collapse_ok(h), theirs.Library::is_collapse_ok(same)) << from.idx() << " to " << to.idx();
      if (!own.is_collapse_ok(h) || own.n_vertices() - static_cast<std::size_t>(collapsed) <= 6) {
        ++refused;
        continue;
      }
      own.collapse(h);
      theirs.Library::collapse(same);
      ++collapsed;
      ASSERT_EQ(faces(own), faces(theirs)) << "after " << collapsed;
      for (auto v = own.cvv_iter(to); v.is_valid(); ++v) ASSERT_TRUE(own.find_halfedge(*v, to).is_valid());
    }
    EXPECT_GT(collapsed, 50);
    EXPECT_GT(refused, 50);
  }
}

}  // namespace collapse_mesh_test
}  // namespace tacipc
