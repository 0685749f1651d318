#include "common/base/files.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <system_error>

#include "common/base/error.h"

namespace tacipc {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path) : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (number_ < 0) throw DataError("{}: cannot be read: {}", path.string(), std::strerror(errno));
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(number_); }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

std::string hash_hex(const XXH128_hash_t& hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

std::string file_hash(const std::filesystem::path& path) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  for_each_part(path, [&](std::string_view part) { XXH3_128bits_update(state.get(), part.data(), part.size()); });
  return hash_hex(XXH3_128bits_digest(state.get()));
}

}  // namespace

void for_each_part(const std::filesystem::path& path, const std::function<void(std::string_view)>& use) {
  const std::filesystem::file_status status = std::filesystem::status(path);
  if (std::filesystem::is_directory(status)) throw DataError("{}: is a folder, expected a file", path.string());
  // Every input is read twice, once for its hash. A pipe is empty the second time; a device may never end.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw DataError("{}: is a pipe or a device, expected a file", path.string());
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw DataError("{}: cannot be read: {}", path.string(), std::strerror(errno));
  char buffer[1 << 16];
  while (const std::size_t count = std::fread(buffer, 1, sizeof(buffer), file.get())) use({buffer, count});
  if (std::ferror(file.get())) throw DataError("{}: cannot be read: {}", path.string(), std::strerror(errno));
}

std::string read_file(const std::filesystem::path& path) {
  std::string bytes;
  for_each_part(path, [&](std::string_view part) { bytes += part; });
  return bytes;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code ignored;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ignored);
  File file(std::fopen(path.c_str(), "wb"));
  const auto fail = [&] { throw DataError("{}: cannot be written: {}", path.string(), std::strerror(errno)); };
  if (!file) fail();
  if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size() || std::fflush(file.get()) != 0) fail();
  if (std::fclose(file.release()) != 0) fail();
}

void flush_to_disk(const std::vector<std::filesystem::path>& paths) {
  // Starts all before waiting for any, so that file systems with a journal write it once instead of once per file.
  // Paths that do not support this (a folder, some network file systems) fail here and are waited for below.
  if (paths.size() > 1)
    for (const auto& path : paths) ::sync_file_range(Descriptor(path).number(), 0, 0, SYNC_FILE_RANGE_WRITE);
  for (const auto& path : paths)
    if (::fsync(Descriptor(path).number()) != 0 && errno != EINVAL && errno != ENOSYS && errno != EROFS)
      throw DataError("{}: cannot be written: {}", path.string(), std::strerror(errno));
}

std::string content_hash(const std::filesystem::path& path, const std::set<std::filesystem::path>& without) {
  if (!std::filesystem::is_directory(path)) return file_hash(path);
  std::set<std::filesystem::path> absolute;
  for (const auto& file : without) absolute.insert(std::filesystem::weakly_canonical(file));
  const auto counts_not = [&](const std::filesystem::path& file) {
    return !absolute.empty() && absolute.contains(std::filesystem::weakly_canonical(file));
  };
  std::map<std::string, std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
    const std::string name = entry.path().lexically_relative(path).generic_string();
    const bool hidden = name.front() == '.' || name.find("/.") != std::string::npos;
    const bool of_the_run = name.ends_with(".log") || name.ends_with(".timings.yaml");
    if (!entry.is_regular_file() || of_the_run || hidden || counts_not(entry.path())) continue;
    files.emplace(name, entry.path());
  }
  std::string listing;
  for (const auto& [name, file] : files) listing += name + '\0' + file_hash(file) + '\n';
  return hash_hex(XXH3_128bits(listing.data(), listing.size()));
}

std::filesystem::path common_folder(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) return {};
  const std::filesystem::path first = files.front().parent_path();
  auto end = first.end();
  for (const std::filesystem::path& file : files) {
    const std::filesystem::path folder = file.parent_path();
    end = std::mismatch(first.begin(), end, folder.begin(), folder.end()).first;
  }
  std::filesystem::path common;
  for (auto part = first.begin(); part != end; ++part) common /= *part;
  return common;
}

}  // namespace tacipc
