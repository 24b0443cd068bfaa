#include "framework/base/folder_lock.hpp"

#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

TEST(FolderLock, IsHeldOnceAndReleasedAtTheEnd) {
  const TempFolder folder;
  {
    const FolderLock lock(folder.path());
    EXPECT_THROW(FolderLock(folder.path()), InputError);
  }
  EXPECT_NO_THROW(FolderLock(folder.path()));
}

}  // namespace
}  // namespace croon::test
