// Name, load and clocks of the machine that measures.
#pragma once

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "common/base/error.h"

namespace tacipc::bench {

/// Processor model as the kernel reports it.
inline std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "a processor without a name";
}

/// Mean number of processes that were ready to run in the last minute.
inline double load_average() {
  double load = 0.0;
  if (getloadavg(&load, 1) != 1) throw DataError("the kernel does not say how busy it is");
  return load;
}

/// Wall-clock time since an arbitrary start, s.
inline double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time of all threads of this process, s.
inline double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace tacipc::bench
