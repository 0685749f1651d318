#include "stages/study/metrics/image_pairs.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <system_error>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

using Names = std::set<std::string>;

bool hidden(const fs::path& relative) {
  return std::ranges::any_of(relative, [](const fs::path& part) { return part.string().front() == '.'; });
}

Names names_in(const fs::path& folder, const std::string& ends_with) {
  Names names;
  std::error_code error;
  for (auto entry = fs::recursive_directory_iterator(folder, error); !error && entry != fs::end(entry);
       entry.increment(error)) {
    const fs::path relative = entry->path().lexically_relative(folder);
    if (entry->is_regular_file() && !hidden(relative) && relative.generic_string().ends_with(ends_with))
      names.insert(relative.generic_string());
  }
  if (error) throw DataError("{}: cannot be listed: {}", folder.string(), error.message());
  if (names.empty()) throw DataError("{}: holds no file whose name ends with {}", folder.string(), ends_with);
  return names;
}

void expect_all(const Names& names, const fs::path& folder, const Names& others, const fs::path& other) {
  Names missing;
  std::set_difference(names.begin(), names.end(), others.begin(), others.end(), std::inserter(missing, missing.end()));
  if (missing.empty()) return;
  const std::string more = missing.size() > 1 ? fmt::format(" and {} more", missing.size() - 1) : "";
  throw DataError("{} has no counterpart in {}{}", (folder / *missing.begin()).string(), other.string(), more);
}

std::vector<ImagePair> pair_lists(const std::vector<fs::path>& listed, const std::vector<fs::path>& references) {
  for (const auto* list : {&listed, &references})
    for (const fs::path& file : *list)
      if (fs::is_directory(file)) throw UsageError(file.string() + ": give one folder each, or files only");
  if (listed.size() != references.size()) {
    throw UsageError(
        fmt::format("{} images but {} references: lists are compared pair by pair", listed.size(), references.size()));
  }
  std::vector<fs::path> images;
  for (const fs::path& image : listed) images.push_back(image.lexically_normal());
  // Names are independent of the location of the common folder.
  const fs::path folder = common_folder(images);
  std::vector<ImagePair> pairs;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const fs::path name = folder.empty() ? images[i] : images[i].lexically_relative(folder);
    pairs.push_back({name.generic_string(), images[i], references[i]});
  }
  return pairs;
}

}  // namespace

std::vector<ImagePair> pair_images(const std::vector<fs::path>& images, const std::vector<fs::path>& references,
                                   const std::string& ends_with) {
  const bool folders =
      images.size() == 1 && references.size() == 1 && fs::is_directory(images[0]) && fs::is_directory(references[0]);
  if (!folders) return pair_lists(images, references);
  const fs::path left = images[0].lexically_normal(), right = references[0].lexically_normal();
  const Names names = names_in(left, ends_with), others = names_in(right, ends_with);
  expect_all(names, left, others, right);
  expect_all(others, right, names, left);
  std::vector<ImagePair> pairs;
  for (const std::string& name : names) pairs.push_back({name, left / name, right / name});
  return pairs;
}

}  // namespace tacipc
