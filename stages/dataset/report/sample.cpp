#include "stages/dataset/report/sample.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/image/picture.h"
#include "common/sample/press_folder.h"
#include "common/sample/render_folder.h"
#include "common/sample/sample_status.h"
#include "common/stage/record.h"
#include "stages/dataset/report/press_report.h"
#include "stages/dataset/report/stage_log.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

void read_render(const fs::path& folder, SampleReport& sample) {
  const Record render = Record::from_file(folder / "render.yaml");
  const auto press_hash = render.section("inputs").section("press").text("hash");
  const fs::path press = sample.folder / "press";
  if (press_hash && !was_dropped(press) && *press_hash != content_hash(press))
    throw DataError("render: the images are of an older press; render again");
  sample.synthetic_reference = render.text("reference") == "synthetic";
  sample.max_indentation_m = 1e-3 * render.section("summary").required_number("max_indentation_mm");
  if (sample.frames.empty()) return;
  if (was_dropped(folder)) {
    sample.warnings.emplace_back("render: its images were dropped after packing");
    return;
  }
  const std::size_t last = sample.frames.size() - 1;
  const Record outputs = render.section("outputs");
  const auto first_of = [&](std::initializer_list<FrameFile> files) -> std::optional<fs::path> {
    for (const FrameFile file : files) {
      if (!outputs.has(frame_folder(last) + field_of(file).file)) continue;
      const fs::path path = frame_path(folder, last, file);
      if (!fs::is_regular_file(path)) throw DataError("{}: is missing", path.string());
      return path;
    }
    return std::nullopt;
  };
  using enum FrameFile;
  const SampleImages images{.tactile = frame_path(folder, last, tactile),
                            .no_contact = frame_path(folder, 0, tactile),
                            .indentation = first_of({indentation_picture, indentation}),
                            .normal = first_of({normal_picture, normal}),
                            .markers = first_of({marker})};
  for (const fs::path& path : {images.tactile, images.no_contact}) {
    if (!fs::is_regular_file(path)) throw DataError("{}: is missing", path.string());
  }
  sample.images = images;
  for (const int frame : pictured_frames(sample)) {
    const fs::path path = frame_path(folder, static_cast<std::size_t>(frame), FrameFile::tactile);
    const auto phase = std::find_if(sample.phases.begin(), sample.phases.end(),
                                    [&](const PhaseReport& p) { return p.first <= frame && frame <= p.last; });
    if (frame + 1 < static_cast<int>(sample.frames.size()) && fs::is_regular_file(path))
      sample.phase_images.push_back({phase == sample.phases.end() ? "" : phase->name, frame, path});
  }
  for (const FrameFile file : {FrameFile::linear, FrameFile::depth, FrameFile::normal, FrameFile::indentation})
    link_if_there(sample.data, field_of(file).file, frame_path(folder, last, file));
}

/// Reads the requested motion of a failed press, if the sample has it.
void read_wish(const fs::path& path, SampleReport& sample) {
  if (!fs::is_regular_file(path)) return;
  const Record wish = Record::from_file(path);
  sample.motion = motion_text(wish);
  if (const auto depth_mm = asked_depth_mm(wish)) sample.depth_m = 1e-3 * *depth_mm;
}

std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Reads the reason for a stage without record: from its failure file, otherwise from its log.
void read_failure(const std::string& stage, SampleReport& sample) {
  const fs::path folder = sample.folder / stage, path = folder / (stage + ".failed.yaml");
  sample.failure = failure_reason(folder, stage);
  if (!fs::is_regular_file(path)) return;
  const Record record = Record::from_file(path);
  if (stage == "press") sample.name = record.text("name").value_or(sample.name);
  const FailedCheck failed = read_failed_check(record);
  if (!failed.message.empty()) sample.failure = stage + ": " + in_one_line(failed.message);
  if (failed.check) sample.checks = {*failed.check};
}

void judge(SampleReport& sample) {
  const fs::path press = sample.folder / "press";
  if (!fs::is_regular_file(press / "press.yaml")) {
    read_wish(sample.folder / "sample.yaml", sample);
    read_failure("press", sample);
    return;
  }
  read_press(press, sample);
  if (!fs::is_regular_file(sample.folder / "render" / "render.yaml")) {
    read_failure("render", sample);
    return;
  }
  read_render(sample.folder / "render", sample);
}

fs::path without_slash(const fs::path& folder) { return folder.has_filename() ? folder : folder.parent_path(); }

/// Text in which paths below the sample's folder are relative to it, so that the page is independent of its location.
std::string without_folder(std::string text, const fs::path& folder) {
  const std::string prefix = folder.string() + "/";
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at)) {
    // Only whole paths: "./" is also the end of "../".
    if (at == 0 || text[at - 1] == ' ')
      text.erase(at, prefix.size());
    else
      at += prefix.size();
  }
  return text;
}

}  // namespace

ByteImage read_picture(const fs::path& file) {
  if (is_picture(file)) return read_png(file, 3);
  const bool height = file.filename() == field_of(FrameFile::indentation).file;
  const FloatImage map = read_exr(file, field_of(height ? FrameFile::indentation : FrameFile::normal).channels);
  return height ? picture_of_height(map) : picture_of_normals(map);
}

SampleReport read_sample(const fs::path& given) {
  SampleReport sample;
  sample.folder = without_slash(given.lexically_normal());
  if (!fs::is_directory(sample.folder / "press") && !fs::is_regular_file(sample.folder / "sample.yaml")) {
    throw DataError("{}: has neither a press folder nor a sample.yaml, so it is not a sample's folder",
                    sample.folder.string());
  }
  sample.name = without_slash(fs::absolute(sample.folder).lexically_normal()).filename().string();
  link_if_there(sample.records, "sample.yaml", sample.folder / "sample.yaml");
  for (const char* stage : {"press", "render"}) {
    for (const char* ending : {".yaml", ".failed.yaml", ".log"})
      link_if_there(sample.records, stage + std::string(ending), sample.folder / stage / (stage + std::string(ending)));
  }
  for (const NpyField& field : press_fields())
    link_if_there(sample.data, field.file, sample.folder / "press" / field.file);
  link_if_there(sample.data, kMarkersCsv, sample.folder / "press" / kMarkersCsv);
  try {
    judge(sample);
  } catch (const std::runtime_error& error) {
    sample.failure = without_folder(error.what(), sample.folder);
  }
  if (sample.synthetic_reference.value_or(false)) {
    sample.warnings.push_back(
        "Synthetic reference image: the sensor file names no photograph of the real sensor without contact");
  }
  for (const char* stage : {"press", "render"}) {
    for (const std::string& warning : log_messages(sample.folder / stage / (stage + std::string(".log")), "warning"))
      sample.warnings.push_back(fmt::format("{}: {}", stage, warning));
  }
  return sample;
}

void leave_out_pictures(SampleReport& sample, const std::string& why) {
  sample.images.reset();
  sample.phase_images.clear();
  if (!sample.failure) sample.failure = without_folder(why, sample.folder);
}

}  // namespace tacipc
