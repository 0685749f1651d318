// What rendering costs, as a page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tacipc::bench {

/// One way to render, measured.
struct RenderCost {
  std::string name;
  std::size_t lights = 0;
  int subpixels = 1;
  int led_samples = 1;
  double processor_ms = 0.0;   // of a frame on one thread, whatever else runs on the machine
  double one_thread_ms = 0.0;  // a frame: rays, light, colours, codes; no files, no scene update
  double two_threads_ms = 0.0;
  double must_ms = 0.0;      // on two threads
  double camera_rays = 0.0;  // of the logged picture
  double shadow_rays = 0.0;
  double traced_s = 0.0;        // our way to Embree for those rays, one thread
  double embree_s = 0.0;        // Embree's own time for them
  double logged_frame_s = 0.0;  // the picture the rays were logged from, one thread

  double tracing_share() const { return traced_s / logged_frame_s; }
  double of_embree() const { return embree_s / traced_s; }
};

struct SceneUpdate {
  std::size_t triangles = 0;
  double membrane_ms = 0.0;  // vertices and normals of the next frame
  double tree_ms = 0.0;      // Embree's
};

/// `load` is the number of runnable processes of the last minute on `cores` cores: the more of them, the less wall
/// times say.
std::string render_page(const std::vector<RenderCost>& costs, const SceneUpdate& update, const std::string& processor,
                        double load, unsigned cores);

}  // namespace tacipc::bench
