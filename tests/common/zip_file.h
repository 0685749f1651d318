// ZIP archives made in memory, for tests of readers.
#pragma once

#include <archive.h>
#include <archive_entry.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tacipc {

using NamedFiles = std::vector<std::pair<std::string, std::string>>;  // name, content

enum class ZipMethod { store, deflate };

/// Bytes that are equal in every run.
inline std::string zip_of(const NamedFiles& files, ZipMethod method = ZipMethod::deflate) {
  std::size_t room = 1024, used = 0;
  for (const auto& [name, content] : files) room += 2 * name.size() + content.size() + content.size() / 1000 + 512;
  std::string bytes(room, '\0');
  archive* zip = archive_write_new();
  archive_write_set_format_zip(zip);
  if (method == ZipMethod::store)
    archive_write_zip_set_compression_store(zip);
  else
    archive_write_zip_set_compression_deflate(zip);
  bool good = archive_write_open_memory(zip, bytes.data(), bytes.size(), &used) == ARCHIVE_OK;
  for (const auto& [name, content] : files) {
    archive_entry* entry = archive_entry_new();
    archive_entry_set_pathname(entry, name.c_str());
    archive_entry_set_size(entry, static_cast<la_int64_t>(content.size()));
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_entry_set_mtime(entry, 400'000'000, 0);
    good = good && archive_write_header(zip, entry) >= ARCHIVE_WARN &&
           archive_write_data(zip, content.data(), content.size()) == static_cast<la_ssize_t>(content.size());
    archive_entry_free(entry);
  }
  good = archive_write_close(zip) == ARCHIVE_OK && good;
  archive_write_free(zip);
  if (!good) throw std::logic_error("a ZIP archive cannot be made");
  bytes.resize(used);
  return bytes;
}

}  // namespace tacipc
