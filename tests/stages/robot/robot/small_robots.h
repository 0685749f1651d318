// Models and tasks of a few lines, as tests write them.
#pragma once

#include <string>
#include <vector>

#include "stages/robot/robot/mjcf_model.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {

/// A model in MJCF: what is in the world, sections after it, attributes of <option>.
inline std::string mjcf(const std::string& world, const std::string& sections = "",
                        const std::string& option = R"(timestep="0.001")") {
  return "<mujoco><compiler angle=\"degree\"/><option " + option + "/><worldbody>" + world + "</worldbody>" + sections +
         "</mujoco>";
}

/// Writes the model robot.xml of a task and reads the task; the line `model` is put before its text.
inline TaskSpec written_task(const ScratchFolder& folder, const std::string& model, const std::string& task) {
  folder.file("robot.xml", model);
  return config_from_text<TaskSpec>("model: robot.xml\n" + task, (folder / "task.yaml").string());
}

/// A fixed plate far below, for tasks that need an object but none to touch.
inline const std::string kPlate = R"(<body name="plate" pos="0 0 -5"><geom type="box" size="1 1 0.1"/></body>)";
inline const std::string kPlateObject = "objects: {name: plate, kind: fixed, mesh: plate.off}\n";

/// A weight on a vertical slide, 1 m up; its pad looks down from its lower face, 10 mm below the middle of the geom.
inline std::string falling_pad(double mass_kg, const std::string& joint = "") {
  return R"(<body name="weight" pos="0 0 1"><joint name="z" type="slide" axis="0 0 1" )" + joint +
         R"(/><geom name="pad" type="box" size="0.02 0.02 0.01" mass=")" + std::to_string(mass_kg) + R"("/></body>)";
}
inline const std::string kPadLooksDown = "pads: {name: gel, geom: pad, at_mm: [0, 0, -10], turn_deg: [180, 0, 0]}\n";

}  // namespace tacipc
