// Splits the visible traction into two parts: normal to the front and tangential.
#pragma once

#include "common/image/image.h"

namespace tacipc {

/// Parts of the traction t = −p n + s.
struct TractionParts {
  FloatImage pressure;  // p = −n · t
  FloatImage shear;     // s = t + p n
};

/// Splits the traction; NaN where traction or normal is NaN.
/// \pre both have three channels and one size
TractionParts parts_of(const FloatImage& traction, const FloatImage& normal);

}  // namespace tacipc
