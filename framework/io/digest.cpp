#include "framework/io/digest.hpp"

#include <sha2.h>
#include <sys/types.h>

#include <array>

#include "framework/base/error.hpp"

namespace croon {

std::string sha256_of_file(const std::filesystem::path& path) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> digest{};
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) ||
      SHA256File(path.c_str(), digest.data()) == nullptr) {
    throw InputError(path.string(), "", "expected a readable file, found none");
  }
  return digest.data();
}

std::string sha256_of_text(std::string_view text) {
  std::array<char, SHA256_DIGEST_STRING_LENGTH> digest{};
  SHA256Data(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), digest.data());
  return digest.data();
}

}  // namespace croon
