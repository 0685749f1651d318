// What material points cost, as a page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tacipc::bench {

/// One way to run the gel, measured while an object presses into it.
struct MpmCost {
  std::string name;
  std::size_t particles = 0;
  std::size_t nodes = 0;
  double step_s = 0.0;           // of the simulation
  double press_steps = 0.0;      // for 1 mm at the configured speed
  double bytes = 0.0;            // memory traffic per particle and step
  double processor_rate = 0.0;   // particles · steps per second of processor time, one thread
  double one_thread_rate = 0.0;  // … of wall time
  double two_threads_rate = 0.0;
};

/// `load` is the number of runnable processes of the last minute on `cores` cores.
std::string mpm_page(const std::vector<MpmCost>& costs, double memory_bytes_per_s, const std::string& processor,
                     double load, unsigned cores);

}  // namespace tacipc::bench
