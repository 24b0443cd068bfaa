// A process that dies, or a disk that fails, at each single change that SQLite makes to a file.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <functional>

#include "experiments/store/store.hpp"
#include "experiments/store/timings_store.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// What happens at the change to a file whose turn it is.
enum class Blow { kill, error };

Blow blow = Blow::kill;
int changes_before_blow = -1;  ///< Negative: it never happens.

/// Whether the blow falls now.
bool falls() {
  if (changes_before_blow < 0 || changes_before_blow-- > 0) return false;
  if (blow == Blow::kill) ::_exit(9);
  errno = EIO;
  return true;
}

ssize_t struck_pwrite(int file, const void* bytes, std::size_t size, off_t offset) {
  return falls() ? -1 : ::pwrite(file, bytes, size, offset);
}

int struck_ftruncate(int file, off_t size) { return falls() ? -1 : ::ftruncate(file, size); }

int struck_unlink(const char* path) { return falls() ? -1 : ::unlink(path); }

/// Puts functions of this file in the place of the system's, as SQLite calls them.
void replace_system_calls() {
  sqlite3_vfs* const system = sqlite3_vfs_find(nullptr);
  const auto replace = [&](const char* name, sqlite3_syscall_ptr call) {
    // Each version of SQLite uses one of the two names.
    if (system->xGetSystemCall(system, name) != nullptr) {
      ASSERT_EQ(system->xSetSystemCall(system, name, call), SQLITE_OK) << name;
    }
  };
  replace("pwrite", reinterpret_cast<sqlite3_syscall_ptr>(struck_pwrite));
  replace("pwrite64", reinterpret_cast<sqlite3_syscall_ptr>(struck_pwrite));
  replace("ftruncate", reinterpret_cast<sqlite3_syscall_ptr>(struck_ftruncate));
  replace("unlink", reinterpret_cast<sqlite3_syscall_ptr>(struck_unlink));
}

StoreHeader header_of_killed() {
  StoreHeader header;
  header.provenance = {{"seed", "1"}};
  header.manifest = "{}";
  header.trials = 1000;
  header.variants = {{"base", "[]"}};
  header.scenes = {{"scene", ""}};
  header.sensors = {{"left", "top"}};
  return header;
}

void add_trials(Store& store, int first, int count) {
  for (int trial = first; trial < first + count; ++trial) {
    TrialRecord record;
    record.id = {"base", "scene", "left", trial};
    record.reason = std::string(500, 'x');
    store.add({&record});
  }
}

/// What a run does with its store, in two sessions: creates it, adds trials, brings it in order,
/// and goes on. Writes a byte to `progress` after each trial that must survive.
void work(const fs::path& path, const fs::path& progress) {
  int done = 0;
  for (const int count : {2, 1}) {
    {
      Store store(path, header_of_killed());
      for (int i = 0; i < count; ++i) {
        add_trials(store, done++, 1);
        fs::resize_file(progress, static_cast<std::uintmax_t>(done));
      }
    }
    rewrite_in_order(path);
  }
}

/// The same for wall times: creates their file, and adds those of a trial at a time.
void time_trials(const fs::path& path, const fs::path& progress) {
  TimingsStore timings(path, Access::write);
  for (int trial = 0; trial < 3; ++trial) {
    const TrialId id = {"base", "scene", "left", trial};
    timings.add({{std::nullopt, {{id, "step", 0.5}, {id, std::string(5000, 'x'), 0.5}}}});
    fs::resize_file(progress, static_cast<std::uintmax_t>(trial) + 1);
  }
}

/// Works in a process of its own until the blow falls. Returns whether it fell.
bool work_until_blow(const std::function<void()>& work, int changes) {
  const pid_t child = ::fork();
  if (child == 0) {
    changes_before_blow = changes;
    try {
      work();
      ::_exit(changes_before_blow < 0 ? 9 : 0);
    } catch (const InputError&) {
      ::_exit(9);
    } catch (...) {
      ::_exit(1);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_TRUE(WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 9) << WEXITSTATUS(status);
  return WEXITSTATUS(status) == 9;
}

class KilledStore : public testing::TestWithParam<Blow> {
 protected:
  void SetUp() override {
    // In memory: on a disk, hundreds of sessions would wait a minute for it.
    if (fs::is_directory("/dev/shm")) ::setenv("TMPDIR", "/dev/shm", 1);
    replace_system_calls();
    blow = GetParam();
  }
};

TEST_P(KilledStore, KeepsItsTrialsAndGoesOn) {
  bool fell = true;
  int changes = 0;
  for (; fell; ++changes) {
    const test::TempFolder folder;
    const fs::path path = folder.path() / "s", progress = folder.write("progress", "");
    fell = work_until_blow([&] { work(path, progress); }, changes);
    const std::size_t done = fs::file_size(progress);
    SCOPED_TRACE(changes);
    EXPECT_FALSE(fs::exists(path.string() + "-journal"));
    const std::size_t found = stored_trials(path, stored_header(path), header_of_killed()).size();
    EXPECT_GE(found, done);
    EXPECT_LE(found, done + 1);
    {
      Store store(path, header_of_killed());
      add_trials(store, static_cast<int>(found), 3 - static_cast<int>(found));
    }
    rewrite_in_order(path);
    EXPECT_EQ(read_store(path).records.size(), 3U);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
  }
  EXPECT_GT(changes, 20);
}

TEST_P(KilledStore, KeepsItsWallTimesAndGoesOn) {
  bool fell = true;
  int changes = 0;
  for (; fell; ++changes) {
    const test::TempFolder folder;
    const fs::path path = folder.path() / "t", progress = folder.write("progress", "");
    fell = work_until_blow([&] { time_trials(path, progress); }, changes);
    const auto done = static_cast<int>(fs::file_size(progress));
    SCOPED_TRACE(changes);
    TimingsStore timings(path, Access::write);
    int found = 0, rows = 0;
    while (timings.has({"base", "scene", "left", found})) ++found;
    timings.for_each([&](const TimingRow&) { ++rows; });
    EXPECT_EQ(rows, 2 * found);
    EXPECT_GE(found, done);
    EXPECT_LE(found, done + 1);
    time_trials(path, progress);
    EXPECT_TRUE(timings.has({"base", "scene", "left", 2}));
    EXPECT_FALSE(fs::exists(path.string() + "-journal"));
  }
  EXPECT_GT(changes, 10);
}

INSTANTIATE_TEST_SUITE_P(AtEachChange, KilledStore, testing::Values(Blow::kill, Blow::error));

/// Leaves `path` as an earlier version did that was killed while it changed the journal mode.
void leave_journal(const fs::path& path, const std::string& change) {
  const pid_t child = ::fork();
  if (child == 0) {
    // Earlier versions wrote a journal and removed it at the end.
    Database database(path, Access::create);
    const auto keep = [](const char*) {
      ::_exit(9);
      return 0;
    };
    sqlite3_vfs* const system = sqlite3_vfs_find(nullptr);
    system->xSetSystemCall(system, "unlink", reinterpret_cast<sqlite3_syscall_ptr>(+keep));
    database.run(change);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 9);
  EXPECT_GT(fs::file_size(path.string() + "-journal"), 0U);
}

TEST(KilledStore, OfAnEarlierVersionIsHealed) {
  const test::TempFolder folder;
  const fs::path path = folder.path() / "s";
  {
    Store store(path, header_of_killed());
    add_trials(store, 0, 5);
  }
  rewrite_in_order(path);
  const std::string bytes = read_whole_file(path);
  leave_journal(path, "PRAGMA journal_mode = WAL");
  EXPECT_EQ(read_store(path).records.size(), 5U);
  EXPECT_EQ(read_whole_file(path), bytes);
  EXPECT_FALSE(fs::exists(path.string() + "-journal"));
}

/// Calls `work` in a process of its own, which ends without closing anything.
void run_and_die(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(KilledStore, InAFolderToReadSaysWhatToDo) {
  const test::TempFolder folder;
  const fs::path path = folder.path() / "s";
  run_and_die([&] {
    Store store(path, header_of_killed());
    add_trials(store, 0, 5);
    ::_exit(0);
    return 1;
  });
  ASSERT_TRUE(fs::exists(path.string() + "-wal"));
  fs::permissions(folder.path(), static_cast<fs::perms>(0555));
  run_and_die([&] {
    constexpr uid_t kNobody = 65534;
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) return 2;
    const std::string fault = test::input_error([&] { read_store(path); });
    return fault.find("was left by an interrupted run") == std::string::npos ? 1 : 0;
  });
  fs::permissions(folder.path(), static_cast<fs::perms>(0755));
  EXPECT_EQ(read_store(path).records.size(), 5U);
}

TEST(KilledStore, ThatAnEarlierVersionBeganIsNone) {
  const test::TempFolder folder;
  const fs::path path = folder.path() / "s";
  leave_journal(path, "PRAGMA journal_mode = WAL");
  EXPECT_FALSE(has_store(path));
  { const Store store(path, header_of_killed()); }
  EXPECT_TRUE(read_store(path).records.empty());
}

}  // namespace
}  // namespace croon::experiments
