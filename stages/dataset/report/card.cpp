#include "stages/dataset/report/card.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/format/html_text.h"
#include "common/sample/motion.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/press_curve.h"
#include "stages/dataset/report/quiver.h"
#include "stages/dataset/report/view/view_page.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Pictures of one page that open in full when clicked.
struct Pictures {
  const fs::path& folder;  // folder of the page
  Loading loading;

  /// `caption` is HTML.
  std::string figure(const fs::path& file, const std::string& alt, const std::string& caption) const {
    const std::string link = html_link(file, folder);
    return fmt::format(
        "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"{3}></a><figcaption>{2}</figcaption>"
        "</figure>\n",
        link, html_text(alt), caption, loading == Loading::in_sight ? " loading=\"lazy\"" : "");
  }
};

/// Colours of the normal picture for a flat face, and for faces inclined by 45° to each side.
std::string normal_swatches() {
  struct Swatch {
    const char* words;
    double x, y, z;
  };
  constexpr double kLean = 0.70710678;
  std::string swatches = "<div class=\"swatches\">";
  for (const Swatch& s :
       {Swatch{"flat", 0, 0, 1}, Swatch{"to the right", kLean, 0, kLean}, Swatch{"left", -kLean, 0, kLean},
        Swatch{"down", 0, kLean, kLean}, Swatch{"up", 0, -kLean, kLean}}) {
    swatches +=
        fmt::format("<span><span class=\"swatch\" style=\"background: rgb({:.0f} {:.0f} {:.0f})\"></span>{}</span>",
                    127.5 * (s.x + 1), 127.5 * (s.y + 1), 127.5 * (s.z + 1), s.words);
  }
  return swatches + "</div>";
}

/// Caption of markers: content and time of the picture.
std::string marker_caption(const MarkerPicture& picture, const std::vector<PhaseReport>& phases) {
  std::string caption = picture.arrows.empty() ? "<b>Contacts</b>"
                        : picture.since_press  ? "<b>Markers</b> since the end of the press"
                                               : "<b>Markers</b> since rest";
  caption += fmt::format(", frame {}", picture.frame);
  for (const PhaseReport& phase : phases) {
    if (phase.last == picture.frame) caption += " (end of " + html_text(phase.name) + ")";
  }
  if (!picture.arrows.empty()) caption += fmt::format(", at most {} mm", number_text(longest_mm(picture.arrows)));
  if (!picture.contacts.empty()) {
    const auto slipping =
        std::count_if(picture.contacts.begin(), picture.contacts.end(), [](const auto& c) { return c.slips; });
    caption +=
        fmt::format("<br><i class=\"dot stuck\"></i>{} contacts stick, <i class=\"dot slipping\"></i>{} slip",
                    count_text(picture.contacts.size() - static_cast<std::size_t>(slipping)), count_text(slipping));
  }
  return caption;
}

std::string image_figures(const SampleReport& sample, const fs::path& folder, Loading loading) {
  if (!sample.images) return "";
  const SampleImages& images = *sample.images;
  const Pictures pictures{folder, loading};
  std::string html;
  for (const PhaseImage& image : sample.phase_images) {
    html += pictures.figure(image.tactile, fmt::format("tactile image of {}, frame {}", sample.name, image.frame),
                            fmt::format("<b>Tactile image</b>, frame {}{}", image.frame,
                                        image.phase.empty() ? "" : " (end of " + html_text(image.phase) + ")"));
  }
  html += pictures.figure(images.tactile, "tactile image of " + sample.name,
                          fmt::format("<b>Tactile image</b>, last frame (<a href=\"{}\">without contact</a>)",
                                      html_link(images.no_contact, folder)));
  if (images.markers) {
    html += pictures.figure(*images.markers, "tactile image of " + sample.name + " with markers",
                            "<b>With printed markers</b>, last frame");
  }
  if (images.indentation && is_picture(*images.indentation)) {
    html += pictures.figure(*images.indentation, "indentation map of " + sample.name,
                            fmt::format("<b>Indentation</b> into the gel<div class=\"bar\">0<i></i>{} mm</div>",
                                        number_text(sample.max_indentation_m, 1e3)));
  }
  if (images.normal && is_picture(*images.normal)) {
    html += pictures.figure(*images.normal, "normals of " + sample.name,
                            "<b>Normals</b>: the face looks" + normal_swatches());
  }
  if (sample.sides) {
    html +=
        pictures.figure(*sample.sides, "what the sides of " + sample.object + " show",
                        "<b>Six sides</b> of the object as they would press: x, y, z, above + and below −; light is "
                        "what touches first, dark 0.5 mm behind it. Framed: the side that pressed, and the "
                        "sensor's window");
  }
  return html;
}

/// True if force over depth is informative, that is, if only the depth changes.
bool has_press_curve(const SampleReport& sample) {
  const auto only_pressed = [](const PhaseReport& phase) {
    using enum PhaseKind;
    const auto kinds = {reference, approach, press, release};
    return std::any_of(kinds.begin(), kinds.end(), [&](PhaseKind kind) { return phase.name == name_of(kind); });
  };
  return !sample.frames.empty() && std::all_of(sample.phases.begin(), sample.phases.end(), only_pressed) &&
         std::all_of(sample.frames.begin(), sample.frames.end(), [](const auto& f) { return f.depth_m.has_value(); });
}

/// Figures in a row; each kind of figures has a row of its own.
std::string figure_row(const std::string& figures) {
  return figures.empty() ? "" : "<div class=\"pictures\">\n" + figures + "</div>\n";
}

std::string pictures(const SampleReport& sample, const fs::path& folder, Loading loading) {
  std::string curves, markers;
  if (has_press_curve(sample)) curves = figure(press_curve_svg(sample.frames), "<b>Press curve</b>: force over depth");
  curves += frame_curves(sample);
  const View view = view_of(sample.marker_pictures);
  for (const MarkerPicture& picture : sample.marker_pictures)
    markers += figure(quiver_svg(picture, view), marker_caption(picture, sample.phases));
  return figure_row(image_figures(sample, folder, loading)) + figure_row(curves) + figure_row(markers);
}

/// One group of facts; `lines` are pairs of a name and HTML.
std::string facts(const std::string& heading, const std::vector<std::pair<std::string, std::string>>& lines) {
  std::string html = "<div><h4>" + heading + "</h4><dl>";
  for (const auto& [name, value] : lines) html += fmt::format("<dt>{}</dt><dd>{}</dd>", html_text(name), value);
  return html + "</dl></div>\n";
}

/// Facts of a press; for a failed one only those that are known.
std::string press_facts(const SampleReport& sample) {
  std::vector<std::pair<std::string, std::string>> lines;
  if (!sample.motion.empty()) lines.emplace_back("motion", html_text(sample.motion));
  if (sample.depth_m) lines.emplace_back("depth", number_text(sample.depth_m, 1e3) + " mm");
  if (sample.press_force_n) lines.emplace_back("press force", number_text(sample.press_force_n) + " N");
  if (sample.tangential_force_n) lines.emplace_back("tangential force", number_text(sample.tangential_force_n) + " N");
  if (const auto& end = sample.press_end_frame; end && *end + 1 < static_cast<int>(sample.frames.size())) {
    lines.emplace_back(
        "at the end of the press",
        fmt::format("{} N (frame {})", number_text(sample.frames[static_cast<std::size_t>(*end)].press_force_n), *end));
  }
  if (sample.min_distance_m) lines.emplace_back("smallest distance", number_text(sample.min_distance_m, 1e6) + " µm");
  if (sample.min_volume_ratio) lines.emplace_back("smallest volume ratio", number_text(sample.min_volume_ratio));
  if (sample.newton_iterations) lines.emplace_back("Newton iterations", count_text(sample.newton_iterations));
  if (sample.gel_vertices) lines.emplace_back("gel vertices", count_text(sample.gel_vertices));
  if (!sample.element.empty()) lines.emplace_back("elements", html_text(sample.element));
  return lines.empty() ? "" : facts("Press", lines);
}

std::string friction_facts(const SampleReport& sample) {
  if (!sample.friction_coefficient) return "";
  if (*sample.friction_coefficient == 0.0) return facts("Friction", {{"coefficient", "0 (frictionless)"}});
  const auto time = [](std::optional<double> time_s) { return time_s ? number_text(time_s) + " s" : "never"; };
  return facts("Friction", {{"coefficient", fmt::format("{:g}", *sample.friction_coefficient)},
                            {"first slip", time(sample.first_slip_time_s)},
                            {"gross slip", time(sample.gross_slip_time_s)}});
}

std::string checks_table(const SampleReport& sample) {
  if (sample.checks.empty()) return "";
  std::string table = "<div class=\"checks\"><h4>Verdict</h4><table>\n<tbody>\n";
  for (const CheckReport& check : sample.checks) {
    table += fmt::format(
        "<tr><td class=\"word\"><span class=\"mark {}\">{}</span>{}</td><td class=\"word\">{}{}</td>"
        "<td class=\"word quiet\">limit: {}</td></tr>\n",
        check.held ? "held" : "missed", check.held ? "✓" : "✗", html_text(check.name), html_text(check.value),
        check.frame ? fmt::format(" (frame {})", *check.frame) : "", html_text(check.limit));
  }
  return table + "</tbody></table></div>\n";
}

std::string placement_facts(const PlacementReport& placement) {
  return facts(
      "Placement",
      {{"side that presses",
        fmt::format("{} <span class=\"quiet\">({})</span>", html_text(placement.face), html_text(placement.chosen))},
       {"turned about z", fmt::format("{:g}°", placement.rotate_deg)},
       {"centre on the gel", fmt::format("x {:g} mm, y {:g} mm", placement.center_x_mm, placement.center_y_mm)}});
}

std::string decimate_facts(const DecimateReport& mesh) {
  std::vector<std::pair<std::string, std::string>> lines{
      {"vertices", count_text(mesh.vertices_in) + " → " + count_text(mesh.vertices_out) +
                       (mesh.passed_through ? " <span class=\"quiet\">(kept as it was)</span>" : "")}};
  if (mesh.hausdorff_mm) lines.emplace_back("Hausdorff distance", number_text(mesh.hausdorff_mm) + " mm");
  if (mesh.findings.empty()) lines.emplace_back("repairs", "none needed");
  for (const auto& [what, how_many] : mesh.findings) lines.emplace_back(what, count_text(how_many));
  return facts("Object mesh", lines);
}

std::string file_links(const char* heading, const std::vector<std::pair<std::string, fs::path>>& files,
                       const fs::path& folder) {
  if (files.empty()) return "";
  std::string links;
  for (const auto& [label, path] : files) {
    links +=
        fmt::format("{}<a href=\"{}\">{}</a>", links.empty() ? "" : " · ", html_link(path, folder), html_text(label));
  }
  return fmt::format("<p class=\"files\"><span class=\"quiet\">{}</span> {}</p>\n", heading, links);
}

}  // namespace

std::string card_id(std::size_t index) { return fmt::format("sample-{}", index + 1); }

std::string verdict_badge(const SampleReport& sample) {
  return sample.passed() ? "<span class=\"verdict passed\">passed</span>"
                         : "<span class=\"verdict failed\">FAILED</span>";
}

std::string sample_body(const SampleReport& sample, const fs::path& folder, Loading loading) {
  std::string card;
  if (sample.failure) card += "<p class=\"note bad\">" + html_text(*sample.failure) + "</p>\n";
  for (const std::string& warning : sample.warnings) card += "<p class=\"note warn\">" + html_text(warning) + "</p>\n";
  card += sample.film + pictures(sample, folder, loading);
  card += "<div class=\"facts\">\n" + press_facts(sample) + friction_facts(sample);
  if (sample.placement) card += placement_facts(*sample.placement);
  if (sample.decimate) card += decimate_facts(*sample.decimate);
  card += checks_table(sample) + "</div>\n" + frames_table(sample);
  card += file_links("Records and logs:", sample.records, folder);
  return card + file_links("Data:", sample.data, folder);
}

std::string sample_card(const SampleReport& sample, std::size_t index, const fs::path& folder) {
  std::string card = fmt::format("<article class=\"card\" id=\"{}\">\n<header><h3>{}</h3>{}", card_id(index),
                                 html_text(sample.name), verdict_badge(sample));
  if (!sample.object.empty()) card += "<span class=\"quiet\">object " + html_text(sample.object) + "</span>";
  if (!sample.view.empty()) card += view_link(sample.view);
  return card + "</header>\n" + sample_body(sample, folder, Loading::in_sight) + "</article>\n";
}

}  // namespace tacipc
