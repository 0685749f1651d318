// Unpacks files inside a ZIP archive within a size limit: parts of packages such as 3MF.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tacipc {

/// Largest total size of the unpacked parts of one archive, bytes.
inline constexpr std::size_t kMostUnpacked = std::size_t{1} << 30;

/// Parts of a package. Names are such as /3D/3dmodel.model. As the standard requires, the leading slash may be missing,
/// percent signs may encode characters, and letters A to Z equal a to z.   [ECMA-376 part 2, 9.1.1]
class ZipParts {
 public:
  /// Lists an archive, which must outlive this object, without unpacking.
  /// \param most limit of all unpacked bytes
  /// \throw DataError `NAME: is not a ZIP archive …`
  ZipParts(std::string_view bytes, std::string name, std::size_t most = kMostUnpacked);

  bool has(const std::string& part) const { return entry_of(part) != nullptr; }
  /// Unpacks these parts, in this order, and no others.
  /// \throw DataError `NAME: …` if a part is missing, repeated or damaged, or all unpacked bytes exceed `most`
  std::vector<std::string> read(const std::vector<std::string>& parts);

 private:
  struct Entry {
    std::size_t number = 0;  // index in the archive
    bool repeated = false;
  };
  const Entry* entry_of(const std::string& part) const;

  std::string_view bytes_;
  std::string name_;
  std::map<std::string, Entry> entries_;
  std::size_t most_, left_;
};

}  // namespace tacipc
