#include "experiments/run/graph_run.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace smopt::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::Throws;

constexpr std::chrono::milliseconds kLong{30};  // long enough for what can run beside it to be started

void nothing(const std::vector<std::size_t>&) {}

GraphNode node(std::vector<std::size_t> after, int threads = 1, double memory_mb = 0) {
  GraphNode node;
  node.after = std::move(after);
  node.threads = threads;
  node.memory_mb = [memory_mb] { return memory_mb; };
  return node;
}

/// Notes what ran beside what.
class Witness {
 public:
  void run(std::size_t node, const std::vector<GraphNode>& nodes) {
    {
      const std::lock_guard lock(mutex_);
      threads_ += nodes[node].threads;
      memory_mb_ += nodes[node].memory_mb ? nodes[node].memory_mb() : 0;
      ++running_;
      most_threads = std::max(most_threads, threads_);
      most_memory_mb = std::max(most_memory_mb, memory_mb_);
      most_running = std::max(most_running, running_);
      if (nodes[node].is_alone && running_ > 1) had_company = true;
      started.push_back(node);
    }
    std::this_thread::sleep_for(kLong);
    const std::lock_guard lock(mutex_);
    threads_ -= nodes[node].threads;
    memory_mb_ -= nodes[node].memory_mb ? nodes[node].memory_mb() : 0;
    --running_;
    ended.push_back(node);
  }

  int most_threads = 0, most_running = 0;
  double most_memory_mb = 0;
  bool had_company = false;
  std::vector<std::size_t> started, ended;

 private:
  std::mutex mutex_;
  int threads_ = 0, running_ = 0;
  double memory_mb_ = 0;
};

TEST(GraphRun, AnEmptyGraphEnds) {
  run_graph(
      {}, {1, 100}, [](std::size_t) { FAIL(); }, nothing);
}

TEST(GraphRun, RunsEveryNodeOnceAndAfterThoseBeforeIt) {
  const std::vector<GraphNode> nodes = {node({}), node({0}), node({0}), node({1, 2}), node({})};
  std::mutex mutex;
  std::vector<int> times(nodes.size(), 0);
  run_graph(
      nodes, {4, 100},
      [&](std::size_t i) {
        const std::lock_guard lock(mutex);
        for (const std::size_t before : nodes[i].after) EXPECT_EQ(times[before], 1) << i;
        ++times[i];
      },
      nothing);
  EXPECT_THAT(times, ElementsAre(1, 1, 1, 1, 1));
}

TEST(GraphRun, UsesAllCoresAndNoMore) {
  std::vector<GraphNode> nodes;
  for (int i = 0; i < 8; ++i) nodes.push_back(node({}));
  Witness witness;
  run_graph(
      nodes, {3, 100}, [&](std::size_t i) { witness.run(i, nodes); }, nothing);
  EXPECT_EQ(witness.most_running, 3);
}

TEST(GraphRun, WhatAsksForMoreCoresThanThereAreHasThemAll) {
  const std::vector<GraphNode> nodes = {node({}), node({}, 1000), node({})};
  Witness witness;
  run_graph(
      nodes, {2, 100}, [&](std::size_t i) { witness.run(i, nodes); }, nothing);
  EXPECT_EQ(witness.ended.size(), 3U);
  EXPECT_LE(witness.most_running, 2);
}

TEST(GraphRun, NoCoreIsIdleForWhatWantsThemAll) {
  const std::vector<GraphNode> nodes = {node({}), node({}, 1000), node({}, 1000)};
  Witness witness;
  run_graph(
      nodes, {2, 100}, [&](std::size_t i) { witness.run(i, nodes); }, nothing);
  EXPECT_EQ(witness.most_running, 2);
  EXPECT_EQ(witness.started.back(), 2U) << "two that want all cores are not beside each other";
}

TEST(GraphRun, KeepsWithinTheMemory) {
  std::vector<GraphNode> nodes;
  for (int i = 0; i < 6; ++i) nodes.push_back(node({}, 1, 40));
  Witness witness;
  run_graph(
      nodes, {6, 100}, [&](std::size_t i) { witness.run(i, nodes); }, nothing);
  EXPECT_EQ(witness.most_memory_mb, 80);
}

TEST(GraphRun, WhatNeedsMoreMemoryThanThereIsRunsByItself) {
  const std::vector<GraphNode> nodes = {node({}, 1, 10), node({}, 1, 1000), node({}, 1, 10)};
  Witness witness;
  run_graph(
      nodes, {4, 100}, [&](std::size_t i) { witness.run(i, nodes); }, nothing);
  EXPECT_EQ(witness.ended.size(), 3U);
  EXPECT_EQ(witness.most_memory_mb, 1000);
}

TEST(GraphRun, WhatMustBeAloneIsAloneAndGoesFirst) {
  std::vector<GraphNode> nodes = {node({}), node({}), node({}), node({}), node({})};
  nodes[2].is_alone = nodes[4].is_alone = true;
  Witness witness;
  run_graph(
      nodes, {4, 100}, [&](std::size_t i) { witness.run(i, nodes); }, nothing);
  EXPECT_FALSE(witness.had_company);
  EXPECT_THAT(std::vector(witness.started.begin(), witness.started.begin() + 2), ElementsAre(2, 4));
}

TEST(GraphRun, AnExceptionEndsTheRunWhenAllThatRunsHasEnded) {
  std::vector<GraphNode> nodes = {node({}), node({}), node({0})};
  std::atomic<int> ended = 0;
  const auto run = [&](std::size_t i) {
    if (i == 0) throw std::runtime_error("no");
    std::this_thread::sleep_for(kLong);
    ++ended;
    EXPECT_NE(i, 2U) << "nothing new is started";
  };
  EXPECT_THAT([&] { run_graph(nodes, {2, 100}, run, nothing); }, ::testing::ThrowsMessage<std::runtime_error>("no"));
  EXPECT_EQ(ended, 1);
}

TEST(GraphRun, WhoWaitsIsToldWhatRunsAndCanEndIt) {
  const std::vector<GraphNode> nodes = {node({}), node({0}), node({1})};
  std::atomic<int> started = 0;
  const auto wait = [&](const std::vector<std::size_t>& running) {
    EXPECT_LE(running.size(), 1U);
    if (started == 1) throw std::runtime_error("enough");
  };
  EXPECT_THAT(
      [&] {
        run_graph(
            nodes, {2, 100}, [&](std::size_t) { ++started; }, wait);
      },
      Throws<std::runtime_error>());
  EXPECT_EQ(started, 1);
}

}  // namespace
}  // namespace smopt::experiments
