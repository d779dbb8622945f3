#include "smopt/improve/move_guard.h"

#include "smopt/improve/exact_guard.h"
#include "smopt/improve/paper_guard.h"

namespace smopt {
namespace {

class NoGuard final : public LocalGuard {
 public:
  using LocalGuard::LocalGuard;
  bool is_ok() override { return true; }
};

}  // namespace

std::unique_ptr<MoveGuard> GuardFactory::operator()() const {
  switch (kind_) {
    case GuardKind::exact:
      return std::make_unique<ExactGuard>(surface_);
    case GuardKind::paper:
      return std::make_unique<PaperGuard>(surface_.mesh, surface_.rings, vicinity_);
    case GuardKind::none:
      return std::make_unique<NoGuard>(surface_.mesh);
  }
  return nullptr;
}

}  // namespace smopt
