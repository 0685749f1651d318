#include "stages/dataset/plan/motion_template.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/base/files.h"
#include "common/base/text_reader.h"
#include "common/sample/motion.h"
#include "common/sample/placement.h"

namespace tacipc {
namespace {

constexpr int kMaxSteps = 100000;
const std::vector<std::string> kKinds{"press", "shear", "twist", "tilt", "hold", "release", "load", "free", "path"};
const std::vector<std::string> kGraspKinds{"close", "lift", "shake", "hold", "release"};

/// Six digits: finer than any real setting of these lengths and angles, and short to read.
std::string number_text(double value) { return fmt::format("{:.6g}", value); }

/// Number of nonblank lines from the first one that begins like a number; earlier lines are headings.
int rows_of(const std::filesystem::path& file) {
  constexpr std::string_view kNumeric = "0123456789.+-";
  const std::string text = read_file(file);
  TextReader lines(text, file.string());
  int rows = 0;
  while (lines.next_line())
    if (rows > 0 || kNumeric.find(lines.rest().front()) != std::string_view::npos) ++rows;
  return rows;
}

}  // namespace

Draw Draw::read(ConfigReader& in, const std::string& key, const Range& range) {
  if (!in.is_list(key)) {
    const double value = in.number(key, range);
    return {value, value};
  }
  const auto ends = in.numbers(key, 2, range);
  if (ends[0] > ends[1]) in.fault(key, "a range goes from the lower to the higher number");
  return {ends[0], ends[1]};
}

Draw Draw::read_or(ConfigReader& in, const std::string& key, double fallback, const Range& range) {
  if (in.has(key)) return read(in, key, range);
  in.number_or(key, fallback);
  return {fallback, fallback};
}

PhaseTemplate PhaseTemplate::read(ConfigReader& in) {
  PhaseTemplate phase;
  phase.kind = in.choice("kind", kKinds);
  const auto take = [&](const std::string& key, const Range& range) {
    phase.numbers.push_back({key, Draw::read(in, key, range)});
  };
  const auto take_if_given = [&](const std::string& key, const Range& range) {
    if (in.has(key)) take(key, range);
  };
  if (phase.kind == "press") {
    if (in.has("force_n") && in.has("depth_mm")) in.fault("force_n", "a press has a depth_mm or a force_n, not both");
    take_if_given("force_n", Range::positive());
    if (!in.has("force_n") || in.has("depth_mm")) take("depth_mm", Range::positive());
  } else if (phase.kind == "shear") {
    take("distance_mm", Range::positive());
    take_if_given("direction_deg", Range::any());
  } else if (phase.kind == "twist") {
    take("angle_deg", Range::any());
  } else if (phase.kind == "tilt") {
    take("angle_deg", Range::between(-89.0, 89.0));
    take_if_given("direction_deg", Range::any());
  } else if (phase.kind == "release") {
    take_if_given("height_mm", Range::any());
  } else if (phase.kind == "load" || (phase.kind == "free" && in.has("force_n"))) {
    const Vector3 force = in.vector3("force_n");
    phase.words.push_back({"force_n", fmt::format("[{}, {}, {}]", number_text(force.x()), number_text(force.y()),
                                                  number_text(force.z()))});
    if (phase.kind == "load") phase.words.push_back({"free", in.text_or("free", "xyz")});
  }
  if (phase.kind == "path") {
    phase.path_file = (std::filesystem::path(in.source()).parent_path() / in.text("file")).lexically_normal();
    phase.words.push_back({"relative_to", in.choice_or("relative_to", "placement", {"placement", "sensor"})});
    if (in.has("file")) {
      if (!std::filesystem::is_regular_file(phase.path_file)) {
        in.fault("file", phase.path_file.string() + " does not exist");
      } else {
        phase.frames = rows_of(phase.path_file) - 1;
        if (phase.frames < 1) in.fault("file", phase.path_file.string() + " has fewer than two rows");
      }
    }
  } else {
    phase.frames = in.integer("steps", 1, kMaxSteps);
    phase.words.push_back({"steps", std::to_string(phase.frames)});
  }
  phase.words.push_back({"substeps", std::to_string(in.integer_or("substeps", 1, 1, 1000))});
  return phase;
}

PhaseTemplate PhaseTemplate::read_of_grasp(ConfigReader& in) {
  PhaseTemplate phase;
  phase.kind = in.choice("kind", kGraspKinds);
  const auto take = [&](const std::string& key) {
    phase.numbers.push_back({key, Draw::read(in, key, Range::positive())});
  };
  if (phase.kind == "close") take("force_n");
  if (phase.kind == "lift" || phase.kind == "release") take("distance_mm");
  if (phase.kind == "shake") {
    take("amplitude_mm"), take("frequency_hz");
    phase.words.push_back({"axis", in.choice_or("axis", "z", {"y", "z"})});
  }
  phase.frames = in.integer("steps", 1, kMaxSteps);
  phase.words.push_back({"steps", std::to_string(phase.frames)});
  phase.words.push_back({"substeps", std::to_string(in.integer_or("substeps", 1, 1, 1000))});
  return phase;
}

namespace {

/// Reads a vector of the object: a list of numbers, or a map of x, y, z whose numbers may have ranges.
std::vector<PhaseTemplate::Number> read_vector(ConfigReader& in, const std::string& key) {
  std::vector<PhaseTemplate::Number> numbers;
  if (in.has(key) && !in.is_list(key)) {
    ConfigReader axes = in.section(key);
    for (const char* axis : {"x", "y", "z"}) numbers.push_back({axis, Draw::read_or(axes, axis, 0.0, Range::any())});
  } else {
    for (const double at : in.numbers_or(key, {0.0, 0.0, 0.0})) numbers.push_back({"", {at, at}});
  }
  return numbers;
}

}  // namespace

FingersTemplate FingersTemplate::read(ConfigReader& fingers, ConfigReader& object) {
  FingersTemplate grasp;
  if (auto draw = fingers.optional_section("draw")) {
    grasp.draw = GraspDraw::read_limits(*draw);
    for (const char* key : {"rotation_xyzw", "turn_deg", "grip_mm"})
      if (fingers.has(key)) fingers.fault(key, "is drawn: give it or draw, not both"), fingers.ignore(key);
  } else {
    const Eigen::Quaterniond q = read_rotation(fingers);
    grasp.words.push_back({"rotation_xyzw", fmt::format("[{}, {}, {}, {}]", q.x(), q.y(), q.z(), q.w())});
    grasp.numbers.push_back({"turn_deg", Draw::read_or(fingers, "turn_deg", 0.0, kAnyTurn)});
    grasp.grip_mm = read_vector(fingers, "grip_mm");
  }
  const auto gravity = fingers.numbers_or("gravity_m_s2", {0.0, 0.0, -9.81});
  grasp.words.push_back({"gravity_m_s2", fmt::format("[{}, {}, {}]", gravity[0], gravity[1], gravity[2])});
  grasp.numbers.push_back(
      {"closing_speed_mm_s", Draw::read_or(fingers, "closing_speed_mm_s", 20.0, Range::positive())});
  const bool mass = object.has("mass_g"), margin = object.has("friction_margin");
  if (mass + margin + object.has("density_kg_m3") > 1)
    object.fault("", "give one of mass_g, friction_margin, density_kg_m3");
  grasp.weight.key = mass ? "mass_g" : margin ? "friction_margin" : "density_kg_m3";
  grasp.weight.draw = Draw::read(object, grasp.weight.key, Range::positive());
  grasp.weight.draw.log_uniform = margin;
  if (object.has("friction")) grasp.friction = Draw::read(object, "friction", Range::between(0.0, 10.0));
  if (object.has("center_of_mass_shift_mm")) grasp.center_shift_mm = read_vector(object, "center_of_mass_shift_mm");
  return grasp;
}

std::vector<const Draw*> FingersTemplate::draws() const {
  std::vector<const Draw*> all;
  for (const auto* list : {&grip_mm, &numbers})
    for (const auto& number : *list) all.push_back(&number.draw);
  all.push_back(&weight.draw);
  if (friction) all.push_back(&*friction);
  for (const auto& number : center_shift_mm) all.push_back(&number.draw);
  return all;
}

const Draw* PhaseTemplate::number(const std::string& key) const {
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const Number& n) { return n.key == key; });
  return found == numbers.end() ? nullptr : &found->draw;
}

MotionTemplate MotionTemplate::read(ConfigReader& in) {
  MotionTemplate motion;
  if (auto fingers = in.optional_section("fingers")) {
    if (in.has("placement"))
      in.fault("placement", "fingers hold the object: there is no placement"), in.ignore("placement");
    ConfigReader object = in.section("object");
    motion.fingers = FingersTemplate::read(*fingers, object);
    for (ConfigReader& phase : in.one_or_more_sections("motion")) {
      motion.phases.push_back(PhaseTemplate::read_of_grasp(phase));
      if (motion.phases.size() == 1 && motion.phases[0].kind != "close")
        phase.fault("kind", "fingers close first: nothing is held before");
    }
    return motion;
  }
  if (auto placement = in.optional_section("placement")) {
    if (placement->has("face")) motion.face = placement->choice("face", face_names());
    motion.may_miss = placement->flag_or("may_miss", false);
    motion.rotate_deg = Draw::read_or(*placement, "rotate_deg", 0.0, Range::any());
    if (placement->is_list("center_mm")) {
      const auto center = placement->numbers("center_mm", 2);
      motion.center_x_mm = {center[0], center[0]};
      motion.center_y_mm = {center[1], center[1]};
    } else if (auto center = placement->optional_section("center_mm")) {
      motion.center_x_mm = Draw::read(*center, "x", Range::any());
      motion.center_y_mm = Draw::read(*center, "y", Range::any());
    }
  }
  if (auto object = in.optional_section("object"))
    motion.object_density_kg_m3 = object->number("density_kg_m3", Range::positive());
  for (ConfigReader& phase : in.one_or_more_sections("motion")) {
    motion.phases.push_back(PhaseTemplate::read(phase));
    if (motion.object_density_kg_m3) continue;
    if (motion.phases.back().kind == "free")
      phase.fault("kind", "the object is free only if its object.density_kg_m3 is given");
    else if (phase.has("force_n"))
      phase.fault("force_n", "a force moves the object only if its object.density_kg_m3 is given");
  }
  return motion;
}

int MotionTemplate::dimensions() const {
  int count = center_x_mm.ranged() + center_y_mm.ranged() + rotate_deg.ranged();
  if (fingers)
    for (const Draw* draw : fingers->draws()) count += draw->ranged();
  for (const PhaseTemplate& phase : phases)
    for (const auto& number : phase.numbers) count += number.draw.ranged();
  return count;
}

int MotionTemplate::frames() const {
  int frames = 0;
  for (const PhaseTemplate& phase : phases) frames += phase.frames;
  return frames;
}

double MotionTemplate::max_depth_mm() const {
  double depth = 0.0;
  for (const PhaseTemplate& phase : phases)
    if (const Draw* draw = phase.number("depth_mm")) depth = std::max(depth, draw->high);
  return depth;
}

std::string MotionTemplate::sample_yaml(const std::function<double(int)>& u,
                                        const std::function<std::string(int)>& path_name,
                                        std::uint64_t draw_seed) const {
  int dimension = 0;
  const auto value = [&](const Draw& draw) { return number_text(draw.ranged() ? draw.at(u(dimension++)) : draw.low); };
  const auto list = [&](const std::vector<PhaseTemplate::Number>& numbers) {
    std::string items;
    for (const auto& number : numbers) items += (items.empty() ? "" : ", ") + value(number.draw);
    return "[" + items + "]";
  };
  std::string text;
  if (fingers) {
    text = "fingers:\n";
    if (const auto& draw = fingers->draw)
      text += fmt::format(
          "  draw: {{seed: {}, best_of: {}, upright: {}, width_mm: [{}, {}], patch_mm: {}, depth_mm: {}}}\n", draw_seed,
          draw->best_of, draw->upright, number_text(1e3 * draw->least_width_m), number_text(1e3 * draw->most_width_m),
          number_text(1e3 * draw->patch_m), number_text(1e3 * draw->depth_m));
    if (!fingers->grip_mm.empty()) text += "  grip_mm: " + list(fingers->grip_mm) + "\n";
    for (const auto& number : fingers->numbers) text += fmt::format("  {}: {}\n", number.key, value(number.draw));
    for (const auto& word : fingers->words) text += fmt::format("  {}: {}\n", word.key, word.text);
    text += fmt::format("object: {{{}: {}", fingers->weight.key, value(fingers->weight.draw));
    if (fingers->friction) text += ", friction: " + value(*fingers->friction);
    if (!fingers->center_shift_mm.empty()) text += ", center_of_mass_shift_mm: " + list(fingers->center_shift_mm);
    text += "}\n";
  } else {
    const std::string x = value(center_x_mm), y = value(center_y_mm);
    text = fmt::format("placement:\n  center_mm: [{}, {}]\n  rotate_deg: {}\n", x, y, value(rotate_deg));
  }
  if (face) text += fmt::format("  face: \"{}\"\n", *face);
  if (may_miss) text += "  may_miss: true\n";
  if (object_density_kg_m3) text += fmt::format("object: {{density_kg_m3: {}}}\n", number_text(*object_density_kg_m3));
  text += "motion:\n";
  for (std::size_t p = 0; p < phases.size(); ++p) {
    const PhaseTemplate& phase = phases[p];
    text += "  - {kind: " + phase.kind;
    if (phase.kind == "path") text += ", file: " + path_name(static_cast<int>(p));
    for (const auto& number : phase.numbers) text += ", " + number.key + ": " + value(number.draw);
    for (const auto& word : phase.words) text += ", " + word.key + ": " + word.text;
    text += "}\n";
  }
  return text;
}

}  // namespace tacipc
