// Runs independent work in threads, with errors as in a single thread.
#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>
#include <exception>
#include <vector>

namespace tacipc {

/// Calls `work` for each number below `count`, in parallel. If several calls fail, the error of the smallest number is
/// thrown, whichever thread was first.
template <typename Work>
void each_in_threads(std::size_t count, Work&& work) {
  std::vector<std::exception_ptr> failed(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    try {
      work(i);
    } catch (...) {
      failed[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failed)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace tacipc
