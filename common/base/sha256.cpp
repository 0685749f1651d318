#include "common/base/sha256.h"

#include <fmt/core.h>
#include <openssl/evp.h>

#include <array>
#include <memory>
#include <span>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {
namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    require(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }
  void add(std::string_view bytes) { require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1); }
  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned int length = 0;
    require(EVP_DigestFinal_ex(context_.get(), digest.data(), &length) == 1);
    std::string text;
    for (const unsigned char byte : std::span(digest).first(length)) text += fmt::format("{:02x}", byte);
    return text;
  }

 private:
  static void require(bool done) {
    if (!done) throw DataError("OpenSSL cannot compute SHA-256");
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  Sha256 hash;
  for_each_part(path, [&](std::string_view part) { hash.add(part); });
  return hash.hex();
}

std::string checked_sha256(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  std::filesystem::path beside = path;
  beside += ".sha256";
  if (!std::filesystem::exists(path)) throw DataError("{}: does not exist", path.string());
  if (!std::filesystem::exists(beside))
    throw DataError(
        "{}: there is no {} beside it to tell whether it is whole; if you trust it: (cd '{}' && sha256sum '{}' > '{}')",
        path.string(), beside.filename().string(), path.has_parent_path() ? path.parent_path().string() : ".", name,
        beside.filename().string());
  const std::string told = read_file(beside), digest = sha256_of_file(path);
  if (told != digest + "  " + name + "\n" && told != digest + " *" + name + "\n")
    throw DataError("{}: is damaged, or not the file that {} is of: its SHA-256 is {}", path.string(),
                    beside.filename().string(), digest);
  return digest;
}

}  // namespace tacipc
