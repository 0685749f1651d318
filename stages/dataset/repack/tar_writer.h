// Writes tar archives (POSIX pax) whose bytes depend on their content alone.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct archive;

namespace tacipc {

/// Archive whose files have no owner and the time 0. Every error is a DataError that names the archive.
class TarWriter {
 public:
  explicit TarWriter(const std::filesystem::path& path);

  void add(const std::string& name, std::string_view bytes);
  /// Writes the remaining data.
  /// \throw DataError if that fails (a full disk)
  void close();

 private:
  struct Free {
    void operator()(archive* a) const;
  };
  void check(std::ptrdiff_t result) const;

  std::string name_;
  std::unique_ptr<archive, Free> tar_;
};

}  // namespace tacipc
