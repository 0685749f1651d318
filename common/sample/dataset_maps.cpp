#include "common/sample/dataset_maps.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace tacipc {
namespace {

using enum FrameFile;

constexpr std::array<std::pair<FrameFile, const char*>, 14> kNames{{{linear, "linear"},
                                                                    {depth, "depth"},
                                                                    {normal, "normal"},
                                                                    {indentation, "indentation"},
                                                                    {traction, "traction"},
                                                                    {pressure, "pressure"},
                                                                    {shear, "shear"},
                                                                    {tactile, "tactile"},
                                                                    {marker, "marker"},
                                                                    {contact, "contact"},
                                                                    {stick_slip, "stick_slip"},
                                                                    {segment, "segment"},
                                                                    {normal_picture, "normal_preview"},
                                                                    {indentation_picture, "indentation_preview"}}};

const std::vector<std::string> kUsual{"tactile",  "marker",  "indentation", "depth",  "normal",
                                      "traction", "contact", "stick_slip",  "segment"};

/// Returns the name of a map in configurations; empty for files that cannot be selected.
std::string map_name(FrameFile file) {
  const auto found = std::find_if(kNames.begin(), kNames.end(), [&](const auto& named) { return named.first == file; });
  return found == kNames.end() ? "" : found->second;
}

}  // namespace

bool DatasetMaps::has(FrameFile file) const { return std::find(files.begin(), files.end(), file) != files.end(); }

DatasetMaps DatasetMaps::read(ConfigReader& in) {
  std::vector<std::string> all;
  for (const auto& [file, name] : kNames) all.emplace_back(name);
  const std::vector<std::string> chosen = in.choices_or("maps", kUsual, all);
  DatasetMaps maps;
  for (const auto& [file, name] : kNames)
    if (std::find(chosen.begin(), chosen.end(), name) != chosen.end()) maps.files.push_back(file);
  // The presence of this file shows which frames were rendered.
  if (!maps.has(tactile)) in.fault("maps", "tactile must be among them");
  return maps;
}

std::string DatasetMaps::yaml() const {
  std::vector<std::string> names;
  for (const FrameFile file : files) names.push_back(map_name(file));
  return fmt::format("# Made by the stage plan.\nmaps: [{}]\n", fmt::join(names, ", "));
}

}  // namespace tacipc
