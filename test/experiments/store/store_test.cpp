#include "experiments/store/store.hpp"

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

StoreHeader header_of_two() {
  StoreHeader header;
  header.provenance = {{"starts", R"({"rotation_deg": 45})"}};
  header.versions = {{"framework", 1}, {"step/drift", 3}};
  header.manifest = "{}";
  header.trials = 1000;
  header.variants = {{"base", R"([{"step": "drift"}])"}, {"other", "[]"}};
  header.scenes = {{"scene \"1\"", "urban"}};
  header.sensors = {{"left", "top"}};
  return header;
}

void add(Store& store, const TrialRecord& record) { store.add({&record}); }

TrialRecord random_record(Rng& rng, const std::string& variant, int trial) {
  TrialRecord record;
  record.id = {variant, "scene \"1\"", "left", trial};
  record.status = static_cast<Status>(rng.below(kStatusNames.size()));
  if (record.status == Status::failed) {
    record.reason = "ground_alignment: no plane; found 3, \"quoted\"";
    return record;
  }
  record.T_reference_sensor = test::random_pose(rng, 1e3);
  record.T_reference_sensor->translation.y() = trial % 2 == 0 ? -0.0 : 5.0;
  if (trial % 3 != 0) record.covariance = test::random_covariance(rng);
  const bool is_judged = record.status == Status::success || record.status == Status::inaccurate;
  if (is_judged || (record.status == Status::rejected && rng.below(2) == 0)) {
    record.error = pose_error(*record.T_reference_sensor, test::random_pose(rng, 1e3));
  }
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

void expect_same_record(const TrialRecord& a, const TrialRecord& b) {
  EXPECT_EQ(std::tie(a.id.variant, a.id.scene, a.id.sensor, a.id.trial),
            std::tie(b.id.variant, b.id.scene, b.id.sensor, b.id.trial));
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
  ASSERT_EQ(a.covariance.has_value(), b.covariance.has_value());
  if (a.covariance) {
    for (int i = 0; i < 36; ++i) {
      expect_same_bits(a.covariance->matrix(i), b.covariance->matrix(i));
    }
    EXPECT_EQ(a.covariance->dofs, b.covariance->dofs);
  }
  if (a.error) {
    for (int i = 0; i < 6; ++i) expect_same_bits(a.error->dof(i), b.error->dof(i));
    expect_same_bits(a.error->rotation_rad, b.error->rotation_rad);
    expect_same_bits(a.error->translation_m, b.error->translation_m);
  }
}

TEST(Store, GivesBackEveryBitOfARecord) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "s";
  std::vector<TrialRecord> records = random_records(60);
  {
    Store store(path, header_of_two());
    for (const TrialRecord& record : records) add(store, record);
  }
  for (int i = 0; i < 2; ++i) {
    const std::vector<TrialRecord> found = read_store(path).records;
    ASSERT_EQ(found.size(), records.size());
    EXPECT_EQ(stored_trials(path, stored_header(path), header_of_two()).size(), records.size());
    // By variant, then trial: report order.
    for (std::size_t k = 0; k < found.size(); ++k) {
      expect_same_record(found[k], records[k < 30 ? 2 * k : 2 * (k - 30) + 1]);
    }
    rewrite_in_order(path);
  }
}

TEST(Store, KeepsWhatEachStepReported) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "s";
  Rng rng = test::test_rng();
  TrialRecord record = random_record(rng, "base", 0);
  Matrix6d information;
  for (int i = 0; i < 36; ++i) information(i) = rng.normal();
  record.steps = {{"registration", 1.5, {{"rmse_m", 0.1}, {"iterations", 7.0}}, information},
                  {"odd",
                   0.5,
                   {{"nan", std::numeric_limits<double>::quiet_NaN()},
                    {"inf", -std::numeric_limits<double>::infinity()}},
                   {}}};
  {
    Store store(path, header_of_two());
    add(store, record);
  }
  rewrite_in_order(path);
  const Database database(path, Access::read);
  Statement select = database.prepare(
      "SELECT variant, scene, sensor, trial, place, step, figures, information FROM named_steps");
  ASSERT_TRUE(select.next());
  EXPECT_EQ(select.text(0) + select.text(2), "baseleft");
  EXPECT_EQ(select.text(5), "registration");
  EXPECT_EQ(select.text(6), R"({"rmse_m":0.1,"iterations":7.0})");
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> stored;
  ASSERT_EQ(select.text(7).size(), sizeof(double) * 36);
  std::memcpy(stored.data(), select.text(7).data(), sizeof(double) * 36);
  EXPECT_EQ(Matrix6d(stored), information);
  ASSERT_TRUE(select.next());
  EXPECT_EQ(select.integer(4), 1);
  EXPECT_EQ(select.text(6), R"({"nan":"nan","inf":"-inf"})");
  EXPECT_TRUE(select.is_null(7));
  EXPECT_FALSE(select.next());
}

TEST(Store, HasTheSameBytesWhateverTheOrderAndTheNumberOfSessions) {
  const test::TempFolder folder;
  std::vector<TrialRecord> records = random_records(40);
  std::vector<std::string> bytes;
  for (const std::size_t per_session : {40U, 7U, 1U}) {
    const std::filesystem::path path = folder.path() / std::to_string(per_session);
    for (std::size_t i = 0; i < records.size(); i += per_session) {
      {
        Store store(path, header_of_two());
        for (std::size_t k = i; k < std::min(i + per_session, records.size()); ++k) {
          add(store, records[k]);
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
  Store store(folder.path() / "s", header_of_two());
  for (const TrialRecord& record : records) add(store, record);
  // What a kill leaves: the files as they are while the store is open.
  const std::filesystem::path copy = folder.path() / "copy";
  std::filesystem::create_directory(copy);
  for (const char* name : {"s", "s-wal"}) {
    std::filesystem::copy_file(folder.path() / name, copy / name);
  }
  EXPECT_EQ(read_store(copy / "s").records.size(), records.size());
}

/// What opening the store `path` for `asked` is refused with.
std::string refusal(const std::filesystem::path& path, const StoreHeader& asked) {
  try {
    Store(path, asked);
    return "";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 1U);
    return error.faults()[0].message;
  }
}

TEST(Store, SaysWhatDiffers) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "s";
  { const Store store(path, header_of_two()); }
  const std::string bytes = read_whole_file(path);
  StoreHeader other = header_of_two();
  other.provenance["starts"] = R"({"rotation_deg": 30})";
  EXPECT_EQ(refusal(path, other),
            "its trials were made from different inputs: /starts/rotation_deg was 45 and is 30; "
            "--fresh deletes them and starts over, --out writes elsewhere");
  other.versions["step/drift"] = 4;
  other.variants[0].detail = R"([{"step": "drift", "size_m": 2}])";
  const std::string all = refusal(path, other);
  EXPECT_NE(all.find("version of step/drift was 3 and is 4; "), std::string::npos) << all;
  EXPECT_NE(all.find("/variants/base/0/size_m was missing and is 2"), std::string::npos) << all;
  EXPECT_EQ(read_whole_file(path), bytes);
}

TEST(Store, KeepsTheBuildsAndVersionsOfItsTrials) {
  const test::TempFolder folder;
  StoreHeader a = header_of_two(), b = header_of_two();
  a.builds = {{"0.1.0", "abc", "1", {{"my stages", "def-dirty"}}, {{"compiler", "GNU 12"}}}};
  b.builds = {{"0.1.0", "abc", "2", {}, {}}};
  b.versions = {{"framework", 1}, {"icp/icpn", 2}};
  for (const auto& [path, first, second] :
       {std::tuple(folder.path() / "ab", a, b), std::tuple(folder.path() / "ba", b, a)}) {
    { const Store store(path, first); }
    { const Store store(path, second); }
    const StoreHeader found = stored_header(path);
    ASSERT_EQ(found.builds.size(), 2U);
    EXPECT_EQ(found.builds[0].program_sha256, "1");
    EXPECT_EQ(found.builds[0].stage_folders.at(0).commit, "def-dirty");
    EXPECT_EQ(found.builds[0].libraries, a.builds[0].libraries);
    EXPECT_EQ(found.versions,
              (params::StageVersions{{"framework", 1}, {"icp/icpn", 2}, {"step/drift", 3}}));
    EXPECT_NE(test::input_error([&] { refuse_other_builds("s", found, a, "stop"); }), "");
    refuse_other_builds("s", a, a, "stop");
  }
}

TEST(Store, OfAnotherFormatIsRefused) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "s";
  { const Store store(path, header_of_two()); }
  Database(path, Access::write).run("UPDATE meta SET value = '4' WHERE name = 'format'");
  const std::string message = test::input_error([&] { read_store(path); });
  EXPECT_NE(message.find("is a store of format \"4\", expected \"5\", of another version of croon"),
            std::string::npos)
      << message;
}

TEST(Store, TakesMoreVariantsTrialsAndAnotherOrder) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.path() / "s";
  const std::vector<TrialRecord> records = random_records(20);
  {
    Store store(path, header_of_two());
    for (const TrialRecord& record : records) add(store, record);
  }
  StoreHeader more = header_of_two();
  more.variants = {{"new", "[]"}, {"other", "[]"}, {"base", more.variants[0].detail}};
  more.trials = 2000;
  EXPECT_EQ(stored_trials(path, stored_header(path), more).size(), 20U);
  EXPECT_EQ(std::get<0>(stored_trials(path, stored_header(path), more)[0]), 1U);
  { const Store store(path, more); }
  EXPECT_EQ(read_store(path).records.front().id.variant, "other");
  // A variant that is taken out stays in the store, and must be what it was when it comes back.
  StoreHeader fewer = header_of_two();
  fewer.variants.pop_back();
  fewer.trials = 5;
  { const Store store(path, fewer); }
  EXPECT_EQ(read_store(path).records.size(), 5U);
  EXPECT_EQ(stored_trials(path, stored_header(path), header_of_two()).size(), 20U);
  StoreHeader changed = header_of_two();
  changed.variants[1].detail = "[1]";
  EXPECT_NE(refusal(path, changed).find("/variants/other/- was missing and is 1"),
            std::string::npos);
}

TEST(Store, MergesShardsToTheBytesOfTheWhole) {
  const test::TempFolder folder;
  const std::vector<TrialRecord> records = random_records(40);
  const auto path = [&](const std::string& name) { return folder.path() / name; };
  {
    Store whole(path("whole"), header_of_two()), a(path("a"), header_of_two());
    StoreHeader turned = header_of_two();
    std::reverse(turned.variants.begin(), turned.variants.end());
    Store b(path("b"), turned);
    for (std::size_t i = 0; i < records.size(); ++i) {
      add(whole, records[i]);
      // Some are in both.
      if (i % 3 != 0) add(a, records[i]);
      if (i % 3 != 1) add(b, records[i]);
    }
  }
  rewrite_in_order(path("b"));
  rewrite_in_order(path("whole"));
  const std::string b_bytes = read_whole_file(path("b"));
  {
    Store merged(path("merged"), header_of_two());
    merged.merge(path("b"), stored_header(path("b")));
    merged.merge(path("a"), stored_header(path("a")));
    merged.merge(path("a"), stored_header(path("a")));
  }
  rewrite_in_order(path("merged"));
  EXPECT_EQ(read_whole_file(path("merged")), read_whole_file(path("whole")));
  EXPECT_EQ(read_whole_file(path("b")), b_bytes);
}

TEST(Store, MergesNothingThatDiffers) {
  const test::TempFolder folder;
  const std::vector<TrialRecord> records = random_records(4);
  TrialRecord other = records[1];
  other.reason += "!";
  StoreHeader seed = header_of_two();
  seed.provenance["seed"] = "2";
  {
    Store a(folder.path() / "a", header_of_two()), b(folder.path() / "b", header_of_two());
    const Store c(folder.path() / "c", seed);
    for (const TrialRecord& record : records) add(a, record);
    add(b, other);
  }
  Store a(folder.path() / "a", header_of_two());
  try {
    a.merge(folder.path() / "b", stored_header(folder.path() / "b"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults()[0].message, "1 of its trials ended differently in another store");
  }
  EXPECT_THROW(a.merge(folder.path() / "c", seed), InputError);
}

TEST(Store, BelongsToOneProcess) {
  const test::TempFolder folder;
  const Store store(folder.path() / "s", header_of_two());
  try {
    const Store other(folder.path() / "s", header_of_two());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults()[0].message, "another croon is working on this store");
  }
}

TEST(Store, SaysThatItIsDamaged) {
  for (const char* damage :
       {"UPDATE trials SET variant = 99999999", "UPDATE trials SET status = 'su?cess'",
        "DROP TABLE variants", "UPDATE meta SET value = 'many' WHERE name = 'trials'"}) {
    const test::TempFolder folder;
    const std::filesystem::path path = folder.path() / "s";
    {
      Store store(path, header_of_two());
      Rng rng = test::test_rng();
      add(store, random_record(rng, "base", 0));
    }
    Database(path, Access::write)
        .run(std::string("PRAGMA ignore_check_constraints = ON; ") + damage);
    const std::string message = test::input_error([&] { read_store(path); });
    EXPECT_NE(message.find(path.string() + ": is damaged"), std::string::npos)
        << damage << ": " << message;
  }
}

TEST(Store, RefusesWhatIsNoStore) {
  const test::TempFolder folder;
  const std::filesystem::path path = folder.write("s", std::string(5000, 'x'));
  EXPECT_THROW(Store(path, header_of_two()), InputError);
  EXPECT_EQ(read_whole_file(path), std::string(5000, 'x'));
  EXPECT_THROW(Store(folder.path() / "none" / "s", header_of_two()), InputError);
}

}  // namespace
}  // namespace croon::experiments
