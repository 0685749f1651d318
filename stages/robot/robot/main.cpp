#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <regex>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/mesh/mass_properties.h"
#include "common/stage/record.h"
#include "common/stage/stage.h"
#include "stages/robot/robot/drawn_task.h"
#include "stages/robot/robot/outputs.h"

namespace {

const tacipc::StageSpec kRobot{
    .name = "robot",
    .summary =
        "Move a robot of MuJoCo through a task, and say where its gels go: alone, or a window of time with the "
        "forces that press returned for an earlier try.",
    .inputs = {{.flag = "--task", .help = "model, pads, objects and what the robot does (YAML)"},
               {.flag = "--start",
                .help = "folder of robot: the accepted window that this one follows",
                .required = false},
               {.flag = "--try", .help = "folder of robot: the last try of this window", .required = false},
               {.flag = "--press",
                .help = "folder of press: its answer to that try or, without --try, to the window before",
                .required = false}},
    .options = {
        {.flag = "--name", .help = "name of the run", .fallback = "robot"},
        {.flag = "--seed", .help = "of the task's variables; 0: the middle of each range", .fallback = "0"},
        {.flag = "--exact",
         .help = "yes: feel what --press answered to --try as it is, wherever the pads go",
         .fallback = "no"},
        {.flag = "--frames", .help = "of the window; 0: the whole task, by MuJoCo's own contacts", .fallback = "0"}}};

template <typename T>
T whole_number(const tacipc::Stage& stage, const std::string& flag) {
  const std::string& text = stage.option(flag);
  T number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 0)
    throw tacipc::UsageError(fmt::format("{}: '{}' is not a whole number", flag, text));
  return number;
}

/// Collects the files that a model names, relative to the model's folder or its asset folder, and recursively those of
/// included models.
void add_files_of(const std::filesystem::path& model, const std::filesystem::path& file,
                  std::vector<std::pair<std::string, std::filesystem::path>>& all) {
  static const std::regex kAssets(R"re((?:mesh|texture|asset)dir\s*=\s*["']([^"']+)["'])re"),
      kFile(R"re(\bfile\s*=\s*["']([^"']+)["'])re");
  const std::string text = tacipc::read_file(file);
  const std::sregex_iterator end;
  std::vector<std::filesystem::path> folders{model.parent_path()};
  for (std::sregex_iterator at(text.begin(), text.end(), kAssets); at != end; ++at)
    folders.push_back(model.parent_path() / (*at)[1].str());
  for (std::sregex_iterator at(text.begin(), text.end(), kFile); at != end; ++at) {
    for (const std::filesystem::path& folder : folders) {
      const std::filesystem::path named = folder / (*at)[1].str();
      if (!std::filesystem::is_regular_file(named)) continue;
      const bool known = std::any_of(all.begin(), all.end(), [&](const auto& other) { return other.second == named; });
      if (known) continue;
      all.emplace_back(fmt::format("model_file_{}", all.size()), named);
      if (named.extension() == ".xml") add_files_of(model, named, all);
    }
  }
}

std::vector<tacipc::TaskObject> read_objects(tacipc::Stage& stage, const tacipc::TaskSpec& task) {
  using namespace tacipc;
  std::vector<TaskObject> objects;
  std::vector<std::pair<std::string, std::filesystem::path>> files{{"model", task.model}};
  add_files_of(task.model, task.model, files);
  for (const ObjectSpec& spec : task.objects) {
    if (!std::filesystem::is_regular_file(spec.mesh))
      throw UsageError(fmt::format("object {}: mesh: {} does not exist", spec.name, spec.mesh.string()));
    files.emplace_back("object_" + spec.name, spec.mesh);
    TaskObject& object = objects.emplace_back();
    object.mesh = read_triangle_mesh(spec.mesh, metres_per_unit(spec.unit));
    if (spec.fixed) continue;
    try {
      const MassProperties mass = mass_properties(object.mesh.positions, object.mesh.triangles);
      require_solid(mass.second_moment_m2);
      object.mass_kg = spec.mass.mass_of(mass.volume_m3);
    } catch (const DataError& error) {
      throw DataError("object {}: {}", spec.name, error.what());
    }
  }
  stage.add_inputs(files);
  return objects;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace tacipc;
  return run_stage(kRobot, argc, argv, [](Stage& stage) {
    const DrawnTask drawn = draw_task(stage.input("--task"), whole_number<std::uint64_t>(stage, "--seed"));
    ConfigReader in = ConfigReader::from_text(drawn.text, stage.input("--task").string());
    const TaskSpec task = TaskSpec::read(in);
    in.finish();
    stage.note("task", in.resolved());
    if (!std::filesystem::is_regular_file(task.model))
      throw UsageError(
          fmt::format("{}: model: {} does not exist", stage.input("--task").string(), task.model.string()));
    const std::vector<TaskObject> objects = read_objects(stage, task);
    const auto frames = whole_number<int>(stage, "--frames");
    RobotModel robot(task, objects, frames > 0);
    std::vector<Matrix4> object_start, rigid_start;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      object_start.push_back(robot.body_pose(robot.object_body(i)));
      if (!task.objects[i].fixed) rigid_start.push_back(object_start.back());
    }
    Value::Map variables;
    for (const auto& [name, value] : drawn.variables) variables.emplace_back(name, value);
    stage.note("variables", std::move(variables));
    stage.summarize({{"frame_s", task.frame_s}});

    const auto start = stage.optional_input("--start"), earlier = stage.optional_input("--try"),
               press = stage.optional_input("--press");
    if (frames == 0) {
      for (const char* flag : {"--start", "--try", "--press"}) {
        if (stage.optional_input(flag)) throw UsageError(fmt::format("{}: has no effect without --frames", flag));
      }
      double all_s = 0.0;
      for (const TaskStep& step : task.steps) all_s += step.seconds;
      const RobotRun run = run_alone(task, robot, [&](double time_s) {
        show_progress(std::min(1.0, time_s / all_s), fmt::format("{:.2f} of at most {:.2f} s", time_s, all_s));
      });
      write_outputs(stage, task, objects, robot, object_start, run, nullptr);
      return;
    }
    if ((earlier || start) && !press)
      throw UsageError("--press is missing: what the gels answered to --try, or to --start");
    const std::optional<RobotRun> before = start ? std::optional(read_run(*start)) : std::nullopt;
    const std::size_t first = before ? before->frames.size() - 1 : 0;
    double stiffness = task.coupling.stiffness_n_m;
    const auto last = earlier ? earlier : start;
    if (last) stiffness = Record::from_file(*last / "robot.yaml").section("summary").required_number("stiffness_n_m");
    Window window{.before = before ? &*before : nullptr, .objects_at_start = rigid_start, .frames = frames};
    window.exact = stage.option("--exact") == "yes";
    if (!window.exact && stage.option("--exact") != "no") throw UsageError("--exact: yes or no");
    if (window.exact && !earlier) throw UsageError("--exact: has no effect without --try");
    bool converged = false;
    std::optional<WindowAnswers> answers;
    if (press) answers = read_answers(*press, task, objects, first);
    if (earlier) {
      const TryJudgement judged =
          judge_try(task, read_run(*earlier), first, read_basis(*earlier, task.pads.size()), stiffness, *answers);
      window.answers = &*answers;
      stiffness = judged.stiffness_n_m;
      stage.summarize({{"residual_n", judged.residual.wrench_n}, {"residual_relative", judged.residual.relative}});
      converged = judged.residual.relative <= task.coupling.tolerance;
    } else if (answers) {
      window.at_start = answers->frames.front();
      window.objects_at_start = answers->objects.front();
    } else {
      for (std::size_t p = 0; p < task.pads.size(); ++p) {
        const Matrix4 pose = robot.pad_pose(p);
        window.at_start.push_back({.world_from_gel = pose, .gap_m = gap_of(task, objects, p, pose, object_start)});
      }
    }
    window.stiffness_n_m = stiffness;
    const RobotRun run = run_window(task, robot, window);
    if (earlier) {
      const double apart_m = position_residual_m(run, first, *answers);
      if (window.exact) converged = apart_m <= task.coupling.position_tolerance_m;
      stage.summarize({{"position_residual_m", apart_m}, {"converged", converged}});
    }
    stage.summarize({{"window_first_frame", first}, {"stiffness_n_m", stiffness}, {"finished", run.finished}});
    write_outputs(stage, task, objects, robot, object_start, run, earlier ? &*answers : nullptr);
  });
}
