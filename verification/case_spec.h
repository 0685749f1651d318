// A verification case as a YAML file: gel, object, material, motion, and expected numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/sample_spec.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/world/press_config.h"
#include "verification/gel_shapes.h"
#include "verification/object_shapes.h"

namespace tacipc::verify {

/// Which frame is meant: the last one, one by number, the last of a phase, or the one at a depth.
struct FrameChoice {
  std::optional<int> index;
  std::optional<std::string> phase;
  std::optional<double> depth_m;

  /// `frame: last`, `frame: 3`, `frame: {phase: shear}` or `frame: {depth_mm: 0.5}`; absent: the last.
  static FrameChoice read(ConfigReader& in);
};

/// One row of the table: a measured quantity, what it must be, and how near.
struct Expectation {
  std::string label;     // shown in the table; the quantity where none is given
  std::string quantity;  // a name of quantities()
  FrameChoice frame;
  std::optional<double> value;         // in the quantity's unit, or …
  std::optional<std::string> formula;  // … a name of formulas()
  bool with_standoff = false;          // the formula is for the object enlarged by the barrier's stand-off
  std::optional<double> within_percent;
  std::optional<double> within;
  std::optional<double> at_most;
  std::optional<double> at_least;

  static Expectation read(ConfigReader& in);
};

/// The modulus for which one measured force results: forces of a slow press scale with it.
struct Fit {
  FrameChoice frame;
  double press_force_n = 0.0;

  static Fit read(ConfigReader& in);
};

/// Results of the reference solver on the same gel mesh.
struct ReferenceSpec {
  std::string displacement;  // npy (frames, #V, 3), shared:… allowed
  double largest_m = 0.0;    // limit of `share_percent` of the front vertices …
  double share_percent = 100.0;
  double rms_m = 0.0;       // … and of the root mean square over the front
  int first_frame = 1;      // frame of ours that its frame 1 stands for
  bool all_frames = false;  // else the last one

  static ReferenceSpec read(ConfigReader& in);
};

struct CaseSpec {
  std::string title;
  std::string source;  // where the expected numbers come from
  GelSpec gel;
  Material material;
  ObjectShape object;
  PressConfig press;
  SampleSpec sample;
  std::vector<Expectation> expect;
  std::optional<Fit> fit;
  std::optional<ReferenceSpec> reference;

  static CaseSpec read(ConfigReader& in);
  /// Every file of the shared data that the case needs.
  std::vector<std::string> shared_paths() const;
};

}  // namespace tacipc::verify
