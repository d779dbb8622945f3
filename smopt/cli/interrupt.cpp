#include "smopt/cli/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "smopt/cli/command.h"

namespace smopt::cli {
namespace {

std::atomic<int> interrupts{0};
std::atomic<bool> is_cancellable{false};

void on_interrupt(int /*signal*/) {
  if (++interrupts > 1 || !is_cancellable) _exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

void install_interrupt_handler() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

CancellableSection::CancellableSection() {
  is_cancellable = true;
}
CancellableSection::~CancellableSection() {
  is_cancellable = false;
}

bool is_interrupted() {
  return interrupts > 0;
}

}  // namespace smopt::cli
