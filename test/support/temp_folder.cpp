#include "test/support/temp_folder.hpp"

#include <stdlib.h>

#include <fstream>
#include <stdexcept>

#include "framework/base/error.hpp"

namespace croon::test {

TempFolder::TempFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "croon_test_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for a test: " + name);
  path_ = std::filesystem::canonical(name);
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TempFolder::write(const std::string& name, const std::string& bytes) const {
  const std::filesystem::path path = path_ / name;
  std::filesystem::create_directories(path.parent_path());
  // Some file systems flush a file that is written over, and a fuzz test writes thousands.
  std::filesystem::remove(path);
  std::ofstream stream(path, std::ios::binary);
  if (!stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    throw std::runtime_error("cannot write " + path.string());
  }
  return path;
}

std::string input_error(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace croon::test
