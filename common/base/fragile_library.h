// Libraries that crash on some damaged files: stages that call them work in a child process, whose crash becomes an
// error.
#pragma once

#include <optional>
#include <string>

namespace tacipc {

/// While it lives, a library reads a file on which it may crash or hang. A process that continue_in_child made has 60
/// seconds and 2 GiB for that; in others nothing happens.
class FragileCall {
 public:
  FragileCall(const char* library, const std::string& file);
  ~FragileCall();
  FragileCall(const FragileCall&) = delete;
  FragileCall& operator=(const FragileCall&) = delete;
};

/// How a child process ended.
struct ChildEnd {
  int code = 1;            // its exit code
  std::string crash = {};  // "FILE: libhdf5 crashed while reading it: …"; empty if it exited
};

/// Goes on in a child process, which ends with its parent. Returns nothing there; in the parent, when the child has
/// ended, how. A child that somebody else killed ends the parent in the same way. \pre the process has one thread
std::optional<ChildEnd> continue_in_child();

}  // namespace tacipc
