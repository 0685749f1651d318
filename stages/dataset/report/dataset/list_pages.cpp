#include "stages/dataset/report/dataset/list_pages.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "common/format/html_text.h"
#include "stages/dataset/report/dataset/site.h"
#include "stages/dataset/report/dataset/tally.h"
#include "stages/dataset/report/html.h"

namespace tacipc {

std::size_t pages_of(std::size_t items, std::size_t per_page) {
  return std::max<std::size_t>(1, (items + per_page - 1) / per_page);
}

ListPages::ListPages(std::string dataset, std::size_t samples, std::size_t rows_per_page,
                     std::set<std::string> with_page, Write write)
    : dataset_(std::move(dataset)),
      samples_(samples),
      rows_per_page_(rows_per_page),
      with_page_(std::move(with_page)),
      write_(std::move(write)) {}

void ListPages::add(const SampleRow& row) {
  const std::string id = html_text(row.plan.id);
  table_ += "<tr><td>" + html_text(row.plan.index) + "</td><td class=\"word\">";
  table_ += with_page_.contains(row.plan.id)
                ? fmt::format("<a href=\"{}\">{}</a>", html_link(sample_page_name(row.plan.id), "."), id)
                : id;
  const char* kind = row.status == SampleStatus::unmade ? "unmade" : status_word(row.status);
  table_ += fmt::format("</td><td class=\"word status-{}\">{}</td>", kind, status_word(row.status));
  for (const std::string& word : {row.plan.split, row.plan.split_pose})
    table_ += "<td class=\"word\">" + html_text(word) + "</td>";
  for (const Quantity& quantity : kQuantities) table_ += "<td>" + number_text(row.numbers.*quantity.number) + "</td>";
  table_ += "</tr>\n";
  if (++rows_ == rows_per_page_) flush();
}

void ListPages::flush() {
  const std::size_t pages = pages_of(samples_, rows_per_page_);
  std::string main =
      scroll_start("Samples") +
      "<table>\n<thead><tr><th>index</th><th class=\"word\">sample</th><th class=\"word\">status</th><th "
      "class=\"word\">split</th><th class=\"word\">pose split</th>";
  for (const Quantity& quantity : kQuantities) main += fmt::format("<th>{}<br>{}</th>", quantity.name, quantity.unit);
  main += "</tr></thead>\n<tbody>\n" + std::exchange(table_, "") + "</tbody></table></div>\n";
  const std::string links = pager(page_, pages, list_page_name);
  const std::string heading = pages == 1 ? "All samples" : fmt::format("Samples, page {} of {}", page_ + 1, pages);
  write_(list_page_name(page_), site_page({.dataset = dataset_,
                                           .heading = heading,
                                           .up = "",
                                           .main = main + links,
                                           .nav = "<p>A name is sensor, object, motion and index. Each number is the "
                                                  "largest over the frames of the sample.</p>\n" +
                                                  links}));
  ++page_;
  rows_ = 0;
}

void ListPages::finish() {
  if (rows_ > 0 || page_ == 0) flush();
}

std::string sheet_page(const std::string& dataset, const std::vector<SampleShot>& shots, std::size_t page,
                       std::size_t per_page) {
  const std::size_t pages = pages_of(shots.size(), per_page);
  const std::string links = pager(page, pages, sheet_page_name);
  const std::string heading = pages == 1 ? "Contact sheet" : fmt::format("Contact sheet {} of {}", page + 1, pages);
  std::string main =
      shots.empty() ? "<p>No sample has a page yet.</p>\n" : shots_list(shots, page * per_page, per_page);
  return site_page(
      {.dataset = dataset,
       .heading = heading,
       .up = "",
       .main = main + links,
       .nav = "<p>The last tactile image of each sample; choose one for all that is known of it.</p>\n" + links});
}

}  // namespace tacipc
