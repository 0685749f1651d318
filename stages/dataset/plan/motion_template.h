// Motions with ranges: what `press` takes as --sample, a number or [low, high] in each place that may vary.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/antipodal_grasp.h"

namespace tacipc {

/// A number, or the interval that each sample draws it from.
struct Draw {
  double low = 0.0;
  double high = 0.0;
  bool log_uniform = false;

  bool ranged() const { return low < high; }
  /// The value at u in [0, 1): low + u (high − low), or low (high / low)^u.
  double at(double u) const { return log_uniform ? low * std::pow(high / low, u) : low + u * (high - low); }
  static Draw read(ConfigReader& in, const std::string& key, const Range& range);
  static Draw read_or(ConfigReader& in, const std::string& key, double fallback, const Range& range);
};

/// One phase of a motion: the keys of press in the order they are written.
struct PhaseTemplate {
  struct Number {
    std::string key;
    Draw draw;
  };
  struct Word {
    std::string key, text;
  };
  std::string kind;
  std::vector<Number> numbers;
  std::vector<Word> words;
  int frames = 1;
  std::filesystem::path path_file;  // of kind path

  static PhaseTemplate read(ConfigReader& in);
  /// Of a grasp.
  static PhaseTemplate read_of_grasp(ConfigReader& in);
  const Draw* number(const std::string& key) const;
};

/// The keys `fingers` and `object` of a grasp, which take the place of a placement.
struct FingersTemplate {
  std::optional<GraspDraw> draw;               // each sample has a seed of its own; or
  std::vector<PhaseTemplate::Number> grip_mm;  // x, y, z
  std::vector<PhaseTemplate::Number> numbers;
  std::vector<PhaseTemplate::Word> words;
  PhaseTemplate::Number weight;  // mass_g, friction_margin (log-uniform) or density_kg_m3 of the object
  std::optional<Draw> friction;  // coefficient; none: as the press file has it
  std::vector<PhaseTemplate::Number> center_shift_mm;  // x, y, z, or none

  static FingersTemplate read(ConfigReader& fingers, ConfigReader& object);
  /// Every number, in the order in which they are drawn and written.
  std::vector<const Draw*> draws() const;
};

/// Placement and phases, as press reads them. Each ranged number is one dimension, in the order of `draws`.
struct MotionTemplate {
  Draw center_x_mm, center_y_mm, rotate_deg;
  std::optional<std::string> face = std::nullopt;
  bool may_miss = false;
  std::optional<double> object_density_kg_m3 = std::nullopt;
  std::optional<FingersTemplate> fingers = std::nullopt;  // a grasp: a sample of each of its two fingers
  std::vector<PhaseTemplate> phases = {};

  /// The keys `placement` or `fingers`, `object` and `motion` of a map.
  static MotionTemplate read(ConfigReader& in);
  /// Numbers that samples draw.
  int dimensions() const;
  /// Frames after the first.
  int frames() const;
  /// Lowest place of the object below the undeformed front that a press to a depth may ask for, mm; 0 without one.
  double max_depth_mm() const;
  /// The sample that has u(d) in [0, 1) along dimension d, as YAML for press. `path_name(p)` is the file of phase p as
  /// seen from the sample's folder, `draw_seed` that of a drawn grasp.
  std::string sample_yaml(const std::function<double(int)>& u, const std::function<std::string(int)>& path_name,
                          std::uint64_t draw_seed) const;
};

}  // namespace tacipc
