#include "experiments/run/graph_run.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

namespace smopt::experiments {
namespace {

constexpr std::chrono::milliseconds kLookInterval{100};

enum class State { waiting, running, ended };

/// Threads that are joined whatever happens.
class GraphRun {
 public:
  GraphRun(const std::vector<GraphNode>& nodes, const GraphMachine& machine, const std::function<void(std::size_t)>& run)
      : nodes_(nodes), machine_(machine), run_(run), states_(nodes.size(), State::waiting) {}
  ~GraphRun() {
    for (auto& [node, thread] : threads_) thread.join();
  }
  GraphRun(const GraphRun&) = delete;
  GraphRun& operator=(const GraphRun&) = delete;

  void go(const std::function<void(const std::vector<std::size_t>&)>& wait) {
    std::exception_ptr failure;
    while (!is_finished(failure)) {
      if (!failure) start_what_can();
      wait_for_an_end();
      join_ended();
      try {
        wait(running());
      } catch (...) {
        if (!failure) failure = std::current_exception();
      }
      if (!failure) failure = first_failure();
    }
    if (failure) std::rethrow_exception(failure);
  }

 private:
  struct Share {
    int threads = 0;
    double memory_mb = 0;
  };

  [[nodiscard]] bool is_finished(const std::exception_ptr& failure) const {
    if (!shares_.empty()) return false;
    return failure || std::ranges::all_of(states_, [](State state) { return state == State::ended; });
  }

  [[nodiscard]] bool is_ready(std::size_t node) const {
    return states_[node] == State::waiting &&
           std::ranges::all_of(nodes_[node].after, [&](std::size_t before) { return states_[before] == State::ended; });
  }

  [[nodiscard]] std::optional<std::size_t> ready_alone() const {
    for (std::size_t node = 0; node < nodes_.size(); ++node)
      if (nodes_[node].is_alone && is_ready(node)) return node;
    return std::nullopt;
  }

  [[nodiscard]] Share share_of(std::size_t node) const {
    return {std::min(nodes_[node].threads, machine_.cores), nodes_[node].memory_mb ? nodes_[node].memory_mb() : 0};
  }

  [[nodiscard]] Share used() const {
    Share used;
    for (const auto& [node, share] : shares_) {
      used.threads += share.threads;
      used.memory_mb += share.memory_mb;
    }
    return used;
  }

  [[nodiscard]] bool has_room_for(const Share& share) const {
    if (shares_.empty()) return true;
    const Share others = used();
    return others.threads + share.threads <= machine_.cores && others.memory_mb + share.memory_mb <= machine_.memory_mb;
  }

  void start_what_can() {
    if (const auto alone = ready_alone()) {
      if (shares_.empty()) start(*alone, share_of(*alone));
      return;  // nothing else is begun before it
    }
    if (std::ranges::any_of(shares_, [&](const auto& running) { return nodes_[running.first].is_alone; })) return;
    start_what_fits([](const Share& share) { return share.threads; });
    start_what_fits([](const Share&) { return 1; });  // rather than leave a core idle
  }

  /// The first that fits when it gets so many cores, and so on.
  void start_what_fits(const std::function<int(const Share&)>& cores) {
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      if (!is_ready(node)) continue;
      const Share share = share_of(node);
      if (has_room_for({cores(share), share.memory_mb})) start(node, share);
    }
  }

  void start(std::size_t node, const Share& share) {
    states_[node] = State::running;
    shares_[node] = share;
    threads_[node] = std::thread([this, node] {
      std::exception_ptr failure;
      try {
        run_(node);
      } catch (...) {
        failure = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      if (failure && !failure_) failure_ = failure;
      ended_.push_back(node);
      has_ended_.notify_one();
    });
  }

  void wait_for_an_end() {
    std::unique_lock lock(mutex_);
    has_ended_.wait_for(lock, kLookInterval, [&] { return !ended_.empty(); });
  }

  void join_ended() {
    std::vector<std::size_t> ended;
    {
      const std::lock_guard lock(mutex_);
      ended.swap(ended_);
    }
    for (const std::size_t node : ended) {
      threads_.at(node).join();
      threads_.erase(node);
      shares_.erase(node);
      states_[node] = State::ended;
    }
  }

  [[nodiscard]] std::vector<std::size_t> running() const {
    std::vector<std::size_t> nodes;
    for (const auto& [node, share] : shares_) nodes.push_back(node);
    return nodes;
  }

  std::exception_ptr first_failure() {
    const std::lock_guard lock(mutex_);
    return failure_;
  }

  const std::vector<GraphNode>& nodes_;
  const GraphMachine& machine_;
  const std::function<void(std::size_t)>& run_;
  std::vector<State> states_;
  std::map<std::size_t, Share> shares_;  ///< of what runs
  std::map<std::size_t, std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable has_ended_;
  std::vector<std::size_t> ended_;  ///< and not yet joined
  std::exception_ptr failure_;
};

}  // namespace

void run_graph(const std::vector<GraphNode>& nodes, const GraphMachine& machine, const std::function<void(std::size_t)>& run,
               const std::function<void(const std::vector<std::size_t>& running)>& wait) {
  for (std::size_t node = 0; node < nodes.size(); ++node)
    assert(std::ranges::all_of(nodes[node].after, [node](std::size_t before) { return before < node; }));
  GraphRun(nodes, machine, run).go(wait);
}

}  // namespace smopt::experiments
