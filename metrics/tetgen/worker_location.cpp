#include "metrics/tetgen/worker_location.h"

#include <fmt/format.h>

#include <cstdlib>

#include "smopt/error.h"

namespace smopt::metrics {
namespace {

constexpr const char* kVariable = "SMOPT_TETGEN_WORKER";
constexpr const char* kName = "smopt-tetgen-worker";

bool is_program(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

}  // namespace

std::filesystem::path find_tetgen_worker() {
  if (const char* named = std::getenv(kVariable); named != nullptr && *named != '\0') {
    if (is_program(named)) return std::filesystem::absolute(named);
    throw InvalidInput(fmt::format("the TetGen worker is not where {} says: {}", kVariable, named));
  }
  std::error_code ignored;
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  const std::filesystem::path beside = here / kName;
  const std::filesystem::path installed = (here / "../libexec/smopt" / kName).lexically_normal();
  for (const std::filesystem::path& candidate : {beside, installed})
    if (is_program(candidate)) return candidate;
  throw InvalidInput(fmt::format("the TetGen worker is missing: neither {} nor {} exists; {} can name it", beside.string(),
                                 installed.string(), kVariable));
}

}  // namespace smopt::metrics
