// Which functions of the C library's libm.so the program calls.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "test/support/script.hpp"
#include "test/support/temp_folder.hpp"
#include "test/support/tree.hpp"

namespace croon::test {
namespace {

#if defined(__has_feature)
constexpr bool kHasAddressSanitizer = __has_feature(address_sanitizer);
#else
constexpr bool kHasAddressSanitizer = false;
#endif

/// Those whose result is exact or correctly rounded, so that it is the same on every processor;
/// without the f or l at the end of the names for float and long double.
const std::set<std::string>& exact_functions() {
  static const std::set<std::string> names = {
      "ceil", "copysign", "fabs",    "fdim",   "floor",     "fma",       "fmax",
      "fmin", "fmod",     "frexp",   "ilogb",  "ldexp",     "llrint",    "llround",
      "logb", "lrint",    "lround",  "modf",   "nearbyint", "nextafter", "remainder",
      "rint", "round",    "scalbln", "scalbn", "sqrt",      "trunc"};
  return names;
}

bool is_exact(const std::string& name) {
  const bool has_suffix = ends_with(name, "f") || ends_with(name, "l");
  return exact_functions().count(name) > 0 ||
         (has_suffix && exact_functions().count(name.substr(0, name.size() - 1)) > 0);
}

/// Is `name` a function of the opened libm.so, and not of a library that this one needs?
bool is_in(void* libm, const std::string& name) {
  Dl_info info{};
  const void* const address = dlsym(libm, name.c_str());
  return address != nullptr && dladdr(address, &info) != 0 &&
         std::string(info.dli_fname).find("libm.so") != std::string::npos;
}

TEST(Libm, TheProgramCallsExactFunctionsOnly) {
  if (kHasAddressSanitizer) GTEST_SKIP() << "the sanitizer's runtime names functions of libm";
  void* const libm = dlopen("libm.so.6", RTLD_NOW);
  ASSERT_NE(libm, nullptr);
  ASSERT_TRUE(is_in(libm, "sin"));
  const TempFolder folder;
  const Finished listed = run_script(
      "nm -D --undefined-only --without-symbol-versions \"$(command -v croon)\" | awk '{print $2}'",
      folder.path());
  ASSERT_EQ(listed.status, 0) << listed.output;
  std::istringstream names(listed.output);
  int sleef_functions = 0;
  for (std::string name; names >> name;) {
    sleef_functions += starts_with(name, "Sleef_cinz_") ? 1 : 0;
    EXPECT_TRUE(!is_in(libm, name) || is_exact(name))
        << name << ": its bits depend on the processor; see framework/base/libm.hpp";
  }
  EXPECT_GT(sleef_functions, 0);
  dlclose(libm);
}

}  // namespace
}  // namespace croon::test
