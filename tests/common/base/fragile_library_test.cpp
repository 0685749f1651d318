#include "common/base/fragile_library.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>

namespace tacipc {
namespace fragile_library_test {

/// How a child ends that does this.
ChildEnd end_of(const std::function<void()>& work) {
  if (auto end = continue_in_child()) return *end;
  work();
  _exit(0);
}

void raise_by_default(int signal) {
  std::signal(signal, SIG_DFL);  // a sanitizer has handlers of its own
  raise(signal);
}

TEST(FragileLibrary, ExitCodesAreTheChilds) {
  for (const int code : {0, 1, 2, 3}) {
    const ChildEnd end = end_of([code] { _exit(code); });
    EXPECT_EQ(end.code, code);
    EXPECT_EQ(end.crash, "");
  }
}

TEST(FragileLibrary, ACrashDuringACallNamesLibraryAndFile) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) {
    const ChildEnd end = end_of([signal] {
      { const FragileCall done("libother", "a.obj"); }
      const FragileCall call("libhdf5", "some/shard.h5");
      raise_by_default(signal);
    });
    EXPECT_EQ(end.code, 1);
    EXPECT_EQ(end.crash, "some/shard.h5: libhdf5 crashed while reading it: the file is damaged");
  }
}

TEST(FragileLibrary, WhatBreaksLaterMayStillBeTheFiles) {
  const ChildEnd end = end_of([] {
    { const FragileCall call("libhdf5", "shard.h5"); }
    raise_by_default(SIGABRT);
  });
  EXPECT_EQ(end.crash, "shard.h5: crashed (Aborted) after libhdf5 had read it: the file may be damaged");
}

TEST(FragileLibrary, ACallHasALimitedTime) {
  const ChildEnd end = end_of([] {
    const FragileCall call("libhdf5", "shard.h5");
    const unsigned left_s = alarm(1);
    if (left_s < 55 || left_s > 60) _exit(9);
    while (true) pause();
  });
  EXPECT_EQ(end.crash, "shard.h5: libhdf5 was not done after 60 s: the file is damaged");
  EXPECT_EQ(end_of([] {
              { const FragileCall call("libhdf5", "shard.h5"); }
              _exit(alarm(0) == 0 ? 5 : 6);
            }).code,
            5);
}

#if !defined(__SANITIZE_ADDRESS__)
TEST(FragileLibrary, ACallHasALimitedMemory) {
  const auto can_take = [](std::size_t bytes) {
    void* const taken = std::malloc(bytes);
    std::free(taken);
    return taken != nullptr;
  };
  const ChildEnd end = end_of([&] {
    constexpr std::size_t kLarge = std::size_t{3} << 30;
    if (!can_take(kLarge)) _exit(5);
    {
      const FragileCall call("libhdf5", "shard.h5");
      if (can_take(kLarge)) _exit(6);
      if (!can_take(kLarge / 2)) _exit(7);
    }
    if (!can_take(kLarge)) _exit(8);
  });
  EXPECT_EQ(end.code, 0);
}
#endif

TEST(FragileLibrary, OutsideOfAChildNothingHappens) {
  const FragileCall call("libhdf5", "shard.h5");
  EXPECT_EQ(alarm(0), 0u);
}

}  // namespace fragile_library_test
}  // namespace tacipc
