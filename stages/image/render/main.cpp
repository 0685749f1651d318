
#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/parse.h"
#include "common/image/picture.h"
#include "common/sample/dataset_maps.h"
#include "common/sample/render_folder.h"
#include "common/stage/stage.h"
#include "stages/image/render/height_maps.h"
#include "stages/image/render/pressed_gel.h"
#include "stages/image/render/render.h"
#include "stages/image/render/traction_parts.h"

namespace {

using namespace tacipc;

const StageSpec kRender{
    .name = "render",
    .summary = "Make tactile images of a pressed gel: light, shadows, depth, normals, contact, markers, noise.",
    .inputs = {{.flag = "--config", .help = "render settings (YAML)"},
               {.flag = "--sensor", .help = "the sensor: lights, camera, coating (YAML)"},
               {.flag = "--gel", .help = "gel.msh of tetmesh", .required = false},
               {.flag = "--press", .help = "folder that press wrote", .required = false},
               {.flag = "--shapes",
                .help = "indentation maps (EXR), one per frame, in place of a press",
                .required = false,
                .many = true},
               {.flag = "--maps",
                .help = "maps that a dataset wants (YAML, made by plan), in its precision; else all, as computed",
                .required = false}},
    .options = {{.flag = "--seed", .help = "seed of the sample (a count), for noise of its own", .fallback = ""}}};

/// Image of labels as the 8-bit values in its file.
template <typename Label>
ByteImage coded(const ByteImage& labels, std::uint8_t (*code)(Label)) {
  ByteImage image = labels;
  for (std::uint8_t& value : image.pixels) value = code(static_cast<Label>(value));
  return image;
}

/// Writes the requested files of a frame: those that a dataset names, or all.
class FrameWriter {
 public:
  /// \param pressure also write the two parts of the traction, if no dataset restricts the files
  FrameWriter(Stage& stage, std::optional<DatasetMaps> maps, bool pressure)
      : stage_(stage), maps_(std::move(maps)), pressure_(pressure) {}

  bool wants(FrameFile file) const {
    if (maps_) return maps_->has(file);
    return pressure_ || (file != FrameFile::pressure && file != FrameFile::shear);
  }

  void write(const RenderedFrame& frame) {
    folder_ = frame_folder(static_cast<std::size_t>(frame.index), frame.unit);
    if (!frame.linear.pixels.empty()) put(FrameFile::linear, frame.linear);
    for (std::size_t g = 0; g < frame.basis.size(); ++g)
      write_frame(stage_, folder_, FrameFile::basis, frame.basis[g], g);
    put(FrameFile::tactile, frame.tactile.image);
    if (frame.marker) put(FrameFile::marker, frame.marker->image);
    if (frame.trace) write_maps(*frame.trace);
    if (frame.marker_px.rows() > 0) write_marker_px(stage_, folder_, frame.marker_px.leftCols<2>());
  }

 private:
  void write_maps(const TraceResult& trace) {
    put(FrameFile::depth, trace.depth);
    put(FrameFile::normal, trace.normal);
    put(FrameFile::indentation, trace.indentation);
    if (wants(FrameFile::normal_picture)) put(FrameFile::normal_picture, picture_of_normals(trace.normal));
    if (wants(FrameFile::indentation_picture))
      put(FrameFile::indentation_picture, picture_of_height(trace.indentation));
    put(FrameFile::segment, coded(trace.segment, segment_code));
    if (trace.traction.channels == 0) return;
    put(FrameFile::traction, trace.traction);
    if (wants(FrameFile::pressure) || wants(FrameFile::shear)) {
      const TractionParts parts = parts_of(trace.traction, trace.normal);
      put(FrameFile::pressure, parts.pressure);
      put(FrameFile::shear, parts.shear);
    }
    put(FrameFile::contact, coded(trace.contact, contact_code));
    put(FrameFile::stick_slip, coded(trace.contact, stick_slip_code));
  }

  void put(FrameFile file, const FloatImage& image) {
    if (wants(file)) write_frame(stage_, folder_, file, image, 0, maps_ ? Digits::of_datasets : Digits::all);
  }
  void put(FrameFile file, const ByteImage& image) {
    if (wants(file)) write_frame(stage_, folder_, file, image);
  }

  Stage& stage_;
  std::optional<DatasetMaps> maps_;
  bool pressure_;
  std::string folder_;
};

/// Numbers of values of the sensor file that are known, derived and guessed.
Value::Map count_sources(const Sensor& sensor) {
  Value::Map counts;
  for (const std::string source : {"known", "derived", "guess", "unstated"})
    counts.emplace_back(source, static_cast<int>(std::ranges::count(sensor.sources, source, &ValueSource::source)));
  return counts;
}

/// LEDs shown by the basis images, in the order of their numbers.
Value::List groups_of(const Sensor& sensor) {
  Value::List lines;
  for (const LightGroup& group : light_groups(sensor.leds)) {
    Value::Map line;
    if (!group.name.empty()) line.emplace_back("name", group.name);
    line.emplace_back("leds", Value::List(group.leds.begin(), group.leds.end()));
    lines.emplace_back(std::move(line));
  }
  return lines;
}

/// \throw UsageError if it is not a count
std::optional<std::uint64_t> sample_seed(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto seed = parse_number<std::uint64_t>(text);
  if (!seed) throw UsageError("--seed: '" + text + "' is not a count");
  return seed;
}

/// Loads the photograph, which becomes an input of the stage; without one the record has `synthetic`.
std::optional<ByteImage> load_reference(Stage& stage, const Sensor& sensor, const std::string& name) {
  if (!sensor.reference_image) return std::nullopt;
  stage.add_input(name, *sensor.reference_image);
  return read_reference(*sensor.reference_image, sensor.camera);
}

std::optional<DatasetMaps> read_maps(Stage& stage) {
  if (!stage.optional_input("--maps")) return std::nullopt;
  return stage.read_config<DatasetMaps>("--maps");
}

std::vector<RenderUnit> all_units(Stage& stage, const Sensor& sensor, const RenderConfig& config) {
  std::vector<RenderUnit> units{{.sensor = sensor, .reference = load_reference(stage, sensor, "reference")}};
  for (const Variant& variant : config.variants) {
    std::optional<Sensor> other;
    if (variant.sensor) {
      stage.add_input(variant.name + "_sensor", *variant.sensor);
      other = read_config<Sensor>(*variant.sensor);
    }
    RenderUnit unit{.name = variant.name, .sensor = varied(sensor, variant, other), .needs_rays = variant.needs_rays()};
    unit.reference = load_reference(stage, unit.sensor, variant.name + "_reference");
    units.push_back(std::move(unit));
  }
  return units;
}

RenderSummary render_press(Stage& stage, const std::vector<RenderUnit>& units, const RenderConfig& config,
                           const std::function<void(const RenderedFrame&)>& deliver) {
  const TetMesh gel = read_tet_mesh(*stage.optional_input("--gel"));
  return render(units, config, PressedGel(*stage.optional_input("--press"), gel), deliver);
}

RenderSummary render_shapes(Stage& stage, const std::vector<RenderUnit>& units, const RenderConfig& config,
                            const std::function<void(const RenderedFrame&)>& deliver) {
  const Sensor& sensor = units.front().sensor;
  auto maps = read_height_maps(stage.inputs("--shapes"), sensor.camera);
  return render(units, config, HeightMaps(std::move(maps), sensor, config.trace.refract), deliver);
}

Value::Map summary_of(const UnitSummary& unit) {
  Value::Map lines;
  if (unit.exposure) lines.emplace_back("exposure", *unit.exposure);
  lines.emplace_back("reference_mean_code", unit.reference_mean_code);
  lines.emplace_back("clipped_fraction", unit.clipped_fraction);
  return lines;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kRender, argc, argv, [](Stage& stage) {
    const bool press = stage.optional_input("--press").has_value(), gel = stage.optional_input("--gel").has_value();
    if (press != gel) throw UsageError("--press and --gel belong together");
    if (press != stage.inputs("--shapes").empty()) throw UsageError("give either --press and --gel, or --shapes");
    auto config = stage.read_config<RenderConfig>("--config");
    if (const auto seed = sample_seed(stage.option("--seed")))
      config.noise_seed = noise_seed_of_sample(config.noise_seed, *seed);
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const std::vector<RenderUnit> units = all_units(stage, sensor, config);
    if (sensor.reference_image) {
      stage.note("reference", content_hash(*sensor.reference_image));
    } else {
      stage.note("reference", "synthetic");
    }
    const bool stress = press && PressFolder(*stage.optional_input("--press")).has(PressArray::front_pressure);
    FrameWriter writer(stage, read_maps(stage), stress);
    config.linear = writer.wants(FrameFile::linear);
    config.marker = writer.wants(FrameFile::marker);
    const auto deliver = [&](const RenderedFrame& frame) { writer.write(frame); };
    const RenderSummary summary = stage.inputs("--shapes").empty() ? render_press(stage, units, config, deliver)
                                                                   : render_shapes(stage, units, config, deliver);
    Value::Map lines = {{"frames", Value::List(summary.frames.begin(), summary.frames.end())}};
    for (auto& line : summary_of(summary.units.front())) lines.push_back(line);
    lines.insert(lines.end(), {{"rays", summary.rays},
                               {"nudged_rays", summary.nudged_rays},
                               {"outside_rays", summary.outside_rays},
                               {"max_indentation_mm", 1e3 * summary.max_indentation_m},
                               {"indirect_share", summary.indirect_share},
                               {"sensor_values", count_sources(sensor)}});
    if (config.basis_images) lines.emplace_back("basis", groups_of(sensor));
    Value::List variants;
    for (std::size_t u = 1; u < summary.units.size(); ++u) {
      Value::Map line = {{"name", summary.units[u].name},
                         {"reference", summary.units[u].real_reference ? "photograph" : "synthetic"}};
      for (auto& entry : summary_of(summary.units[u])) line.push_back(entry);
      variants.emplace_back(std::move(line));
    }
    if (!variants.empty()) lines.emplace_back("variants", std::move(variants));
    stage.summarize(lines);
  });
}
