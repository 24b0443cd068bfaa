#include "experiments/store/store_writer.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "experiments/store/database.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

StoreHeader header_of_many() {
  StoreHeader header;
  header.provenance = {{"seed", "1"}};
  header.manifest = "{}";
  header.trials = 100000;
  header.variants = {{"base", "[]"}};
  header.scenes = {{"scene", ""}};
  header.sensors = {{"left", "top"}};
  return header;
}

Done trial(int number) {
  TrialRecord record;
  record.id = {"base", "scene", "left", number};
  return {record, {{record.id, "step", 0.5}}};
}

class StoreWriterTest : public testing::Test {
 protected:
  std::filesystem::path path() const { return folder_.path() / "store"; }

  test::TempFolder folder_;
};

TEST_F(StoreWriterTest, WritesAllAndTellsAfterwards) {
  constexpr int kTrials = 20000;  // Several times what may wait.
  std::size_t told = 0;
  bool is_in_order = true;
  {
    Store store(path(), header_of_many());
    StoreWriter writer(store, [&](const std::vector<Done>& batch) {
      for (const Done& done : batch) {
        if (done.record)
          is_in_order = is_in_order && done.record->id.trial == static_cast<int>(told);
        ++told;
      }
    });
    for (int i = 0; i < kTrials; ++i) writer.add(trial(i));
    writer.finish();
  }
  EXPECT_EQ(told, static_cast<std::size_t>(kTrials));
  EXPECT_TRUE(is_in_order);
  EXPECT_EQ(stored_trials(path(), stored_header(path()), header_of_many()).size(),
            static_cast<std::size_t>(kTrials));
}

TEST_F(StoreWriterTest, TellsOnlyWhatIsOnDisk) {
  Store store(path(), header_of_many());
  int told = 0;
  StoreWriter writer(
      store, [&](const std::vector<Done>& batch) { told += static_cast<int>(batch.size()); });
  // No store takes a trial twice: the batch with the second is on no disk.
  const TrialRecord record = *trial(0).record;
  store.add({&record});
  writer.add(trial(0));
  EXPECT_ANY_THROW(writer.finish());
  EXPECT_EQ(told, 0);
}

TEST_F(StoreWriterTest, TellsOfTimingsToo) {
  Store store(path(), header_of_many());
  int told = 0;
  StoreWriter writer(
      store, [&](const std::vector<Done>& batch) { told += static_cast<int>(batch.size()); });
  writer.add({{}, {{{"", "scene", "left", -1}, "reading", 0.1}}});
  writer.finish();
  EXPECT_EQ(told, 1);
}

TEST_F(StoreWriterTest, ThrowsWhatWritingThrew) {
  Store store(path(), header_of_many());
  StoreWriter writer(store, [](const std::vector<Done>&) { throw std::runtime_error("full"); });
  const auto add_until_it_fails = [&] {
    for (int i = 0; i < 100000; ++i) writer.add(trial(i));
    writer.finish();
  };
  EXPECT_THROW(add_until_it_fails(), std::runtime_error);
}

TEST_F(StoreWriterTest, WritesWhatItHasWhenItGoes) {
  {
    Store store(path(), header_of_many());
    StoreWriter writer(store, [](const std::vector<Done>&) {});
    for (int i = 0; i < 100; ++i) writer.add(trial(i));
  }
  EXPECT_EQ(stored_trials(path(), stored_header(path()), header_of_many()).size(), 100U);
}

}  // namespace
}  // namespace croon::experiments
