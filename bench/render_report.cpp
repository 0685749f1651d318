#include "bench/render_report.h"

#include <fmt/core.h>

namespace tacipc::bench {

std::string render_page(const std::vector<RenderCost>& costs, const SceneUpdate& update, const std::string& processor,
                        double load, unsigned cores) {
  std::string out = fmt::format(
      "# Cost of rendering\n\nMade by `make -f Makefile.data bench-render` on {}: the last frame of a press of "
      "`letter_a` into the MC-Tac gel, 640 × 480 pixels, eight LEDs on the ring of `configs/sensors/mctac.yaml`, light "
      "and camera rays refracted, with shadows, the coating's lobe, all maps and codes, without the files. Minimum of "
      "several runs; *CPU* is processor time on one thread. When it began, {:.1f} processes were running on {} cores. "
      "With more processes than cores wall times are unreliable.\n\n"
      "| Rendering | Rays per pixel | Light samples | CPU, ms | 1 thread, ms | 2 threads, ms | limit, ms "
      "|\n|---|---|---|---|---|---|---|\n",
      processor, load, cores);
  for (const RenderCost& cost : costs) {
    out += fmt::format("| {} | {} | {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n", cost.name,
                       cost.subpixels * cost.subpixels,
                       cost.lights * static_cast<std::size_t>(cost.led_samples * cost.led_samples), cost.processor_ms,
                       cost.one_thread_ms, cost.two_threads_ms, cost.must_ms);
  }
  out +=
      "\n## Tracing\n\nAll rays of one frame (with area lights of one of 160 × 120 pixels) are logged and traced again "
      "on one thread: through our packets (`common/optics/ray_scene.h`), and by bare loops over `rtcIntersect8` and "
      "`rtcOccluded8` on prepared arrays, with the same scene flags. *Share* is the share of our tracing in the whole "
      "frame on one thread.\n\n"
      "| Rendering | Camera rays | Shadow rays | Ours, Mrays/s | Embree, Mrays/s | of Embree | Share of the frame |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const RenderCost& cost : costs) {
    const double rays = cost.camera_rays + cost.shadow_rays;
    out += fmt::format("| {} | {:.0f} | {:.0f} | {:.1f} | {:.1f} | {:.0f} % (at least 60) | {:.0f} % |\n", cost.name,
                       cost.camera_rays, cost.shadow_rays, 1e-6 * rays / cost.traced_s, 1e-6 * rays / cost.embree_s,
                       100.0 * cost.of_embree(), 100.0 * cost.tracing_share());
  }
  out += fmt::format(
      "\n## Scene update\n\n{} triangles: vertices and normals {:.1f} ms, Embree's tree {:.1f} ms on one thread (the "
      "same tree at any number of threads); together {:.1f} ms (at most 10).\n",
      update.triangles, update.membrane_ms, update.tree_ms, update.membrane_ms + update.tree_ms);
  return out;
}

}  // namespace tacipc::bench
