// Slope table of the simulator Taxim [SiYuan2022]: per bin of the membrane's inclination and direction, a polynomial in
// the pixel position that gives the change of the 8-bit value against the photograph without contact.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// The table.
struct SlopeTable {
  static constexpr int kTerms = 6;  // x², y², x y, x, y, 1
  int bins = 0;                     // bins of inclination over 0 … π/2, and of direction over −π … π
  std::vector<double> weights;      // bins × bins × kTerms × 3, 8-bit levels

  explicit SlopeTable(int bins);
  /// Reads the table.
  /// \throw DataError if the file is not an f8 array of that shape, or a weight is not finite
  static SlopeTable read(const std::filesystem::path& path);
  void write(const std::filesystem::path& path) const;

  /// Returns ⌊θ / (π/2 / (bins − 1))⌋ for the inclination θ = atan |∇h|.
  /// \pre slope ≥ 0
  int inclination_bin(double slope) const;
  /// Returns ⌊(φ + π) / (2π / (bins − 1))⌋ for the uphill direction φ = atan2(h_y, h_x), 0 on flat surface.
  int direction_bin(double slope_x, double slope_y) const;
  /// Returns the weights of a bin, kTerms × 3.
  double* at(int inclination, int direction) { return weights.data() + offset(inclination, direction); }
  const double* at(int inclination, int direction) const { return weights.data() + offset(inclination, direction); }

  /// Returns x², y², x y, x, y, 1 of a pixel; x and y run from −1 to 1 over the image's width and height.
  static std::array<double, kTerms> terms(int x, int y, int width, int height);
  /// Returns the change of the 8-bit value per channel of a pixel whose surface rises into the gel by slope_x along
  /// columns and slope_y along rows. Bins are not interpolated, as published.
  std::array<double, 3> change(double slope_x, double slope_y, const std::array<double, kTerms>& terms) const;

 private:
  std::size_t offset(int inclination, int direction) const {
    return static_cast<std::size_t>((inclination * bins + direction) * kTerms * 3);
  }
};

}  // namespace tacipc
