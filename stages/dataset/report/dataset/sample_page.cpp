#include "stages/dataset/report/dataset/sample_page.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/format/html_text.h"
#include "common/image/image.h"
#include "common/sample/render_folder.h"
#include "common/sample/sample_status.h"
#include "stages/dataset/report/card.h"
#include "stages/dataset/report/dataset/tally.h"
#include "stages/dataset/report/grasp_part.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/sheet.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

constexpr int kQuality = 88;

/// Replaces pictures by smaller copies, and links the originals among the data if they have a label.
class PictureCopies {
 public:
  PictureCopies(SamplePage& page, SampleReport& sample, const fs::path& folder, int picture_px)
      : page_(page), sample_(sample), folder_(folder), picture_px_(picture_px) {}

  void take(fs::path& picture, const std::string& name, const std::string& label) {
    const ByteImage image = read_picture(picture);
    add(image, name, picture_px_);
    if (!label.empty()) sample_.data.emplace_back(label, picture);
    picture = folder_ / picture_name(page_.shot.plan.id, name);
  }
  /// Adds a copy.
  /// \return its width and height
  std::pair<int, int> add(const ByteImage& image, const std::string& name, int largest_px) {
    const ByteImage copy =
        std::max(image.width, image.height) > largest_px ? fitted_picture(image, largest_px, largest_px) : image;
    const std::string file = picture_name(page_.shot.plan.id, name);
    page_.pictures.emplace_back(file, jpeg_bytes(copy, kQuality, file));
    return {copy.width, copy.height};
  }

 private:
  SamplePage& page_;
  SampleReport& sample_;
  const fs::path& folder_;
  int picture_px_;
};

std::string label_of_preview(const fs::path& file) { return is_picture(file) ? file.filename().string() : ""; }

void copy_pictures(SamplePage& page, SampleReport& sample, const fs::path& folder, const DatasetReportConfig& config) {
  if (!sample.images) return;
  PictureCopies copies(page, sample, folder, config.picture_px);
  SampleImages& images = *sample.images;
  page.shot.thumb_px = copies.add(read_png(images.tactile, 3), "thumb", config.thumb_px);
  copies.take(images.tactile, "tactile", field_of(FrameFile::tactile).file);
  copies.take(images.no_contact, "no_contact", field_of(FrameFile::tactile).file + " without contact");
  if (images.markers) copies.take(*images.markers, "markers", field_of(FrameFile::marker).file);
  // A map without preview is already among the data.
  if (images.indentation) copies.take(*images.indentation, "indentation", label_of_preview(*images.indentation));
  if (images.normal) copies.take(*images.normal, "normal", label_of_preview(*images.normal));
  for (PhaseImage& image : sample.phase_images) {
    const std::string name = frame_name(static_cast<std::size_t>(image.frame));
    copies.take(image.tactile, name, name + "/" + field_of(FrameFile::tactile).file);
  }
}

std::string planned_facts(const PlannedRow& plan) {
  const std::pair<const char*, const std::string&> lines[] = {
      {"object", plan.object}, {"motion", plan.motion},         {"sensor", plan.sensor}, {"mesh", plan.mesh},
      {"split", plan.split},   {"pose split", plan.split_pose}, {"shard", plan.shard},   {"seed", plan.seed}};
  std::string html = "<p class=\"files\">";
  for (const auto& [name, value] : lines)
    html += fmt::format("{}<span class=\"quiet\">{}</span> {}", name == lines[0].first ? "" : " · ", name,
                        html_text(value));
  return html + "</p>\n";
}

/// Labels and curves of the grasp, with rows of both fingers' images if they exist.
std::string grasp_of_finger(SamplePage& page, const fs::path& finger, const fs::path& folder) {
  constexpr const char* kStrip = "grasp";
  const fs::path grasp_folder = finger.parent_path();
  const GraspReport grasp = read_grasp(grasp_folder);
  std::vector<SceneGel> gels;
  for (const char* name : {"left", "right"}) gels.push_back({name, grasp_folder / name, {}});
  std::string strip;
  try {
    const ByteImage image = grasp_strip(gels, grasp.moments);
    const std::string file = picture_name(page.shot.plan.id, kStrip);
    page.pictures.emplace_back(file, jpeg_bytes(image, kQuality, file));
    strip = html_link(folder / file, folder / "samples");
  } catch (const DataError&) {
    // The images of this finger were dropped, or those of the other one are not made yet.
  }
  return grasp_article(grasp, finger.filename() == "right" ? 1 : 0, strip);
}

}  // namespace

SamplePage make_sample_page(const PlannedRow& plan, const fs::path& dataset, const fs::path& folder,
                            const DatasetReportConfig& config) {
  SamplePage page{.shot = {.plan = plan}, .pictures = {}, .body = ""};
  SampleReport sample = read_sample(dataset / plan.folder);
  try {
    copy_pictures(page, sample, folder, config);
  } catch (const std::runtime_error& error) {
    leave_out_pictures(sample, error.what());
    page.pictures.clear();
    page.shot.thumb_px.reset();
  }
  std::string grasp;
  if (is_finger(dataset / plan.folder) && sample.passed()) grasp = grasp_of_finger(page, dataset / plan.folder, folder);
  page.shot.passed = sample.passed();
  page.body = "<p>" + verdict_badge(sample) + "</p>\n" + planned_facts(plan) + grasp + "<article class=\"card\">\n" +
              sample_body(sample, folder / "samples", Loading::at_once) + "</article>\n";
  return page;
}

std::string sample_page_html(const std::string& dataset, const SamplePage& page, const PlannedRow* before,
                             const PlannedRow* after, const std::string& list_page) {
  const auto neighbour = [](const PlannedRow* plan) -> std::optional<Neighbour> {
    if (plan == nullptr) return std::nullopt;
    return Neighbour{plan->id + ".html", fmt::format("{}, {} ({})", plan->object, plan->motion, plan->index)};
  };
  const std::string links = neighbours(neighbour(before), neighbour(after));
  return site_page({.dataset = dataset,
                    .heading = page.shot.plan.id,
                    .up = "../",
                    .main = page.body + links +
                            fmt::format("<p><a href=\"../{}\">In the list of all samples</a> · <a "
                                        "href=\"../index.html#legend\">How to read this page</a></p>\n",
                                        list_page),
                    .nav = links});
}

}  // namespace tacipc
