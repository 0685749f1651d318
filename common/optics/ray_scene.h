// First triangle on a ray, and occlusion of segments (by Embree).
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "common/base/flush_denormals.h"
#include "common/base/types.h"

namespace tacipc {

/// Eight rays side by side, in single precision as the tracer takes them.
struct alignas(32) RayPacket {
  static constexpr int kSize = 8;
  using Lanes = std::array<float, kSize>;
  Lanes origin_x, origin_y, origin_z;
  Lanes direction_x, direction_y, direction_z;
  Lanes far;                // length of the segment in directions; rays ahead have none
  std::uint32_t valid = 0;  // bit i: ray i counts

  void set(int lane, const Vector3& origin, const Vector3& direction, double length) {
    origin_x[lane] = static_cast<float>(origin.x());
    origin_y[lane] = static_cast<float>(origin.y());
    origin_z[lane] = static_cast<float>(origin.z());
    direction_x[lane] = static_cast<float>(direction.x());
    direction_y[lane] = static_cast<float>(direction.y());
    direction_z[lane] = static_cast<float>(direction.z());
    far[lane] = static_cast<float>(length);
    valid |= 1u << lane;
  }
};

/// Triangles ready for rays. Built on one thread and queried in robust mode, so the answers depend neither on the
/// number of threads nor on rays that pass exactly through edges (a ray through a vertex may still slip through).
class RayScene {
 public:
  /// \throw DataError if Embree cannot be started or refuses the mesh.
  RayScene(const Positions& positions, const Triangles& triangles);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// The same triangles elsewhere: the next frame of a press. \pre as many vertices as before
  void move(const Positions& positions);

  /// Index of the nearest triangle ahead of each valid ray, whichever side it shows; −1 for none.
  std::array<int, RayPacket::kSize> first_hits(const RayPacket& rays) const;

  /// Bit i is set if something lies on the segment of valid ray i.
  std::uint32_t blocked(const RayPacket& rays) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace tacipc
