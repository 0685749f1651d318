// Files inside a ZIP archive, unpacked within a limit: parts of packages such as 3MF.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tacipc {

/// Largest total size of the unpacked parts of one archive, bytes.
inline constexpr std::size_t kMostUnpacked = std::size_t{1} << 30;

/// Parts have names such as /3D/3dmodel.model. As packages want it, the slash in front may be missing, percent signs
/// may encode characters, and letters A to Z equal a to z.   [ECMA-376 part 2, 9.1.1]
class ZipParts {
 public:
  /// Lists an archive that must outlive it; unpacks nothing. `most`: bytes of all that is read. \throw DataError `NAME:
  /// is not a ZIP archive …`
  ZipParts(std::string_view bytes, std::string name, std::size_t most = kMostUnpacked);

  bool has(const std::string& part) const { return entry_of(part) != nullptr; }
  /// These parts, unpacked, in this order. Others are never unpacked. \throw DataError `NAME: …` if one is not there,
  /// is there twice, is damaged, or all that was read so far is more than `most`.
  std::vector<std::string> read(const std::vector<std::string>& parts);

 private:
  struct Entry {
    std::size_t number = 0;  // in the order of the archive
    bool repeated = false;
  };
  const Entry* entry_of(const std::string& part) const;

  std::string_view bytes_;
  std::string name_;
  std::map<std::string, Entry> entries_;
  std::size_t most_, left_;
};

}  // namespace tacipc
