// Ray tracing by Embree: first triangle on a ray, and occlusion of segments.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "common/base/flush_denormals.h"
#include "common/base/types.h"

namespace tacipc {

/// Eight rays, in single precision as Embree takes them.
struct alignas(32) RayPacket {
  static constexpr int kSize = 8;
  using Lanes = std::array<float, kSize>;
  Lanes origin_x, origin_y, origin_z;
  Lanes direction_x, direction_y, direction_z;
  Lanes far;                // length of the segment in units of the direction; not used by first_hits()
  std::uint32_t valid = 0;  // bit i: ray i is traced

  /// Sets the ray of a lane and marks it valid.
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

/// Triangles prepared for ray queries. Built on one thread and queried in robust mode, so that results do not depend on
/// the number of threads, and rays through edges always hit (a ray exactly through a vertex may slip through).
class RayScene {
 public:
  /// Builds the scene.
  /// \throw DataError if Embree cannot be started or refuses the mesh
  RayScene(const Positions& positions, const Triangles& triangles);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Moves the vertices: the next frame of a press run.
  /// \pre as many vertices as before
  void move(const Positions& positions);

  /// Returns the index of the nearest triangle ahead of each valid ray, whichever side faces it; −1 for none.
  std::array<int, RayPacket::kSize> first_hits(const RayPacket& rays) const;

  /// Returns bits: bit i is set if anything lies on the segment of valid ray i.
  std::uint32_t blocked(const RayPacket& rays) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace tacipc
