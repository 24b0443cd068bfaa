#include "framework/io/digest.hpp"

#include <nettle/base16.h>
#include <nettle/sha2.h>

#include <array>
#include <fstream>
#include <vector>

#include "framework/base/error.hpp"

namespace croon {
namespace {

class Sha256 {
 public:
  Sha256() { sha256_init(&context_); }

  void add(std::string_view bytes) {
    sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  }

  std::string digits() {
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
    sha256_digest(&context_, digest.size(), digest.data());
    std::string digits(BASE16_ENCODE_LENGTH(SHA256_DIGEST_SIZE), '0');
    base16_encode_update(digits.data(), digest.size(), digest.data());
    return digits;
  }

 private:
  sha256_ctx context_{};
};

constexpr std::size_t kBlockBytes = 1 << 16;

}  // namespace

std::string sha256_of_file(const std::filesystem::path& path) {
  std::error_code error;
  std::ifstream file;
  if (std::filesystem::is_regular_file(path, error)) file.open(path, std::ios::binary);
  Sha256 sha256;
  std::vector<char> block(kBlockBytes);
  while (file.is_open() && file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    sha256.add({block.data(), static_cast<std::size_t>(file.gcount())});
  }
  if (!file.eof()) {
    throw InputError(path.string(), "", "expected a readable file, found none");
  }
  return sha256.digits();
}

std::string sha256_of_text(std::string_view text) {
  Sha256 sha256;
  sha256.add(text);
  return sha256.digits();
}

}  // namespace croon
