#include "stages/dataset/repack/tar_writer.h"

#include <archive.h>
#include <archive_entry.h>

#include "common/base/error.h"

namespace tacipc {

struct TarWriter::Archive {
  struct Free {
    void operator()(archive* a) const { archive_write_free(a); }
    void operator()(archive_entry* e) const { archive_entry_free(e); }
  };
  std::string name;
  std::unique_ptr<archive, Free> tar{archive_write_new()};

  void check(la_ssize_t result) const {
    if (result < ARCHIVE_OK) throw DataError("{}: cannot be written: {}", name, archive_error_string(tar.get()));
  }
};

TarWriter::TarWriter(const std::filesystem::path& path) : archive_(std::make_unique<Archive>()) {
  archive_->name = path.string();
  if (!archive_->tar) throw DataError("{}: cannot be written: out of memory", archive_->name);
  archive_->check(archive_write_set_format_pax_restricted(archive_->tar.get()));
  archive_->check(archive_write_open_filename(archive_->tar.get(), path.c_str()));
}

TarWriter::~TarWriter() = default;

void TarWriter::add(const std::string& name, std::string_view bytes) {
  const std::unique_ptr<archive_entry, Archive::Free> entry(archive_entry_new());
  if (!entry) throw DataError("{}: cannot be written: out of memory", archive_->name);
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  archive_entry_set_mtime(entry.get(), 0, 0);
  archive_->check(archive_write_header(archive_->tar.get(), entry.get()));
  archive_->check(archive_write_data(archive_->tar.get(), bytes.data(), bytes.size()));
}

void TarWriter::close() { archive_->check(archive_write_close(archive_->tar.get())); }

}  // namespace tacipc
