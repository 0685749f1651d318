#include "stages/gel/tetmesh/isolated.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <new>

#include "common/base/error.h"

namespace tacipc {
namespace {

constexpr char kResult = 'R', kError = 'E';

void write_all(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(file, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(1);
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

std::string read_all(int file) {
  std::string bytes;
  std::string block(1 << 16, '\0');
  for (;;) {
    const ssize_t count = ::read(file, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(block, 0, static_cast<std::size_t>(count));
  }
}

[[noreturn]] void run_child(int pipe, pid_t parent, const std::function<std::string()>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent ended before this took effect
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
  std::string answer;
  try {
    answer = kResult + work();
  } catch (const std::bad_alloc&) {
    answer = std::string(1, kError) + "ran out of memory";
  } catch (const std::exception& error) {
    answer = std::string(1, kError) + error.what();
  }
  write_all(pipe, answer.data(), answer.size());
  ::_exit(0);
}

}  // namespace

std::string run_isolated(const std::string& what, const std::function<std::string()>& work) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw DataError("{}: cannot create a pipe: {}", what, std::strerror(errno));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) {
    const int reason = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    throw DataError("{}: cannot start a process: {}", what, std::strerror(reason));
  }
  if (child == 0) run_child(ends[1], parent, work);
  ::close(ends[1]);
  const std::string answer = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) throw DataError("{} crashed (signal {})", what, WTERMSIG(status));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || answer.empty())
    throw DataError("{} ended without a result", what);
  if (answer.front() == kError) throw DataError("{} {}", what, answer.substr(1));
  return answer.substr(1);
}

}  // namespace tacipc
