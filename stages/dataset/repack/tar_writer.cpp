#include "stages/dataset/repack/tar_writer.h"

#include <archive.h>
#include <archive_entry.h>

#include "common/base/error.h"

namespace tacipc {

void TarWriter::Free::operator()(archive* a) const { archive_write_free(a); }

void TarWriter::check(std::ptrdiff_t result) const {
  if (result < ARCHIVE_OK) throw DataError("{}: cannot be written: {}", name_, archive_error_string(tar_.get()));
}

TarWriter::TarWriter(const std::filesystem::path& path) : name_(path.string()), tar_(archive_write_new()) {
  if (!tar_) throw DataError("{}: cannot be written: out of memory", name_);
  check(archive_write_set_format_pax_restricted(tar_.get()));
  check(archive_write_open_filename(tar_.get(), path.c_str()));
}

void TarWriter::add(const std::string& name, std::string_view bytes) {
  const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(), archive_entry_free);
  if (!entry) throw DataError("{}: cannot be written: out of memory", name_);
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  archive_entry_set_mtime(entry.get(), 0, 0);
  check(archive_write_header(tar_.get(), entry.get()));
  check(archive_write_data(tar_.get(), bytes.data(), bytes.size()));
}

void TarWriter::close() { check(archive_write_close(tar_.get())); }

}  // namespace tacipc
