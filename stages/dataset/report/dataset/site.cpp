#include "stages/dataset/report/dataset/site.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/format/html_text.h"
#include "stages/dataset/report/html.h"
#include "tacipc_report_texts.h"

namespace tacipc {
namespace {

/// Name in the form of a link.
std::string linked(const std::string& name) { return html_link(name, "."); }

}  // namespace

std::string list_page_name(std::size_t page) { return fmt::format("list-{:03}.html", page + 1); }
std::string sheet_page_name(std::size_t page) { return fmt::format("sheet-{:03}.html", page + 1); }
std::string sample_page_name(const std::string& id) { return "samples/" + id + ".html"; }
std::string picture_name(const std::string& id, const std::string& picture) {
  return "pictures/" + id + "/" + picture + ".jpg";
}

std::string site_page(const SitePage& page) {
  using fmt::arg;
  return page_head(page.heading + (page.heading == page.dataset ? "" : " – " + page.dataset),
                   "<link rel=\"stylesheet\" href=\"" + page.up + "style.css\">\n<link rel=\"icon\" href=\"data:,\">") +
         fmt::format(kSitePage, arg("up", page.up), arg("dataset", html_text(page.dataset)),
                     arg("sheets", sheet_page_name(0)), arg("list", list_page_name(0)),
                     arg("heading", html_text(page.heading)), arg("nav", page.nav), arg("main", page.main));
}

std::string neighbours(const std::optional<Neighbour>& before, const std::optional<Neighbour>& after) {
  std::string html = "<nav class=\"pager\" aria-label=\"Neighbours\">";
  if (before)
    html += fmt::format("<a rel=\"prev\" accesskey=\"p\" href=\"{}\">← {}</a> ", linked(before->link),
                        html_text(before->words));
  if (after)
    html += fmt::format("<a rel=\"next\" accesskey=\"n\" href=\"{}\">{} →</a>", linked(after->link),
                        html_text(after->words));
  return html + "</nav>\n";
}

std::string pager(std::size_t page, std::size_t pages, std::string (*name)(std::size_t)) {
  if (pages < 2) return "";
  constexpr std::size_t kNear = 3;
  std::string html = "<nav class=\"pager\" aria-label=\"Pages\">";
  if (page > 0) html += fmt::format("<a rel=\"prev\" accesskey=\"p\" href=\"{}\">← previous</a> ", name(page - 1));
  const std::size_t from = page > kNear ? page - kNear : 0, to = std::min(pages, page + kNear + 1);
  const auto link = [&](std::size_t i) {
    html += i == page ? fmt::format("<b aria-current=\"page\">{}</b> ", i + 1)
                      : fmt::format("<a href=\"{}\">{}</a> ", name(i), i + 1);
  };
  if (from > 0) link(0);
  if (from > 1) html += "… ";
  for (std::size_t i = from; i < to; ++i) link(i);
  if (to + 1 < pages) html += "… ";
  if (to < pages) link(pages - 1);
  if (page + 1 < pages) html += fmt::format("<a rel=\"next\" accesskey=\"n\" href=\"{}\">next →</a>", name(page + 1));
  return html + "</nav>\n";
}

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

std::string site_style() { return page_style() + "\n" + kSiteStyle; }

std::string scroll_start(const std::string& label) {
  return fmt::format("<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{}\">", html_text(label));
}

}  // namespace tacipc
