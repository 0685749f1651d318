// Reads the numbers of one accessor of a glTF file.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/gltf_file.h"

namespace tacipc {

/// Elements of an accessor, packed or interleaved, normalized or not, with those that a sparse list replaces.
class GltfNumbers {
 public:
  /// \param type required type of the elements (SCALAR, VEC3, VEC4, MAT4)
  /// \param file must outlive this object
  /// \throw DataError `NAME: accessors[N] …` for another type, elements beyond the view, or sparse indices out of order
  /// or range
  GltfNumbers(const GltfFile& file, std::size_t accessor, const std::string& type, const std::string& name);

  std::size_t count() const { return accessor_.count; }
  /// Returns whether there are data: accessors of compressed or external meshes may have none.
  bool has_data() const { return base_ != nullptr || !replaced_.empty(); }
  /// Returns a component of an element.
  double at(std::size_t element, std::size_t component) const;
  /// Returns an element as a vector.
  /// \pre the type is VEC3
  Vector3 vector(std::size_t element) const { return {at(element, 0), at(element, 1), at(element, 2)}; }

 private:
  [[noreturn]] void fail(const std::string& reason) const;
  /// Returns the first byte of `count` elements in a view.
  const char* data_of(std::size_t view, std::size_t offset, std::size_t count, std::size_t size,
                      std::size_t stride) const;
  void read_sparse(const GltfSparse& sparse);

  const GltfFile& file_;
  const GltfAccessor& accessor_;
  std::string place_;
  std::size_t component_size_ = 0;
  const char* base_ = nullptr;  // null: zeros
  std::size_t stride_ = 0;
  std::vector<std::size_t> replaced_;  // replaced elements, in order
  const char* values_ = nullptr;       // values of the replaced elements
  std::size_t element_size_ = 0;
};

}  // namespace tacipc
