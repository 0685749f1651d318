// Where tests find measured data that the repository must not contain.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace tacipc {

/// The folder with the shared data: $TACIPC_SHARED, else ../shared beside the repository.
inline std::filesystem::path shared_root() {
  if (const char* set = std::getenv("TACIPC_SHARED")) return set;
  return std::filesystem::path(TACIPC_SOURCE_DIR).parent_path() / "shared";
}

}  // namespace tacipc

/// Sets `variable` to a path below the shared data. Skips the test, saying why, where that folder does not exist at
/// all; a folder that exists without the file is a failure, so that a wrong path cannot hide behind a skip.
#define TACIPC_SHARED_DATA(variable, relative)                                                              \
  const std::filesystem::path variable = tacipc::shared_root() / (relative);                                \
  if (!std::filesystem::exists(tacipc::shared_root()))                                                      \
    GTEST_SKIP() << "needs " << (relative) << " below " << tacipc::shared_root() << " (set TACIPC_SHARED)"; \
  ASSERT_TRUE(std::filesystem::exists(variable)) << (variable) << " is missing from the shared data"
