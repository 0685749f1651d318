// Tar archives (POSIX pax) whose bytes depend on their content alone.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace tacipc {

/// Files have no owner and the time 0. Any fault is a DataError that names the archive.
class TarWriter {
 public:
  explicit TarWriter(const std::filesystem::path& path);
  ~TarWriter();
  TarWriter(const TarWriter&) = delete;
  TarWriter& operator=(const TarWriter&) = delete;

  void add(const std::string& name, std::string_view bytes);
  /// Writes the rest. \throw DataError if that fails (a full disk)
  void close();

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
};

}  // namespace tacipc
