// Which triangle a ray meets first, and whether anything blocks a segment (Embree behind it).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "common/types.h"

namespace tacipc {

struct Ray {
  Vector3 origin;
  Vector3 direction;  // unit
};

/// Triangles ready for rays. Built on one thread and queried in robust mode, so the answers depend neither on the
/// number of threads nor on rays that pass exactly through edges (a ray through a vertex may still slip through).
class RayScene {
 public:
  static constexpr int kPacket = 8;

  /// \throw DataError if Embree cannot be started or refuses the mesh.
  RayScene(const Positions& positions, const Triangles& triangles);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Index of the nearest triangle ahead, whichever side it shows.
  std::optional<int> first_hit(const Ray& ray) const;

  /// Bit i is set if something lies on the open segment from `origin` to `ends[i]`, i < count ≤ kPacket.
  std::uint32_t blocked(const Vector3& origin, const std::array<Vector3, kPacket>& ends, int count) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  double lowest_z_;
};

/// While it lives, denormal numbers count as zero on this thread: Embree needs that for speed.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned int before_;
};

}  // namespace tacipc
