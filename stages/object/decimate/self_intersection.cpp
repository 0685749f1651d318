#include "stages/object/decimate/self_intersection.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <thread>

#include "common/base/log.h"
#include "common/mesh/exact_predicates.h"
#include "common/mesh/triangle_tree.h"
#include "stages/object/decimate/surface_topology.h"

namespace tacipc {
namespace {

constexpr int kFacesPerChunk = 64;  // faces per chunk; results are joined in the order of chunks

/// Reports the number of finished chunks in steps of a hundredth. Only the thread that created it writes messages.
class ChunkProgress {
 public:
  explicit ChunkProgress(int chunks) : chunks_(chunks) {}
  void one_more() {
    const int done = ++done_;
    if (std::this_thread::get_id() != speaker_ || done < next_) return;
    next_ = done + std::max(1, chunks_ / 100);
    const double fraction = static_cast<double>(done) / chunks_;
    show_progress(fraction, fmt::format("{:.0f} % of the faces searched for crossings", 100.0 * fraction));
  }

 private:
  int chunks_;
  std::atomic<int> done_ = 0;
  int next_ = 0;
  std::thread::id speaker_ = std::this_thread::get_id();
};

/// Lowest vertex at the position of each vertex.
std::vector<int> lowest_at_place(const Positions& positions) {
  std::vector<int> order(positions.rows());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) { return std::array{positions(v, 0), positions(v, 1), positions(v, 2)}; };
  std::ranges::sort(order, [&](int a, int b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::vector<int> lowest(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    lowest[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? lowest[order[i - 1]] : order[i];
  return lowest;
}

bool cross(const TriangleMesh& mesh, const std::vector<int>& place, int first, int second) {
  std::array<int, 3> a, b;
  TrianglePoints p, q;
  for (int k = 0; k < 3; ++k) {
    a[k] = place[mesh.triangles(first, k)];
    b[k] = place[mesh.triangles(second, k)];
    p[k] = corner(mesh, first, k);
    q[k] = corner(mesh, second, k);
  }
  return mesh_triangles_intersect(a, p, b, q);
}

}  // namespace

std::vector<FacePair> self_intersections(const TriangleMesh& mesh) {
  const int num_faces = static_cast<int>(mesh.num_triangles());
  if (num_faces == 0) return {};
  const TriangleTree tree(mesh);
  const std::vector<int> place = lowest_at_place(mesh.positions);
  const int num_chunks = (num_faces + kFacesPerChunk - 1) / kFacesPerChunk;
  std::vector<std::vector<FacePair>> found(num_chunks);
  ChunkProgress progress(num_chunks);
  tbb::parallel_for(0, num_chunks, [&](int chunk) {
    for (int f = chunk * kFacesPerChunk; f < std::min(num_faces, (chunk + 1) * kFacesPerChunk); ++f)
      tree.overlaps(tree.box_of(f), [&](int other) {
        if (other > f && cross(mesh, place, f, other)) found[chunk].push_back({f, other});
      });
    progress.one_more();
  });
  std::vector<FacePair> pairs;
  for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
  std::ranges::sort(pairs, [](const FacePair& a, const FacePair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  return pairs;
}

}  // namespace tacipc
