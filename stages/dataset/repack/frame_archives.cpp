#include "stages/dataset/repack/frame_archives.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {
namespace {

/// First line of `form` that `other` lacks; both are sorted.
const std::string* line_missing_in(const std::vector<std::string>& other, const std::vector<std::string>& form) {
  for (const std::string& line : form)
    if (!std::ranges::binary_search(other, line)) return &line;
  return nullptr;
}

}  // namespace

FrameArchives::FrameArchives(const std::string& shard, const OutputPath& output)
    : shard_(shard), output_(output), samples_(output("samples/" + shard + ".tar")) {}

FrameArchives::Archive& FrameArchives::archive_of(const SampleFiles& sample) {
  const std::string kind = sample.kind();
  std::vector<std::string> form = sample.form();
  const auto at = frames_.find(kind);
  if (at == frames_.end()) {
    const std::string name = fmt::format("{}-{}.tar", shard_, kind);
    return frames_.emplace(kind, Archive{TarWriter(output_(name)), std::move(form), sample.id()}).first->second;
  }
  Archive& archive = at->second;
  const auto refuse = [&](const std::string& one, const std::string& line, const std::string& other) {
    throw DataError("{} has {}, {} has not: readers of WebDatasets need the same files in every sample", one, line,
                    other);
  };
  if (const auto* line = line_missing_in(archive.form, form)) refuse(sample.id(), *line, archive.first);
  if (const auto* line = line_missing_in(form, archive.form)) refuse(archive.first, *line, sample.id());
  return archive;
}

std::size_t FrameArchives::add(const SampleFiles& sample) {
  Archive& frames = archive_of(sample);
  std::string key = sample.id();
  std::ranges::replace(key, '.', '_');
  if (const auto [one, added] = keys_.emplace(key, sample.id()); !added && one->second != sample.id())
    throw DataError("{} and {} have the same name in a WebDataset, {}", one->second, sample.id(), key);
  std::size_t files = 0;
  sample.write_frames([&](const std::string& of, const std::string& name, std::string_view bytes) {
    frames.tar.add(fmt::format("{}/{}.{}", key, of, name), bytes);
    ++files;
  });
  sample.write_sample([&](const std::string&, const std::string& name, std::string_view bytes) {
    samples_.add(fmt::format("{}.{}", key, name), bytes);
    ++files;
  });
  return files;
}

void FrameArchives::close() {
  for (auto& [kind, archive] : frames_) archive.tar.close();
  samples_.close();
}

std::size_t write_folder(const SampleFiles& sample, const OutputPath& output) {
  std::size_t files = 0;
  const TakeFile write = [&](const std::string& of, const std::string& name, std::string_view bytes) {
    const std::string file = !of.empty() ? fmt::format("{}.{}", of, name) : name == "json" ? "sample.json" : name;
    write_file(output(fmt::format("{}/{}", sample.id(), file)), bytes);
    ++files;
  };
  sample.write_frames(write);
  sample.write_sample(write);
  return files;
}

}  // namespace tacipc
