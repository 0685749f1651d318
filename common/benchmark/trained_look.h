// Statistics of a network's training images, kept in its files, and the comparison of photographs with them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/benchmark/image_look.h"
#include "common/benchmark/look_spread.h"

namespace tacipc {

/// How an image and its background compare with those of a training.
struct LookComparison {
  double distance = 0.0;              // 1: as far as images of the training may be
  std::string deviation = {};         // a key of the record, such as red_blue_swapped; empty: none
  std::string meaning = {};           // the same in words
  std::optional<double> undone = {};  // distance with it undone, where it can be
};

class TrainedLook {
 public:
  /// Looks of the training, by groups of images that belong together (of one sample). \pre there is one
  static TrainedLook of(const std::vector<std::vector<ImageLook>>& groups, int reduction);

  /// Pixels along the edge of the squares whose means the network sees.
  int reduction() const { return reduction_; }
  /// Both as the network sees them. What differs is named by what brings both back to the training: red and blue
  /// exchanged, turned or mirrored, of both or of one; else by the part that is too far. \pre of one size
  LookComparison compare(const FloatImage& background, const FloatImage& image) const;

  std::string to_text() const;
  /// \throw DataError, which begins with the name, if the text is no such statistics
  static TrainedLook from_text(const std::string& text, const std::string& name);

 private:
  using Distances = std::array<double, kLookParts.size()>;
  Distances distances(const ImageLook& look) const;
  /// Numbers of a part that are compared: of the relief the roughness of what it is off the training's mean. Nothing if
  /// the look does not tell them.
  std::optional<Eigen::VectorXd> numbers_of(std::size_t part, const ImageLook& look) const;
  /// Name of a deviation that no turn or swap undoes, from the parts that are too far.
  static LookComparison unexplained(const Distances& parts);

  int reduction_ = 1;
  double least_change_codes_ = 0.0;  // the shading of a smaller change says nothing
  Eigen::VectorXd relief_;           // mean
  // Spread of each part; the shading has none if the training had no image with enough of a change.
  std::array<std::optional<LookSpread>, kLookParts.size()> spreads_;
};

/// Comparisons of many images.
class LookReport {
 public:
  void add(const std::string& name, const LookComparison& comparison);
  std::size_t images() const { return images_; }
  std::size_t unlike() const;
  /// One for each deviation, the most frequent first: which of `what` (photographs), how far, how they differ.
  std::vector<std::string> warnings(const std::string& what) const;
  /// Lines of a record: how many differ, how far the farthest one is, how many of each deviation.
  Value::Map summary() const;

 private:
  struct Group {
    std::string meaning;
    std::vector<std::string> names;
    double least = 0.0, most = 0.0;  // distance
    std::optional<double> most_undone;
  };
  std::size_t images_ = 0;
  double farthest_ = 0.0;
  std::map<std::string, Group> groups_;
};

}  // namespace tacipc
