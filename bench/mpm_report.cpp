#include "bench/mpm_report.h"

#include <fmt/core.h>

namespace tacipc::bench {

std::string mpm_page(const std::vector<MpmCost>& costs, double memory_bytes_per_s, const std::string& processor,
                     double load, unsigned cores) {
  std::string out = fmt::format(
      "# Cost of material points\n\nMade by `make -f Makefile.data bench-mpm` on {}: steps of the gel of "
      "`configs/sensors/mctac.yaml` while a star presses into it, with sorting, without files. Best of several runs, "
      "in millions of particles · steps per second; *CPU* is per processor second on one thread. When it began, {:.1f} "
      "processes were running on {} cores. With more processes than cores wall times are unreliable, and processor "
      "times include the sharing of caches and memory.\n\n"
      "One thread streams {:.1f} GB per second of processor time (a = b + s c over 128 MiB each, in the same run). "
      "*Limit* is that rate over the bytes that a particle moves in a step without caching: its own data, scattered, "
      "gathered and written, and its share of the grid's nodes, zeroed, added to, updated, read. A gel that fits in a "
      "cache can be faster.\n\n"
      "| Configuration | Particles | Nodes | Bytes per particle and step | Limit | CPU | of the limit | 1 thread | 2 "
      "threads | Cost of 1 mm |\n|---|---|---|---|---|---|---|---|---|---|\n",
      processor, load, cores, 1e-9 * memory_bytes_per_s);
  for (const MpmCost& cost : costs) {
    const double limit = memory_bytes_per_s / cost.bytes;
    out += fmt::format(
        "| {} | {} | {} | {:.0f} | {:.1f} | {:.1f} | {:.0f} % | {:.1f} | {:.1f} | {:.0f} steps of {:.3g} µs, {:.0f} s "
        "CPU |\n",
        cost.name, cost.particles, cost.nodes, cost.bytes, 1e-6 * limit, 1e-6 * cost.processor_rate,
        100.0 * cost.processor_rate / limit, 1e-6 * cost.one_thread_rate, 1e-6 * cost.two_threads_rate,
        cost.press_steps, 1e6 * cost.step_s,
        static_cast<double>(cost.particles) * cost.press_steps / cost.processor_rate);
  }
  return out;
}

}  // namespace tacipc::bench
