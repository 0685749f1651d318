#include "stages/dataset/report/page_parts.h"

#include <fmt/core.h>

#include "common/format/html_text.h"
#include "common/image/picture.h"
#include "stages/dataset/report/page_style.h"

namespace tacipc {
namespace {

/// The colours of the indentation picture as a style of their own.
std::string color_bar_style() {
  constexpr int kStops = 17;
  std::string stops;
  for (int i = 0; i < kStops; ++i) {
    const double t = static_cast<double>(i) / (kStops - 1);
    const auto [r, g, b] = perceptual_color(t);
    stops += fmt::format(", rgb({} {} {}) {:g}%", r, g, b, 100.0 * t);
  }
  return ".bar i { background: linear-gradient(90deg" + stops + "); }\n";
}

constexpr const char* kLegend = R"html(<section id="legend">
<h2>How to read this page</h2>
<dl>
<dt>Tactile image</dt><dd>What the sensor's camera sees from behind: the gel's reflecting front face, lit by coloured LEDs, deformed by the object. Colour shows the slope of the face. Image right is x, image down is y.</dd>
<dt>Indentation</dt><dd>How far the material seen in each pixel has moved into the gel.</dd>
<dt>Normals</dt><dd>The direction of the front face as a colour: (n + 1) / 2 per component, x red, y green, z blue.</dd>
<dt>Press curve</dt><dd>Force of the object on the gel, into the gel, over the depth of the object's lowest point below the undeformed face; one mark per frame. Depth below zero: the object is still above the gel.</dd>
<dt>Forces</dt><dd>On the gel by the object: press force into the gel, tangential force along the face. In the table of all samples they are those of the last frame, the depth is that at the end of the press.</dd>
<dt>Contact</dt><dd>Area of the front face in contact, and press force over that area.</dd>
<dt>Force balance</dt><dd>Contact force, inertia and the force of the mount that holds the gel's back must cancel; the residual, relative to the contact force. Each card gives its limit.</dd>
<dt>Markers</dt><dd>Points printed on the front face and their displacement along it, enlarged as the scale arrow says. Beneath them the contacts, sticking and slipping.</dd>
<dt>Verdict</dt><dd>A sample has passed if every check of its press is within its limit in every frame and if its images exist.</dd>
<dt>Smallest distance</dt><dd>Between gel and object over all frames. It stays above zero: a barrier keeps the surfaces a small distance apart, so they never cross.</dd>
<dt>Smallest volume ratio</dt><dd>Volume of the most compressed tetrahedron of the gel, over its volume at rest. Zero would be inversion.</dd>
<dt>Hausdorff</dt><dd>Largest distance between the surface of the scan and the simplified surface that is simulated.</dd>
<dt>Reference image</dt><dd>The photograph without contact that gives the image its noise: real, or synthetic where the sensor file names none.</dd>
</dl>
</section>
)html";

}  // namespace

std::string page_head(const std::string& title, const std::string& style) {
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         html_text(title) + "</title>\n" + style + "\n</head>\n";
}

std::string page_style() { return kPageStyle + color_bar_style(); }

std::string tile(const std::string& number, const std::string& words, const std::string& kind) {
  return fmt::format("<li class=\"{}\"><b>{}</b>{}</li>\n", kind, number, words);
}

std::string legend() { return kLegend; }

}  // namespace tacipc
