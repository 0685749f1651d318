#include "stages/object/decimate/side_survey.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/image/picture.h"
#include "common/mesh/height_field.h"
#include "common/sample/placement.h"

namespace tacipc {
namespace {

constexpr double kGrid = 300.0;  // points along the longer side

/// Sums of |∇h| dA over rows and columns before (i, j); heights are cut off kPressDepth below the highest.
class ReliefSums {
 public:
  explicit ReliefSums(const HeightField& field) : at_(Eigen::MatrixXd::Zero(field.columns + 1, field.rows + 1)) {
    const double highest = *std::ranges::max_element(field.z);
    const auto felt = [&](int i, int j) { return std::max(0.0, field.at(i, j) - highest + SideSurvey::kPressDepth); };
    const auto there = [&](int i, int j) { return field.at(i, j) != HeightField::kNothing; };
    for (int j = 0; j < field.rows; ++j) {
      for (int i = 0; i < field.columns; ++i) {
        double squared = 0.0;
        if (there(i, j)) {
          const double here = felt(i, j);
          if (i + 1 < field.columns && there(i + 1, j)) squared += std::pow(felt(i + 1, j) - here, 2.0);
          if (j + 1 < field.rows && there(i, j + 1)) squared += std::pow(felt(i, j + 1) - here, 2.0);
        }
        at_(i + 1, j + 1) = at_(i, j + 1) + at_(i + 1, j) - at_(i, j) + std::sqrt(squared) * field.spacing;
      }
    }
  }

  /// Relief over columns first_i … last_i − 1 and rows first_j … last_j − 1, as a length of full steps.
  double relief(int first_i, int last_i, int first_j, int last_j) const {
    const double sum = at_(last_i, last_j) - at_(first_i, last_j) - at_(last_i, first_j) + at_(first_i, first_j);
    return std::max(0.0, sum) / SideSurvey::kPressDepth;
  }

 private:
  Eigen::MatrixXd at_;
};

/// Fraction of the outline's points that lie in the upper fifth of a press's depth.
double rim_touching(const HeightField& field) {
  const double highest = *std::ranges::max_element(field.z);
  const auto there = [&](int i, int j) {
    return i >= 0 && j >= 0 && i < field.columns && j < field.rows && field.at(i, j) != HeightField::kNothing;
  };
  int rim = 0, touching = 0;
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      if (!there(i, j) || (there(i - 1, j) && there(i + 1, j) && there(i, j - 1) && there(i, j + 1))) continue;
      ++rim;
      touching += field.at(i, j) > highest - 0.2 * SideSurvey::kPressDepth ? 1 : 0;
    }
  }
  return rim > 0 ? static_cast<double>(touching) / rim : 0.0;
}

FloatImage height_image(const HeightField& field) {
  FloatImage image(field.columns, field.rows, 1, std::numeric_limits<float>::quiet_NaN());
  const double highest = *std::ranges::max_element(field.z);
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      if (field.at(i, j) == HeightField::kNothing) continue;
      image.at(i, j, 0) = static_cast<float>(std::max(0.0, field.at(i, j) - highest + SideSurvey::kPressDepth));
    }
  }
  return image;
}

SideView look_at(const TriangleMesh& mesh, const std::string& side, const std::array<double, 2>& window_m) {
  // The object as it presses into the gel, seen from the gel.
  TriangleMesh seen = mesh;
  seen.positions = transformed(place(mesh.positions, {.face = side}, 0.0), mesh.positions);
  seen.positions.col(2) *= -1.0;
  const Eigen::RowVector3d extent = seen.positions.colwise().maxCoeff() - seen.positions.colwise().minCoeff();
  SideView view{.side = side, .extent_m = {extent.x(), extent.y()}};
  const double spacing_m = std::max(extent.head<2>().maxCoeff() / kGrid, 1e-9);
  const HeightField field = highest_points(seen, spacing_m, 0.0);
  if (*std::ranges::max_element(field.z) == HeightField::kNothing) return view;
  const auto shown = std::ranges::count_if(field.z, [](double z) { return z != HeightField::kNothing; });
  view.shown_m2 = static_cast<double>(shown) * spacing_m * spacing_m;
  view.rim_touching = rim_touching(field);
  const ReliefSums sums(field);
  const int wide = std::min(field.columns, static_cast<int>(std::lround(window_m[0] / spacing_m)));
  const int high = std::min(field.rows, static_cast<int>(std::lround(window_m[1] / spacing_m)));
  const int middle_i = (field.columns - wide) / 2, middle_j = (field.rows - high) / 2;
  view.centered_relief_m = sums.relief(middle_i, middle_i + wide, middle_j, middle_j + high);
  view.relief_m = view.centered_relief_m;
  constexpr double kBetter = 1.1;
  double least_wanted = kBetter * view.centered_relief_m;
  for (int j = 0; j + high <= field.rows; ++j) {
    for (int i = 0; i + wide <= field.columns; ++i) {
      const double relief = sums.relief(i, i + wide, j, j + high);
      if (relief <= least_wanted) continue;
      least_wanted = view.relief_m = relief;
      view.place_m = {(i - 0.5 * (field.columns - wide)) * spacing_m, (j - 0.5 * (field.rows - high)) * spacing_m};
    }
  }
  view.height = height_image(field);
  return view;
}

void draw_frame(ByteImage& image, int left, int top, int right, int bottom, const std::array<std::uint8_t, 3>& color) {
  const auto put = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
    for (int c = 0; c < 3; ++c) image.at(x, y, c) = color[c];
  };
  for (int width = 0; width < 2; ++width) {
    for (int x = left; x <= right; ++x) put(x, top + width), put(x, bottom - width);
    for (int y = top; y <= bottom; ++y) put(left + width, y), put(right - width, y);
  }
}

}  // namespace

bool SideSurvey::wider_than_window() const {
  return side().extent_m[0] > window_m[0] || side().extent_m[1] > window_m[1];
}

bool SideSurvey::uniform() const {
  constexpr double kFlat = 0.02;  // fraction of the window's width
  return side().extent_m[0] > window_m[0] && side().extent_m[1] > window_m[1] && side().relief_m < kFlat * window_m[0];
}

SideSurvey survey_sides(const TriangleMesh& mesh, const SensorWindow& window, const std::string& wanted) {
  SideSurvey survey{.window_m = window.size_m, .views = std::vector<SideView>(face_names().size())};
  tbb::parallel_for(std::size_t{0}, survey.views.size(),
                    [&](std::size_t i) { survey.views[i] = look_at(mesh, face_names()[i], window.size_m); });
  const auto index_of = [&](const std::string& side) {
    return static_cast<std::size_t>(std::ranges::find(face_names(), side) - face_names().begin());
  };
  survey.given = index_of(wanted) < survey.views.size();
  survey.pressed = index_of(survey.given ? wanted : window.usual);
  if (survey.given) return survey;
  const auto widest = std::ranges::max_element(
      survey.views, [](const SideView& a, const SideView& b) { return a.shown_m2 < b.shown_m2; });
  constexpr double kEdge = 0.05;  // fraction of the area; a side that shows less is an edge
  if (survey.side().shown_m2 < kEdge * widest->shown_m2)
    survey.pressed = static_cast<std::size_t>(widest - survey.views.begin());
  // Something that stands out of a side is meant to press, rather than the base below it or a socket in it.
  constexpr double kStandsOut = 1e-3, kBroad = 0.2;
  const auto has_tip = [&](const SideView& view) {
    return view.rim_touching < 0.5 && view.relief_m > kStandsOut && view.shown_m2 > kBroad * widest->shown_m2;
  };
  const bool some_tip = std::ranges::any_of(survey.views, has_tip);
  constexpr double kBetter = 1.25;
  double least_wanted = some_tip && !has_tip(survey.side()) ? 0.0 : kBetter * survey.side().relief_m;
  for (std::size_t i = 0; i < survey.views.size(); ++i) {
    const SideView& view = survey.views[i];
    if (view.relief_m <= least_wanted || (some_tip && !has_tip(view))) continue;
    least_wanted = view.relief_m;
    survey.pressed = i;
  }
  return survey;
}

ByteImage picture_of_sides(const SideSurvey& survey) {
  constexpr int kTile = 200, kGap = 12;
  constexpr std::array<std::uint8_t, 3> kFrame{21, 112, 60}, kWindow{255, 255, 255};
  double longest = 0.0;
  for (const SideView& view : survey.views) longest = std::max({longest, view.extent_m[0], view.extent_m[1]});
  const double scale = (kTile - 2 * kGap) / longest;  // pixels per metre, the same for all views
  ByteImage sheet(3 * kTile, 2 * kTile, 3, 243);
  for (std::size_t k = 0; k < survey.views.size(); ++k) {
    const SideView& view = survey.views[k];
    const int left = static_cast<int>(k / 2) * kTile, top = static_cast<int>(k % 2) * kTile;
    const double middle_x = left + 0.5 * kTile, middle_y = top + 0.5 * kTile;
    if (view.height.width > 0) {
      const ByteImage colors = picture_of_scalar(view.height, 0.0, SideSurvey::kPressDepth);
      for (int y = top; y < top + kTile; ++y) {
        for (int x = left; x < left + kTile; ++x) {
          const double u = 0.5 + (x + 0.5 - middle_x) / (scale * view.extent_m[0]);
          const double v = 0.5 + (y + 0.5 - middle_y) / (scale * view.extent_m[1]);
          if (!(u >= 0.0 && v >= 0.0 && u < 1.0 && v < 1.0)) continue;
          const int i = static_cast<int>(u * view.height.width), j = static_cast<int>(v * view.height.height);
          if (std::isnan(view.height.at(i, j, 0))) continue;
          for (int c = 0; c < 3; ++c) sheet.at(x, y, c) = colors.at(i, j, c);
        }
      }
    }
    if (k != survey.pressed) continue;
    draw_frame(sheet, left + 2, top + 2, left + kTile - 3, top + kTile - 3, kFrame);
    const auto pixel = [&](double middle, double at_m) { return static_cast<int>(std::lround(middle + scale * at_m)); };
    draw_frame(sheet, pixel(middle_x, view.place_m[0] - 0.5 * survey.window_m[0]),
               pixel(middle_y, view.place_m[1] - 0.5 * survey.window_m[1]),
               pixel(middle_x, view.place_m[0] + 0.5 * survey.window_m[0]),
               pixel(middle_y, view.place_m[1] + 0.5 * survey.window_m[1]), kWindow);
  }
  return sheet;
}

}  // namespace tacipc
