// Statistics of a network's training images, stored in its files, and the comparison of photographs with them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/benchmark/image_look.h"
#include "common/benchmark/look_spread.h"

namespace tacipc {

/// Comparison of an image and its background with the training images.
struct LookComparison {
  double distance = 0.0;              // 1 is the limit for images of the training
  std::string deviation = {};         // a key of the record, such as red_blue_swapped; empty: no deviation
  std::string meaning = {};           // the deviation in words
  std::optional<double> undone = {};  // distance after undoing the deviation, if it can be undone
};

/// Statistics of the training images.
class TrainedLook {
 public:
  /// Computes the statistics.
  /// \param groups looks of the training, by groups of images that belong together (of one sample)
  /// \pre not empty
  static TrainedLook of(const std::vector<std::vector<ImageLook>>& groups, int reduction);

  /// Returns the edge length, in pixels, of the squares over which the network's input is averaged.
  int reduction() const { return reduction_; }
  /// Compares an image and its background, as the network receives them. A deviation is named by the operation that
  /// makes them match the training: red and blue exchanged, rotated or mirrored, for both images or one; otherwise by
  /// the part of the look that is too far off.
  /// \pre images of one size
  LookComparison compare(const FloatImage& background, const FloatImage& image) const;

  /// Returns the statistics as text, the form in which files store them.
  std::string to_text() const;
  /// Reads the statistics; `name` stands for the file in messages.
  /// \throw DataError if the text is no such statistics
  static TrainedLook from_text(const std::string& text, const std::string& name);

 private:
  using Distances = std::array<double, kLookParts.size()>;
  Distances distances(const ImageLook& look) const;
  /// Returns the numbers of a part that are compared; for the relief, the roughness of its difference from the
  /// training's mean. Nothing if the look does not have them.
  std::optional<Eigen::VectorXd> numbers_of(std::size_t part, const ImageLook& look) const;
  /// Names a deviation that no rotation, mirroring or swap undoes, from the parts that are too far off.
  static LookComparison unexplained(const Distances& parts);

  int reduction_ = 1;
  double least_change_codes_ = 0.0;  // smallest change whose shading is compared
  Eigen::VectorXd relief_;           // mean of the training
  // Spread of each part; none for the shading if no training image changes enough.
  std::array<std::optional<LookSpread>, kLookParts.size()> spreads_;
};

/// Collects comparisons of many images.
class LookReport {
 public:
  /// Adds the comparison of the image `name`.
  void add(const std::string& name, const LookComparison& comparison);
  std::size_t images() const { return images_; }
  /// Returns the number of images beyond the limit.
  std::size_t unlike() const;
  /// Returns one warning per deviation, the most frequent first: which of `what` (photographs), their distances, the
  /// deviation.
  std::vector<std::string> warnings(const std::string& what) const;
  /// Returns lines of a record: number of differing images, largest distance, number of images per deviation.
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
