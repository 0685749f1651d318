#include "stages/gel/press/energy/tet_clusters.h"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <set>
#include <tuple>

namespace tacipc {
namespace {

/// Neighbour across the face opposite each corner; −1 at the boundary.
using FaceNeighbours = std::vector<std::array<int, 4>>;

FaceNeighbours face_neighbours(const Tetrahedra& tets) {
  struct Side {
    std::array<int, 3> face;
    int tet, corner;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve(4 * static_cast<std::size_t>(tets.rows()));
  for (int t = 0; t < tets.rows(); ++t) {
    for (int corner = 0; corner < 4; ++corner) {
      std::array<int, 3> face;
      for (int k = 0; k < 3; ++k) face[k] = tets(t, (corner + 1 + k) % 4);
      std::sort(face.begin(), face.end());
      sides.push_back({face, t, corner});
    }
  }
  std::sort(sides.begin(), sides.end());
  FaceNeighbours out(static_cast<std::size_t>(tets.rows()), {-1, -1, -1, -1});
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &a = sides[i - 1], &b = sides[i];
    if (a.face != b.face) continue;
    out[a.tet][a.corner] = b.tet;
    out[b.tet][b.corner] = a.tet;
  }
  return out;
}

/// Grows clusters one after the other.
class Growth {
 public:
  Growth(const Tetrahedra& tets, const FaceNeighbours& neighbours)
      : tets_(tets), neighbours_(neighbours), cluster_of_(neighbours.size(), -1), closed_(neighbours.size()) {
    for (int t = 0; t < tets.rows(); ++t) {
      closed_[t] = static_cast<int>(std::count(neighbours[t].begin(), neighbours[t].end(), -1));
      seeds_[closed_[t]].push(t);
    }
  }

  TetClusters run(int size) {
    TetClusters clusters;
    for (int next = next_seed(); next >= 0; next = next_seed()) {
      std::vector<int> cluster, reach;  // `reach`: free neighbours of the cluster
      Uses uses;
      while (true) {
        take(next, static_cast<int>(clusters.size()));
        cluster.push_back(next);
        for (int k = 0; k < 4; ++k) add_use(tets_(next, k), uses);
        std::erase(reach, next);
        for (const int t : neighbours_[next]) {
          if (t >= 0 && cluster_of_[t] < 0 && std::find(reach.begin(), reach.end(), t) == reach.end())
            reach.push_back(t);
        }
        if (static_cast<int>(cluster.size()) == size || reach.empty()) break;
        next = best(reach, uses);
      }
      std::sort(cluster.begin(), cluster.end());
      clusters.push_back(std::move(cluster));
    }
    return clusters;
  }

 private:
  using Uses = std::vector<std::pair<int, int>>;  // vertices of a cluster, and the number of its tetrahedra at each

  static void add_use(int vertex, Uses& uses) {
    for (auto& [v, count] : uses) {
      if (v == vertex) {
        ++count;
        return;
      }
    }
    uses.push_back({vertex, 1});
  }

  /// The first free tetrahedron with the most closed faces; −1 if none is free.
  int next_seed() {
    for (auto level = seeds_.rbegin(); level != seeds_.rend(); ++level) {
      for (; !level->empty(); level->pop()) {
        const int t = level->top();
        if (cluster_of_[t] < 0 && closed_[t] == static_cast<int>(seeds_.rend() - level) - 1) return t;
      }
    }
    return -1;
  }

  void take(int t, int cluster) {
    cluster_of_[t] = cluster;
    for (const int n : neighbours_[t]) {
      if (n >= 0 && cluster_of_[n] < 0) seeds_[++closed_[n]].push(n);
    }
  }

  int best(const std::vector<int>& reach, const Uses& uses) const {
    std::tuple<int, int, int, int> least;
    bool first = true;
    for (const int t : reach) {
      int new_vertices = 0, shared = 0;
      for (int k = 0; k < 4; ++k) {
        const auto found =
            std::find_if(uses.begin(), uses.end(), [&](const auto& use) { return use.first == tets_(t, k); });
        if (found == uses.end()) {
          ++new_vertices;
        } else {
          shared += found->second;
        }
      }
      const std::tuple score{new_vertices, -shared, -closed_[t], t};
      if (first || score < least) least = score;
      first = false;
    }
    return std::get<3>(least);
  }

  const Tetrahedra& tets_;
  const FaceNeighbours& neighbours_;
  std::vector<int> cluster_of_;
  std::vector<int> closed_;  // number of faces of a tetrahedron without a free neighbour
  /// Tetrahedra by their number of closed faces, lowest index first. Entries that are taken or have more closed faces
  /// by now are skipped when they are reached.
  std::array<std::priority_queue<int, std::vector<int>, std::greater<>>, 5> seeds_;
};

/// Joins clusters smaller than half of `size` to the neighbour that has the fewest tetrahedra.
void join_small(TetClusters& clusters, const FaceNeighbours& neighbours, int size) {
  std::vector<int> cluster_of(neighbours.size());
  for (std::size_t p = 0; p < clusters.size(); ++p) {
    for (const int t : clusters[p]) cluster_of[t] = static_cast<int>(p);
  }
  std::set<std::pair<std::size_t, int>> small;
  const auto is_small = [&](int p) { return 2 * static_cast<int>(clusters[p].size()) < size; };
  for (int p = 0; p < static_cast<int>(clusters.size()); ++p) {
    if (is_small(p)) small.insert({clusters[p].size(), p});
  }
  while (!small.empty()) {
    const int p = small.begin()->second;
    small.erase(small.begin());
    std::pair<std::size_t, int> host{0, -1};
    for (const int t : clusters[p]) {
      for (const int n : neighbours[t]) {
        if (n < 0 || cluster_of[n] == p) continue;
        const std::pair<std::size_t, int> candidate{clusters[cluster_of[n]].size(), cluster_of[n]};
        if (host.second < 0 || candidate < host) host = candidate;
      }
    }
    if (host.second < 0) continue;
    small.erase(host);
    std::vector<int>& into = clusters[host.second];
    for (const int t : clusters[p]) {
      cluster_of[t] = host.second;
      into.push_back(t);
    }
    std::sort(into.begin(), into.end());
    clusters[p].clear();
    if (is_small(host.second)) small.insert({into.size(), host.second});
  }
  std::erase_if(clusters, [](const std::vector<int>& cluster) { return cluster.empty(); });
}

}  // namespace

TetClusters make_tet_clusters(const Tetrahedra& tets, int size) {
  const FaceNeighbours neighbours = face_neighbours(tets);
  TetClusters clusters = Growth(tets, neighbours).run(size);
  join_small(clusters, neighbours, size);
  return clusters;
}

}  // namespace tacipc
