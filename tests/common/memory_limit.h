// A limit to the memory that a test may take.
#pragma once

#include <sys/resource.h>

#include <cstddef>
#include <fstream>

namespace tacipc {

/// While it lives, allocations that would take this much more memory than the process has now fail: a reader that
/// trusts a count ends in bad_alloc instead of a DataError. None under the address sanitizer, which reserves terabytes
/// of address space and refuses large allocations itself.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::size_t bytes) {
    getrlimit(RLIMIT_AS, &before_);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit = before_;
    limit.rlim_cur = pages * 4096 + bytes;
#if !defined(__SANITIZE_ADDRESS__)
    setrlimit(RLIMIT_AS, &limit);
#endif
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace tacipc
