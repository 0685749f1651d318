// Motions with ranges: the format of `press` --sample, with a number or [low, high] for each value that may vary.
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

/// A number, or the interval from which each sample draws it.
struct Draw {
  double low = 0.0;
  double high = 0.0;
  bool log_uniform = false;

  bool ranged() const { return low < high; }
  /// Value at u in [0, 1): low + u (high − low), or low (high / low)^u.
  double at(double u) const { return log_uniform ? low * std::pow(high / low, u) : low + u * (high - low); }
  static Draw read(ConfigReader& in, const std::string& key, const Range& range);
  static Draw read_or(ConfigReader& in, const std::string& key, double fallback, const Range& range);
};

/// One phase of a motion: the keys of press in the order in which they are written.
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
  std::filesystem::path path_file;  // file of a phase of kind path

  static PhaseTemplate read(ConfigReader& in);
  /// Reads a phase of a grasp.
  static PhaseTemplate read_of_grasp(ConfigReader& in);
  const Draw* number(const std::string& key) const;
};

/// Keys `fingers` and `object` of a grasp, which replace a placement.
struct FingersTemplate {
  std::optional<GraspDraw> draw;               // drawn grasp, with a seed per sample; otherwise the next values
  std::vector<PhaseTemplate::Number> grip_mm;  // x, y, z
  std::vector<PhaseTemplate::Number> numbers;
  std::vector<PhaseTemplate::Word> words;
  PhaseTemplate::Number weight;  // mass_g, friction_margin (log-uniform) or density_kg_m3 of the object
  std::optional<Draw> friction;  // friction coefficient; absent: that of the press file
  std::vector<PhaseTemplate::Number> center_shift_mm;  // x, y, z, or empty

  static FingersTemplate read(ConfigReader& fingers, ConfigReader& object);
  /// All numbers, in the order in which they are drawn and written.
  std::vector<const Draw*> draws() const;
};

/// Placement and phases in the format of press. Each ranged number is one dimension, in the order of `draws`.
struct MotionTemplate {
  Draw center_x_mm, center_y_mm, rotate_deg;
  std::optional<std::string> face = std::nullopt;
  bool may_miss = false;
  std::optional<double> object_density_kg_m3 = std::nullopt;
  std::optional<FingersTemplate> fingers = std::nullopt;  // a grasp: one sample for each of its two fingers
  std::vector<PhaseTemplate> phases = {};

  /// Reads the keys `placement` or `fingers`, `object` and `motion` of a map.
  static MotionTemplate read(ConfigReader& in);
  /// Number of values that each sample draws.
  int dimensions() const;
  /// Number of frames after the first.
  int frames() const;
  /// Lowest position of the object below the undeformed front that a press to a depth may reach, mm; 0 without such a
  /// press.
  double max_depth_mm() const;
  /// Sample with u(d) in [0, 1) along dimension d, as YAML for press.
  /// \param path_name gives the file of phase p, relative to the sample's folder
  /// \param draw_seed seed of a drawn grasp
  std::string sample_yaml(const std::function<double(int)>& u, const std::function<std::string(int)>& path_name,
                          std::uint64_t draw_seed) const;
};

}  // namespace tacipc
