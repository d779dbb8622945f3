#pragma once

namespace smopt::cli {

/// Ctrl-C (and SIGTERM) ends the program with exit code 130: at once, or, while a `CancellableSection` is alive, when the section next
/// asks.
void install_interrupt_handler();

/// While alive, an interrupt is only noted, so that temporary files and child processes are cleaned up. A second one ends the program.
class CancellableSection {
 public:
  CancellableSection();
  ~CancellableSection();
  CancellableSection(const CancellableSection&) = delete;
  CancellableSection& operator=(const CancellableSection&) = delete;
};

bool is_interrupted();

}  // namespace smopt::cli
