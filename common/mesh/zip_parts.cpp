#include "common/mesh/zip_parts.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>

#include "common/base/error.h"
#include "common/base/text_reader.h"

namespace tacipc {
namespace {

/// Returns a part's name in the form used for comparison.
std::string compared(std::string_view part) {
  while (part.starts_with('/') || part.starts_with("./")) part.remove_prefix(part.front() == '/' ? 1 : 2);
  std::string name = lower_case(part);
  std::ranges::replace(name, '\\', '/');  // archives of some programs have backslashes
  return name;
}

/// Decodes percent escapes: %41 becomes A.
std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    const char* const digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      decoded += static_cast<char>(code);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

/// Walks over the entries of an archive once, by its central directory.
class Walk {
 public:
  Walk(std::string_view bytes, const std::string& name) : name_(name), zip_(archive_read_new(), archive_read_free) {
    archive_read_support_format_zip_seekable(zip_.get());
    if (archive_read_open_memory(zip_.get(), bytes.data(), bytes.size()) != ARCHIVE_OK) refuse();
  }

  /// Returns the next entry's name; nothing at the end.
  std::optional<std::string> next() {
    const int status = archive_read_next_header(zip_.get(), &entry_);
    if (status == ARCHIVE_EOF) return std::nullopt;
    if (status < ARCHIVE_WARN) refuse();
    const char* utf8 = archive_entry_pathname_utf8(entry_);
    const char* inside = utf8 != nullptr ? utf8 : archive_entry_pathname(entry_);
    return inside == nullptr ? "" : inside;
  }

  /// Unpacks the current entry; nothing if it exceeds `most` bytes.
  std::optional<std::string> unpacked(const std::string& part, std::size_t most) {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    if (archive_entry_size_is_set(entry_) != 0 && archive_entry_size(entry_) > static_cast<la_int64_t>(most))
      return std::nullopt;
    std::string bytes;
    for (std::size_t size = 0;;) {
      bytes.resize(size + kBlock);
      const la_ssize_t got = archive_read_data(zip_.get(), bytes.data() + size, kBlock);
      if (got < 0) throw DataError("{}: {} cannot be unpacked ({})", name_, shown(part), reason());
      size += static_cast<std::size_t>(got);
      if (size > most) return std::nullopt;
      if (got == 0) {
        bytes.resize(size);
        return bytes;
      }
    }
  }

 private:
  std::string reason() const {
    const char* why = archive_error_string(zip_.get());
    return why != nullptr ? shown(why) : "no reason given";
  }
  [[noreturn]] void refuse() const { throw DataError("{}: is not a ZIP archive, or is damaged ({})", name_, reason()); }

  const std::string& name_;
  std::unique_ptr<archive, decltype(&archive_read_free)> zip_;
  archive_entry* entry_ = nullptr;
};

}  // namespace

ZipParts::ZipParts(std::string_view bytes, std::string name, std::size_t most)
    : bytes_(bytes), name_(std::move(name)), most_(most), left_(most) {
  Walk walk(bytes_, name_);
  std::size_t number = 0;
  while (const auto inside = walk.next()) {
    const auto [entry, is_new] = entries_.try_emplace(compared(*inside), Entry{.number = number++});
    if (!is_new) entry->second.repeated = true;
  }
}

const ZipParts::Entry* ZipParts::entry_of(const std::string& part) const {
  for (const std::string& name : {compared(part), compared(percent_decoded(part))})
    if (const auto found = entries_.find(name); found != entries_.end()) return &found->second;
  return nullptr;
}

std::vector<std::string> ZipParts::read(const std::vector<std::string>& parts) {
  std::vector<std::string> contents(parts.size());
  std::multimap<std::size_t, std::size_t> wanted;  // entry, index in `parts`
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Entry* entry = entry_of(parts[i]);
    if (entry == nullptr) throw DataError("{}: has no part {}", name_, shown(parts[i]));
    if (entry->repeated) throw DataError("{}: has the part {} twice", name_, shown(parts[i]));
    wanted.emplace(entry->number, i);
  }
  Walk walk(bytes_, name_);
  std::size_t number = 0;
  for (auto next = wanted.begin(); next != wanted.end() && walk.next(); ++number) {
    if (next->first != number) continue;
    const std::size_t first = next->second;
    std::optional<std::string> content = walk.unpacked(parts[first], left_);
    if (!content)
      throw DataError("{}: with {} it unpacks to more than {} MiB", name_, shown(parts[first]), most_ >> 20);
    left_ -= content->size();
    contents[first] = std::move(*content);
    for (++next; next != wanted.end() && next->first == number; ++next) contents[next->second] = contents[first];
  }
  return contents;
}

}  // namespace tacipc
