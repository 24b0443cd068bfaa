#include "experiments/engine/store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

const Provenance kProvenance = {{"program", "1"}, {"starts", "x"}};

TrialRecord random_record(Rng& rng, const std::string& variant, int trial) {
  TrialRecord record;
  record.id = {variant, "scene \"1\"", "left", trial};
  record.status = static_cast<Status>(rng.below(4));
  if (record.status == Status::failed) {
    record.reason = "ground_alignment: no plane; found 3\nlines, \"quoted\"";
    return record;
  }
  record.T_reference_sensor = test::random_pose(rng, 1e3);
  record.T_reference_sensor->translation.y() = trial % 2 == 0 ? -0.0 : 5.0;
  if (rng.below(2) == 0) {
    record.error = pose_error(*record.T_reference_sensor, test::random_pose(rng, 1e3));
  }
  record.steps = {{"registration", 1.5, {{"rmse_m", rng.uniform()}, {"iterations", 7.0}}},
                  {"odd",
                   0.5,
                   {{"nan", std::numeric_limits<double>::quiet_NaN()},
                    {"inf", -std::numeric_limits<double>::infinity()},
                    {"zero", -0.0}}}};
  return record;
}

std::vector<TrialRecord> random_records(int count) {
  Rng rng = test::test_rng();
  std::vector<TrialRecord> records;
  for (int i = 0; i < count; ++i) {
    records.push_back(random_record(rng, i % 2 == 0 ? "base" : "other", i / 2));
  }
  return records;
}

void expect_same_bits(double a, double b) {
  EXPECT_TRUE(std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)))
      << a << " " << b;
}

void expect_same(const TrialRecord& a, const TrialRecord& b) {
  EXPECT_EQ(trial_key(a.id), trial_key(b.id));
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.reason, b.reason);
  ASSERT_EQ(a.T_reference_sensor.has_value(), b.T_reference_sensor.has_value());
  ASSERT_EQ(a.error.has_value(), b.error.has_value());
  if (a.T_reference_sensor) {
    for (int i = 0; i < 9; ++i) {
      expect_same_bits(a.T_reference_sensor->rotation(i), b.T_reference_sensor->rotation(i));
    }
    for (int i = 0; i < 3; ++i) {
      expect_same_bits(a.T_reference_sensor->translation(i), b.T_reference_sensor->translation(i));
    }
  }
  if (a.error) {
    for (int i = 0; i < 6; ++i) expect_same_bits(a.error->dof(i), b.error->dof(i));
    expect_same_bits(a.error->rotation_rad, b.error->rotation_rad);
    expect_same_bits(a.error->translation_m, b.error->translation_m);
  }
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) {
    EXPECT_EQ(a.steps[i].name, b.steps[i].name);
    EXPECT_EQ(b.steps[i].seconds, 0.0);
    ASSERT_EQ(a.steps[i].figures.size(), b.steps[i].figures.size());
    for (std::size_t k = 0; k < a.steps[i].figures.size(); ++k) {
      EXPECT_EQ(a.steps[i].figures[k].first, b.steps[i].figures[k].first);
      expect_same_bits(a.steps[i].figures[k].second, b.steps[i].figures[k].second);
    }
  }
}

TEST(Store, GivesBackEveryBitOfARecord) {
  const test::TempFolder folder;
  const std::vector<TrialRecord> records = random_records(60);
  {
    Store store(folder.path() / "s", kProvenance);
    for (const TrialRecord& record : records) store.add(record);
  }
  rewrite_in_order(folder.path() / "s");
  const Store store(folder.path() / "s", kProvenance);
  std::vector<TrialRecord> found = store.records();
  ASSERT_EQ(found.size(), records.size());
  EXPECT_EQ(store.keys().size(), records.size());
  for (const TrialRecord& record : records) {
    const auto same = std::find_if(found.begin(), found.end(), [&](const TrialRecord& other) {
      return trial_key(other.id) == trial_key(record.id);
    });
    ASSERT_NE(same, found.end());
    expect_same(record, *same);
  }
}

TEST(Store, HasTheSameBytesWhateverTheOrderAndTheNumberOfSessions) {
  const test::TempFolder folder;
  std::vector<TrialRecord> records = random_records(40);
  std::vector<std::string> bytes;
  for (const std::size_t per_session : {40U, 7U, 1U}) {
    const std::filesystem::path path = folder.path() / std::to_string(per_session);
    for (std::size_t i = 0; i < records.size(); i += per_session) {
      {
        Store store(path, kProvenance);
        for (std::size_t k = i; k < std::min(i + per_session, records.size()); ++k) {
          store.add(records[k]);
        }
      }
      if (i % 2 == 0) rewrite_in_order(path);
    }
    rewrite_in_order(path);
    bytes.push_back(read_whole_file(path));
    std::reverse(records.begin(), records.end());
    std::rotate(records.begin(), records.begin() + 11, records.end());
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  EXPECT_EQ(bytes[0], bytes[2]);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 3);
}

TEST(Store, WhatWasAddedOutlivesAKill) {
  const test::TempFolder folder;
  const std::vector<TrialRecord> records = random_records(10);
  Store store(folder.path() / "s", kProvenance);
  for (const TrialRecord& record : records) store.add(record);
  // What a kill leaves: the files as they are while the store is open.
  const std::filesystem::path copy = folder.path() / "copy";
  std::filesystem::create_directory(copy);
  for (const char* name : {"s", "s-wal"}) {
    std::filesystem::copy_file(folder.path() / name, copy / name);
  }
  const Store after(copy / "s", kProvenance);
  EXPECT_EQ(after.keys(), store.keys());
  EXPECT_EQ(after.keys().size(), records.size());
}

TEST(Store, SaysWhatDiffers) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "s";
  { const Store store(path, kProvenance); }
  EXPECT_NO_THROW(Store(path, kProvenance));
  try {
    Store(path, {{"program", "2"}, {"starts", "x"}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults()[0].message,
              "its trials were made with different program; --fresh deletes them and starts over, "
              "--out writes elsewhere");
  }
  try {
    Store(path, {{"program", "2"}, {"starts", "y"}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(error.faults()[0].message.find("program, starts"), std::string::npos);
  }
}

TEST(Store, BelongsToOneProcess) {
  const test::TempFolder folder;
  const Store store(folder.path() / "s", kProvenance);
  try {
    const Store other(folder.path() / "s", kProvenance);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults()[0].message, "another croon is working on this store");
  }
}

TEST(Store, RefusesWhatIsNoStore) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.write("s", std::string(5000, 'x'));
  EXPECT_THROW(Store(path, kProvenance), InputError);
  EXPECT_EQ(read_whole_file(path), std::string(5000, 'x'));
  EXPECT_THROW(Store(folder.path() / "none" / "s", kProvenance), InputError);
}

}  // namespace
}  // namespace croon::experiments
