// Fits another simulator's light to the same photographs of balls and known objects.
#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/benchmark/ball_labels.h"
#include "common/format/csv.h"
#include "common/sensor/camera_image.h"
#include "common/sensor/camera_model.h"
#include "stages/image/calibrate/fit_metallic.h"
#include "stages/image/calibrate/fit_table.h"
#include "stages/image/calibrate/known_object.h"
#include "stages/image/calibrate/modes.h"
#include "stages/image/calibrate/train_network.h"

namespace tacipc {
namespace {

/// Contacts: circles as labelled, assumed exact, or those of TacIPC's fit.
std::vector<BallDisc> contact_discs(const Stage& stage, const std::vector<BallLabel>& labels, const Sensor& sensor,
                                    double ball_radius_m) {
  const double pixel = sensor.camera.window_width_m / sensor.camera.width_px;
  std::vector<BallDisc> discs;
  if (const auto table = stage.optional_input("--balls")) {
    const CameraModel camera(sensor.camera, sensor.stack);
    CsvReader csv(*table);
    while (csv.next()) {
      const auto number = [&](const char* column) { return std::strtod(csv[column].c_str(), nullptr); };
      const auto center = camera.project({1e-3 * number("x_mm"), 1e-3 * number("y_mm"), 0.0});
      if (!center || discs.size() >= labels.size() || csv["image"] != labels[discs.size()].image)
        throw DataError("{}:{}: {} is not the ball of the labels there", table->string(), csv.line(), csv["image"]);
      discs.push_back({.x_px = center->x() - 0.5,
                       .y_px = center->y() - 0.5,
                       .contact_px = 1e-3 * number("contact_mm") / pixel,
                       .radius_px = ball_radius_m / pixel});
    }
    if (discs.size() != labels.size()) throw DataError("{}: has fewer balls than labels", table->string());
    return discs;
  }
  for (const BallLabel& label : labels)
    discs.push_back(
        {.x_px = label.x_px, .y_px = label.y_px, .contact_px = label.radius_px, .radius_px = ball_radius_m / pixel});
  return discs;
}

/// Samples of the photographs, the balls first.
template <typename Contact>
struct Shown {
  std::vector<Contact> contacts;
  std::size_t balls = 0;  // the remaining samples belong to known objects

  /// Root mean square error over all folds of the samples left out of the fit. Only balls count, as in TacIPC's own
  /// fit.
  /// \param errors `errors(kept, left)` gives the sum of squares and the number of values
  template <typename Errors>
  double held_out_rmse(int folds, const Errors& errors) const {
    double squares = 0.0, count = 0.0;
    for (int fold = 0; fold < folds; ++fold) {
      std::vector<Contact> kept, left;
      for (std::size_t b = 0; b < contacts.size(); ++b)
        (b < balls && static_cast<int>(b) % folds == fold ? left : kept).push_back(contacts[b]);
      const auto [error, codes] = errors(kept, left);
      squares += error;
      count += codes;
    }
    return std::sqrt(squares / count);
  }
};

/// Sum over contact pixels of (table − photograph)², and the number of values.
std::pair<double, double> table_errors(const SlopeTable& table, const std::vector<std::vector<ContactPixel>>& balls,
                                       const Camera& camera) {
  double squares = 0.0, count = 0.0;
  for (const auto& pixels : balls) {
    for (const ContactPixel& pixel : pixels) {
      const auto codes = table.change(pixel.slope_x, pixel.slope_y,
                                      SlopeTable::terms(pixel.x, pixel.y, camera.width_px, camera.height_px));
      for (std::size_t c = 0; c < 3; ++c) {
        if (!pixel.used[c]) continue;
        squares += (codes[c] - pixel.target[c]) * (codes[c] - pixel.target[c]);
        count += 1.0;
      }
    }
  }
  return {squares, count};
}

void calibrate_table(Stage& stage, const RivalFit& fit, const Shown<std::vector<ContactPixel>>& shown,
                     const Camera& camera, int folds) {
  const SlopeTable table = fit_table(shown.contacts, camera.width_px, camera.height_px, fit.table);
  table.write(stage.output("light.npy"));
  const double held_out = shown.held_out_rmse(folds, [&](const auto& kept, const auto& left) {
    return table_errors(fit_table(kept, camera.width_px, camera.height_px, fit.table), left, camera);
  });
  const auto [error, codes] = table_errors(table, shown.contacts, camera);
  stage.summarize({{"held_out_rmse_codes", held_out}, {"rmse_codes", std::sqrt(error / codes)}});
}

void calibrate_network(Stage& stage, const RivalFit& fit, const std::vector<std::vector<ContactPixel>>& contacts,
                       const Camera& camera) {
  const NetworkSamples samples = network_samples(contacts, camera.width_px, camera.height_px);
  const LightNetwork network = train_network(samples, fit.network);
  network.write(stage.output("light.npy"));
  LightNetwork gradient;
  stage.summarize({{"samples", static_cast<std::size_t>(samples.inputs.cols())},
                   {"parameters", num_parameters()},
                   {"rmse_codes", 255.0 * std::sqrt(loss_and_gradient(network, samples, {}, gradient))}});
}

void calibrate_metallic(Stage& stage, const RivalFit& fit, const Shown<MetallicSamples>& shown, int folds) {
  const MetallicLamps lamps = fit_metallic(shown.contacts, fit.lamps);
  write_file(stage.output("light.yaml"), to_yaml(lamps.to_value()));
  const double held_out = shown.held_out_rmse(folds, [&](const auto& kept, const auto& left) {
    double codes = 0.0;
    for (const MetallicSamples& ball : left) codes += ball.samples.used.sum();
    const double rmse = metallic_rmse(left, fit_metallic(kept, fit.lamps));
    return std::pair(rmse * rmse * codes, codes);
  });
  MetallicLamps dark = lamps;
  for (MetallicLamp& lamp : dark.lamps) lamp.rgb = {};
  stage.summarize({{"held_out_rmse_codes", held_out},
                   {"rmse_codes", metallic_rmse(shown.contacts, lamps)},
                   {"rmse_codes_at_start", metallic_rmse(shown.contacts, fit.lamps)},
                   {"rmse_codes_without_light", metallic_rmse(shown.contacts, dark)},
                   {"change_factor", lamps.change_factor}});
}

}  // namespace

void calibrate_rival(Stage& stage) {
  if (!stage.optional_input("--photographs") || !stage.optional_input("--labels"))
    throw UsageError("--rival: needs --photographs and --labels of balls");
  if (stage.optional_input("--press") || stage.optional_input("--gel") || !stage.named_inputs("--object-press").empty())
    throw UsageError("--rival: has membranes of its own; leave out --press, --gel and --object-press");
  const auto& shapes = stage.inputs("--shapes");
  const auto objects = stage.optional_input("--objects") ? stage.read_config<KnownObjectsConfig>("--objects").objects
                                                         : std::vector<KnownObjectConfig>{};
  if (shapes.size() != objects.size())
    throw UsageError(fmt::format("--rival: --shapes has one map for each known object: {} maps, {} objects",
                                 shapes.size(), objects.size()));
  const auto config = stage.read_config<CalibrateConfig>("--config");
  const auto fit = stage.read_config<RivalFit>("--rival");
  const auto sensor = stage.read_config<Sensor>("--sensor");
  const Camera& camera = sensor.camera;
  const ByteImage background = read_photograph(stage.input("--background"), camera);
  const auto labels = read_labels(*stage.optional_input("--labels"));
  if (static_cast<int>(labels.size()) < config.folds)
    throw DataError("{} photographs cannot be divided into {} folds", labels.size(), config.folds);
  const std::vector<BallDisc> discs = contact_discs(stage, labels, sensor, config.ball_radius_m);
  const double pixel = camera.window_width_m / camera.width_px;
  Shown<std::vector<ContactPixel>> unlit{.contacts = {}, .balls = labels.size()};
  Shown<MetallicSamples> lit{.contacts = {}, .balls = labels.size()};
  const bool lamps = fit.model == RivalFit::Model::metallic_roughness;
  const auto drift_of = [&](const Samples& samples) {
    return fit.remove_drift ? samples.drift : std::array<double, 3>{};
  };
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const ByteImage photograph = read_photograph(*stage.optional_input("--photographs") / labels[i].image, camera);
    const Samples samples = make_samples(photograph, background, labels[i], config);
    if (!lamps) {
      unlit.contacts.push_back(disc_pixels(discs[i], photograph, background, drift_of(samples)));
      continue;
    }
    const auto center = CameraModel(camera, sensor.stack).on_plane(discs[i].x_px + 0.5, discs[i].y_px + 0.5);
    if (!center) throw DataError("{}: the camera does not see the front face at the label's centre", labels[i].image);
    const double contact = std::min(discs[i].contact_px * pixel, config.ball_radius_m);
    const double above = std::sqrt(config.ball_radius_m * config.ball_radius_m - contact * contact);
    lit.contacts.push_back(
        metallic_samples(samples, {center->x(), center->y(), above}, config.ball_radius_m, fit.lamps.lamps, sensor));
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const FloatImage height = read_camera_exr(shapes[i], {"Y"}, camera);
    if (!(*std::ranges::max_element(height.pixels) > 0.0F))
      throw DataError("{}: {} is not in the gel", shapes[i].string(), objects[i].name);
    const ByteImage photograph =
        read_photograph(*stage.optional_input("--photographs") / objects[i].photograph, camera);
    // Tables and networks are trained on the contact alone; pixels around the box determine their drift.
    const Samples samples = object_samples(objects[i].grown(lamps ? config.object_margin_px : 0), photograph,
                                           background, config.fit_stride_px);
    if (lamps)
      lit.contacts.push_back(metallic_samples(samples, height, fit.lamps.lamps, sensor));
    else
      unlit.contacts.push_back(object_pixels(height, pixel, photograph, background, drift_of(samples)));
  }
  stage.summarize({{"photographs", labels.size()}, {"objects", objects.size()}});
  switch (fit.model) {
    case RivalFit::Model::table: return calibrate_table(stage, fit, unlit, camera, config.folds);
    case RivalFit::Model::network: return calibrate_network(stage, fit, unlit.contacts, camera);
    case RivalFit::Model::metallic_roughness: return calibrate_metallic(stage, fit, lit, config.folds);
  }
}

}  // namespace tacipc
