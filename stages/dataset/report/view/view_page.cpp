#include "stages/dataset/report/view/view_page.h"

#include <fmt/core.h>

#include "common/format/html_text.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/view/view_data.h"
#include "tacipc_report_texts.h"

namespace tacipc {

std::string view_data_name(const std::string& id) { return "view/" + id + ".js"; }

std::string view_link(const std::string& place) {
  return fmt::format("<a href=\"{}#{}\">Turn it in 3-D</a>", kViewPage, place);
}

std::vector<std::string> frame_texts(const SampleReport& sample, const SceneView& view) {
  std::vector<std::string> texts;
  for (std::size_t f = 0; f < view.frames.size(); ++f) {
    const auto number = static_cast<std::size_t>(view.frames[f]);
    std::string text = fmt::format("frame {} of {}", number, sample.frames.size() - 1);
    if (number < sample.frames.size()) {
      const FrameReport& frame = sample.frames[number];
      if (!frame.phase.empty()) text += " · " + frame.phase;
      if (frame.time_s) text += " · " + number_text(frame.time_s) + " s";
      text += " · press force " + number_text(frame.press_force_n) + " N";
      if (frame.tangential_force_n) text += " · tangential " + number_text(frame.tangential_force_n) + " N";
    }
    texts.push_back(text + " · deepest indentation " + number_text(deepest_indentation(view, f), 1e3) + " mm");
  }
  return texts;
}

std::string view_page(const std::string& title, const std::vector<ViewedSample>& samples) {
  std::string options;
  for (const ViewedSample& sample : samples)
    options += fmt::format("<option value=\"{}\">{}</option>", sample.id, html_text(sample.name));
  return page_head(title + " in 3-D",
                   "<link rel=\"icon\" href=\"data:,\">\n<style>" + page_style() + "\n" + kViewStyle + "</style>") +
         fmt::format(kViewBody, fmt::arg("title", html_text(title)), fmt::arg("samples", options));
}

std::string view_program() { return kViewProgram; }

}  // namespace tacipc
