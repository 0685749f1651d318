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

/// Selects a frame: the last one, one by number, the last of a phase, or the one at a depth.
struct FrameChoice {
  std::optional<int> index;
  std::optional<std::string> phase;
  std::optional<double> depth_m;

  /// Reads `frame: last`, `frame: 3`, `frame: {phase: shear}` or `frame: {depth_mm: 0.5}`; absent: the last.
  static FrameChoice read(ConfigReader& in);
};

/// One row of the table: a measured quantity, its expected value, and the permitted deviation.
struct Expectation {
  std::string label;     // label in the table; default: the name of the quantity
  std::string quantity;  // a name of quantities()
  FrameChoice frame;
  std::optional<double> value;         // expected value in the quantity's unit; otherwise `formula` gives it
  std::optional<std::string> formula;  // name from formulas(), instead of `value`
  bool with_standoff = false;          // evaluate the formula for the object enlarged by the barrier's stand-off
  std::optional<double> within_percent;
  std::optional<double> within;
  std::optional<double> at_most;
  std::optional<double> at_least;

  static Expectation read(ConfigReader& in);
};

/// Fits the modulus such that one measured force results: forces of a quasi-static press are proportional to it.
struct Fit {
  FrameChoice frame;
  double press_force_n = 0.0;

  static Fit read(ConfigReader& in);
};

/// Results of the reference solver on the same gel mesh.
struct ReferenceSpec {
  std::string displacement;  // npy of shape (frames, #V, 3); shared:… allowed
  double largest_m = 0.0;    // limit for `share_percent` of the front vertices, m
  double share_percent = 100.0;
  double rms_m = 0.0;       // limit for the root mean square over the front, m
  int first_frame = 1;      // frame of the press that corresponds to frame 1 of the reference
  bool all_frames = false;  // compare all frames; otherwise only the last one

  static ReferenceSpec read(ConfigReader& in);
};

/// Content of a case's file.
struct CaseSpec {
  std::string title;
  std::string source;  // source of the expected numbers
  GelSpec gel;
  Material material;
  ObjectShape object;
  PressConfig press;
  SampleSpec sample;
  std::vector<Expectation> expect;
  std::optional<Fit> fit;
  std::optional<ReferenceSpec> reference;

  static CaseSpec read(ConfigReader& in);
  /// Paths of all shared files that the case needs.
  std::vector<std::string> shared_paths() const;
};

}  // namespace tacipc::verify
