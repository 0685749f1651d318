#include "stages/dataset/report/dataset/sample_shots.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/format/html_text.h"
#include "stages/dataset/report/dataset/site.h"
#include "stages/dataset/report/html.h"

namespace tacipc {

std::string shots_list(const std::vector<SampleShot>& shots, std::size_t first, std::size_t count) {
  std::string html = "<ul class=\"sheet\">\n";
  for (std::size_t i = first; i < std::min(first + count, shots.size()); ++i) {
    const SampleShot& shot = shots[i];
    const std::string words = fmt::format("{}, {}, {}", html_text(shot.plan.object), html_text(shot.plan.motion),
                                          html_text(shot.plan.sensor));
    const std::string picture =
        shot.thumb_px
            ? fmt::format(
                  "<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"last tactile image of {}\" loading=\"lazy\">",
                  html_link(picture_name(shot.plan.id, "thumb"), "."), shot.thumb_px->first, shot.thumb_px->second,
                  words)
        : shot.passed ? "<span class=\"none gone\">no image left</span>"
                      : "<span class=\"none\">failed</span>";
    html += fmt::format("<li><a href=\"{}\">{}<b>{}</b> {}<br><span class=\"quiet\">{} · {}</span></a></li>\n",
                        html_link(sample_page_name(shot.plan.id), "."), picture, html_text(shot.plan.object),
                        html_text(shot.plan.motion), html_text(shot.plan.sensor), html_text(shot.plan.index));
  }
  return html + "</ul>\n";
}

}  // namespace tacipc
