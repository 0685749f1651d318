#include "common/base/blas.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <new>
#include <string>
#include <vector>

namespace tacipc {
namespace {

constexpr const char* kThreads = "OPENBLAS_NUM_THREADS";
constexpr std::size_t kBuffer = (std::size_t{128} << 20) + (std::size_t{1} << 20);  // bytes per call, with a margin

/// Returns a function of OpenBLAS; null if the library is not loaded.
template <typename Function>
Function* function_of(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_DEFAULT, name));
}

/// Returns whether these are the arguments with which the process was started.
bool is_of_process(char** argv) {
  std::string given;
  for (; *argv != nullptr; ++argv) given.append(*argv).push_back('\0');
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  return given == std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

void leave_blas_threads(char** argv) {
  const auto count = function_of<int()>("openblas_get_num_threads");
  if (count == nullptr || count() <= 1) return;
  // A build of OpenBLAS that ignores this variable would restart forever.
  if (const char* asked = std::getenv(kThreads); asked != nullptr && std::string(asked) == "1") return;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error || !is_of_process(argv)) return;
  ::setenv(kThreads, "1", 1);
  ::execv(program.c_str(), argv);  // on failure the program continues with its threads
}

void reserve_blas_memory(int calls) {
  static std::mutex mutex;
  static int reserved = 0;
  const std::scoped_lock lock(mutex);
  const auto take = function_of<void*(int)>("blas_memory_alloc");
  const auto give_back = function_of<void(void*)>("blas_memory_free");
  if (take == nullptr || give_back == nullptr || calls <= reserved) return;
  const std::size_t size = static_cast<std::size_t>(calls - reserved) * kBuffer;
  void* const room = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  ::munmap(room, size);
  // OpenBLAS keeps memory that was taken and returned for later calls.
  std::vector<void*> taken(static_cast<std::size_t>(calls));
  for (void*& buffer : taken) buffer = take(0);
  for (void* buffer : taken) give_back(buffer);
  reserved = calls;
}

}  // namespace tacipc
