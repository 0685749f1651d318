#include "stages/robot/robot/task_spec.h"

#include <algorithm>

#include "common/mesh/triangle_mesh.h"
#include "common/sample/rigid_way.h"

namespace tacipc {
namespace {

PadSpec read_pad(ConfigReader& in) {
  PadSpec pad{.name = read_body_name(in, "name"), .geom = in.text("geom")};
  pad.geom_from_gel = moved(Matrix4::Identity(), {read_triple(in, "at_mm", 1e-3), read_turn(in, "turn_deg")});
  pad.radius_m = 1e-3 * in.number_or("radius_mm", 1e3 * pad.radius_m, Range::positive());
  return pad;
}

ObjectSpec read_object(ConfigReader& in, const std::filesystem::path& folder) {
  ObjectSpec object{.name = read_body_name(in, "name"),
                    .fixed = in.choice_or("kind", "rigid", {"rigid", "fixed"}) == "fixed",
                    .mesh = folder / in.text("mesh"),
                    .unit = in.choice_or("unit", "m", kLengthUnits)};
  if (!object.fixed) {
    object.mass = read_body_mass(in);
    object.held_s = in.number_or("held_s", 0.0, Range::non_negative());
  }
  if (in.has("at_mm")) object.at_m = 1e-3 * in.vector3("at_mm");
  if (in.has("turn_deg")) object.turn_rad = read_turn(in, "turn_deg");
  return object;
}

std::vector<std::pair<std::string, double>> named_numbers(ConfigReader& in, const std::string& key,
                                                          const Range& range) {
  std::vector<std::pair<std::string, double>> all;
  if (auto section = in.optional_section(key)) {
    for (const std::string& name : section->keys()) all.emplace_back(name, section->number(name, range));
  }
  return all;
}

Condition read_condition(ConfigReader& in, const std::vector<PadSpec>& pads) {
  Condition condition;
  if (in.has("pad")) {
    std::vector<std::string> names;
    for (const PadSpec& pad : pads) names.push_back(pad.name);
    condition.pad = in.choice("pad", names);
    condition.force_n = in.number("force_n", Range::positive());
    return condition;
  }
  condition.site = in.text("site");
  if (in.has("above_mm")) condition.above_m = 1e-3 * in.number("above_mm");
  if (in.has("below_mm")) condition.below_m = 1e-3 * in.number("below_mm");
  if (condition.above_m.has_value() == condition.below_m.has_value())
    in.fault("site", "give its height as above_mm or as below_mm");
  return condition;
}

TaskStep read_step(ConfigReader& in, const std::vector<PadSpec>& pads) {
  TaskStep step{.seconds = in.number("seconds", Range{.low = 0.0, .high = 1000.0, .open_low = true}),
                .smooth = in.flag_or("smooth", true),
                .set = named_numbers(in, "set", Range::any()),
                .limit = named_numbers(in, "limit", Range::positive())};
  if (auto move = in.optional_section("move")) {
    step.site = move->text("site");
    if (move->has("to_mm")) {
      step.to_m = 1e-3 * move->vector3("to_mm");
      if (move->has("by_mm")) move->fault("by_mm", "give by_mm or to_mm, not both");
    } else {
      step.by_m = read_triple(*move, "by_mm", 1e-3);
    }
    step.turn_rad = read_turn(*move, "turn_deg");
  }
  if (auto shake = in.optional_section("shake")) {
    if (!step.site.empty()) shake->fault("site", "a step moves or shakes, not both");
    step.site = shake->text("site");
    step.shake_m = 1e-3 * shake->vector3("amplitude_mm");
    step.frequency_hz = shake->number("frequency_hz", Range::positive());
  }
  if (auto until = in.optional_section("until")) step.until = read_condition(*until, pads);
  return step;
}

}  // namespace

TaskSpec TaskSpec::read(ConfigReader& in) {
  const std::filesystem::path folder = std::filesystem::path(in.source()).parent_path();
  TaskSpec task;
  in.ignore("variables");  // replaced by values before
  task.model = folder / in.text("model");
  task.frame_s = in.number_or("frame_s", task.frame_s, Range{.low = 0.0, .high = 1.0, .open_low = true});
  task.start = named_numbers(in, "start", Range::any());
  std::vector<std::string> names;
  const auto once = [&](ConfigReader& at, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) != names.end())
      at.fault("name", "another pad or object has this name");
    names.push_back(name);
  };
  for (ConfigReader& pad : in.one_or_more_sections("pads")) {
    task.pads.push_back(read_pad(pad));
    once(pad, task.pads.back().name);
  }
  for (ConfigReader& object : in.one_or_more_sections("objects")) {
    task.objects.push_back(read_object(object, folder));
    once(object, task.objects.back().name);
  }
  for (ConfigReader& pair : in.sections("contact")) {
    TouchSpec touch{.between = pair.choices_or("between", {}, names)};
    if (touch.between.size() != 2) pair.fault("between", "expected the names of two pads or objects");
    touch.friction = pair.optional_number("friction", Range::non_negative());
    touch.d_hat_mm = pair.optional_number("d_hat_mm", Range::positive());
    task.contact.push_back(touch);
  }
  if (auto coupling = in.optional_section("coupling")) {
    CouplingSpec& c = task.coupling;
    c.window_frames = coupling->integer_or("window_frames", c.window_frames, 1, 1000);
    c.tolerance = coupling->number_or("tolerance", c.tolerance, Range{.low = 0.0, .high = 0.1, .open_low = true});
    c.position_tolerance_m =
        1e-6 * coupling->number_or("position_tolerance_um", 1e6 * c.position_tolerance_m, Range::positive());
    c.most_tries = coupling->integer_or("most_tries", c.most_tries, 2, 100);
    c.stiffness_n_m = coupling->number_or("stiffness_n_m", c.stiffness_n_m, Range::positive());
    c.smallest_wrench_n = coupling->number_or("smallest_wrench_n", c.smallest_wrench_n, Range::positive());
  }
  for (ConfigReader& step : in.one_or_more_sections("steps")) task.steps.push_back(read_step(step, task.pads));
  return task;
}

}  // namespace tacipc
