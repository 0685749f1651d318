// Protection against libraries that crash on some damaged files: stages that call them work in a child process, whose
// crash becomes an error.
#pragma once

#include <optional>
#include <string>

namespace tacipc {

/// Marks a call during which a library reads a file and may crash or hang. In a process that continue_in_child() made,
/// the call is limited to 60 seconds and 2 GiB; in other processes the object does nothing.
class FragileCall {
 public:
  FragileCall(const char* library, const std::string& file);
  ~FragileCall();
  FragileCall(const FragileCall&) = delete;
  FragileCall& operator=(const FragileCall&) = delete;
};

/// End of a child process.
struct ChildEnd {
  int code = 1;            // exit code
  std::string crash = {};  // "FILE: libhdf5 crashed while reading it: …"; empty if it exited
};

/// Continues in a child process, which ends with its parent. If another process kills the child, the parent ends in the
/// same way.
/// \pre the process has one thread
/// \return nothing in the child; in the parent, once the child has ended, how it ended
std::optional<ChildEnd> continue_in_child();

}  // namespace tacipc
