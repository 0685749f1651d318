#include "common/base/fragile_library.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <span>

namespace tacipc {
namespace {

constexpr unsigned kMostSeconds = 60;            // limit of one call
constexpr rlim_t kMostMemory = rlim_t{2} << 30;  // memory that one call may take, bytes

/// Last action of a child, in memory that its parent shares.
struct LastCall {
  std::array<char, 64> library{};
  std::array<char, 4096> file{};
  bool ended = false;
};
LastCall* last_call = nullptr;  // set in a child; null elsewhere
int said = -1, nowhere = -1;    // in a child: standard error, and a sink for a library's own last message
rlimit memory{};                // in a child: its limit outside calls

void say_to(int file) {
  if (file >= 0) dup2(file, STDERR_FILENO);
}

void copy_text(const std::string& text, std::span<char> to) {
  const std::size_t size = std::min(text.size(), to.size() - 1);
  std::memcpy(to.data(), text.data(), size);
  to[size] = '\0';
}

/// Limits further memory to kMostMemory.
void limit_memory() {
  std::array<char, 128> text{};
  const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  const bool is_read = read(file, text.data(), text.size() - 1) > 0;
  close(file);
  unsigned long pages = 0;  // data and stack
  if (!is_read || std::sscanf(text.data(), "%*u %*u %*u %*u %*u %lu", &pages) != 1) return;
  rlimit limit = memory;
  limit.rlim_cur = std::min(memory.rlim_cur, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kMostMemory);
  setrlimit(RLIMIT_DATA, &limit);
}

/// Prepares a child. A library's "double free" is suppressed in favour of this project's message. Messages of
/// sanitizers are kept, and their memory is not limited, because they reserve terabytes.
void begin_child() {
#if !defined(__SANITIZE_ADDRESS__)
  getrlimit(RLIMIT_DATA, &memory);
  said = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
  if (said >= 0) nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
#endif
}

bool is_crash(int signal) {
  constexpr std::array kCrashes{SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGSYS, SIGTRAP, SIGALRM};
  return std::ranges::find(kCrashes, signal) != kCrashes.end();
}

/// Returns the message for a crash.
/// \pre the signal is a crash
std::string crash_text(int signal, const LastCall& call) {
  const std::string file = call.file.data(), library = call.library.data();
  if (call.ended)
    return fmt::format("{}: crashed ({}) after {} had read it: the file may be damaged", file, strsignal(signal),
                       library);
  if (signal == SIGALRM)
    return fmt::format("{}: {} was not done after {} s: the file is damaged", file, library, kMostSeconds);
  return fmt::format("{}: {} crashed while reading it: the file is damaged", file, library);
}

}  // namespace

FragileCall::FragileCall(const char* library, const std::string& file) {
  if (!last_call) return;
  copy_text(library, last_call->library);
  copy_text(file, last_call->file);
  last_call->ended = false;
  say_to(nowhere);
  if (nowhere >= 0) limit_memory();
  alarm(kMostSeconds);
}

FragileCall::~FragileCall() {
  if (!last_call) return;
  alarm(0);
  if (nowhere >= 0) setrlimit(RLIMIT_DATA, &memory);
  say_to(said);
  last_call->ended = true;
}

std::optional<ChildEnd> continue_in_child() {
  void* shared = mmap(nullptr, sizeof(LastCall), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return ChildEnd{.crash = fmt::format("no child process: {}", std::strerror(errno))};
  auto* const call = new (shared) LastCall;
  std::fflush(nullptr);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) return ChildEnd{.crash = fmt::format("no child process: {}", std::strerror(errno))};
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // the parent ended before the signal was set up
    last_call = call;
    begin_child();
    return std::nullopt;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return ChildEnd{.crash = fmt::format("child process: {}", std::strerror(errno))};
  if (WIFEXITED(status)) return ChildEnd{.code = WEXITSTATUS(status)};
  const int signal = WTERMSIG(status);
  const bool has_read = call->file.front() != '\0';
  if (!has_read || !is_crash(signal)) {
    std::signal(signal, SIG_DFL);
    raise(signal);
  }
  return ChildEnd{.crash = has_read ? crash_text(signal, *call) : fmt::format("ended by signal {}", signal)};
}

}  // namespace tacipc
