#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace smopt::experiments {

/// A piece of work among others.
struct GraphNode {
  std::vector<std::size_t> after;     ///< indices of those that must have ended before
  int threads = 1;                    ///< how many cores it uses
  bool is_alone = false;              ///< whether nothing else may run meanwhile
  std::function<double()> memory_mb;  ///< about what it will take, asked when it could start; empty: nothing to speak of
};

/// What there is to be shared.
struct GraphMachine {
  int cores = 1;
  double memory_mb = 0;  ///< what all that runs at once may take
};

/// Runs every node once, each in a thread of its own, as soon as those before it have ended and there is room for it.
///
/// Nodes that must be alone go first when they are ready, once what runs has ended: their predecessors are few, and the rest can then share the
/// machine. Among the others the first that fits starts; one that asks for more memory than there is runs by itself. Where a core would be idle because
/// all that is ready asks for more cores than are free, the first of these starts all the same: what runs will end before it.
/// \param run  of a node by its index; called from many threads at once. What it throws ends the run: nothing new is started, and the first
/// exception is thrown when all that runs has ended.
/// \param wait  called by this thread about ten times a second, and after each end, with what runs; what it throws ends the run likewise.
/// \pre the graph has no cycle, and each node's `after` names smaller indices only.
void run_graph(const std::vector<GraphNode>& nodes, const GraphMachine& machine, const std::function<void(std::size_t)>& run,
               const std::function<void(const std::vector<std::size_t>& running)>& wait);

}  // namespace smopt::experiments
