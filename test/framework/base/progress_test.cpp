#include "framework/base/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <thread>
#include <vector>

namespace croon::test {
namespace {

/// A progress whose time the test sets.
struct ProgressRun {
  explicit ProgressRun(ProgressStyle style, std::size_t total)
      : progress(out, style, total, [this] { return now_s; }) {}

  std::ostringstream out;
  double now_s = 100.0;
  Progress progress;
};

TEST(Progress, QuietSaysNothing) {
  ProgressRun run(ProgressStyle::none, 10);
  run.progress.set_scene("0001");
  run.now_s += 100.0;
  run.progress.advance(10);
  run.progress.finish();
  EXPECT_EQ(run.out.str(), "");
}

TEST(Progress, ALogGetsALineAtEveryTenthAndEveryTenSeconds) {
  ProgressRun run(ProgressStyle::lines, 1000);
  run.progress.set_scene("0001");
  run.now_s += 1.0;
  run.progress.advance(99);
  EXPECT_EQ(run.out.str(), "");
  run.progress.advance(1);
  EXPECT_EQ(run.out.str(), "100/1000  100/s  0:09 to go  0001\n");
  run.out.str("");
  run.now_s += 9.9;
  run.progress.advance(1);
  EXPECT_EQ(run.out.str(), "");
  run.now_s += 0.1;
  run.progress.advance(9);
  EXPECT_EQ(run.out.str(), "110/1000  10/s  1:29 to go  0001\n");
  run.out.str("");
  run.progress.advance(890);
  run.progress.finish();
  run.progress.finish();
  EXPECT_EQ(run.out.str(), "1000/1000  91/s  in 0:11\n");
}

TEST(Progress, ATerminalGetsOneLineDrawnAnew) {
  ProgressRun run(ProgressStyle::bar, 4);
  run.progress.set_scene("a scene with a name");
  run.progress.advance();
  EXPECT_EQ(run.out.str(), "");  // Too soon to draw.
  run.now_s += 4.0;
  run.progress.advance();
  const std::string bar =
      "\r[############............] 2/4  0.50/s  0:04 to go  a scene with a name";
  EXPECT_EQ(run.out.str(), bar);
  run.out.str("");
  run.progress.advance(2);
  run.progress.finish();
  const std::string last = "\r[########################] 4/4  1.00/s  in 0:04";
  EXPECT_EQ(run.out.str(), last + std::string(bar.size() - last.size(), ' ') + "\n");
}

TEST(Progress, LongSceneNamesDoNotWrap) {
  ProgressRun run(ProgressStyle::bar, 4);
  run.progress.set_scene(std::string(200, 'x'));
  run.now_s += 1.0;
  run.progress.advance();
  EXPECT_EQ(run.out.str().size(), 1 + 78 + std::string("…").size());
}

TEST(Progress, WhatTheStoreHasIsDoneButNotPartOfTheRate) {
  ProgressRun run(ProgressStyle::lines, 100);
  run.progress.skip(80);
  EXPECT_EQ(run.out.str(), "80/100\n");
  run.out.str("");
  run.now_s += 10.0;
  run.progress.advance(10);
  EXPECT_EQ(run.out.str(), "90/100  1.00/s  0:10 to go\n");
}

TEST(Progress, NothingToDoIsDone) {
  ProgressRun run(ProgressStyle::bar, 0);
  run.progress.finish();
  EXPECT_EQ(run.out.str(), "\r[########################] 0/0  in 0:00\n");
}

TEST(Progress, ThreadsLoseNoTrial) {
  std::ostringstream out;
  {
    Progress progress(out, ProgressStyle::lines, 4000, [] { return 0.0; });
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < 1000; ++k) progress.advance();
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  const std::string text = out.str();
  EXPECT_NE(text.rfind("\n4000/4000  "), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
}

}  // namespace
}  // namespace croon::test
