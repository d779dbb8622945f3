#include "baselines/cgal/cgal_call.h"

#include <CGAL/assertions.h>
#include <CGAL/exceptions.h>
#include <fmt/format.h>

#include <filesystem>

#include "smopt/error.h"

namespace smopt::baselines {
namespace {

void print_nothing(const char* /*what*/, const char* /*expression*/, const char* /*file*/, int /*line*/, const char* /*message*/) {}

/// CGAL prints nothing as long as it lives.
class QuietCgal {
 public:
  QuietCgal() : error_(CGAL::set_error_handler(print_nothing)), warning_(CGAL::set_warning_handler(print_nothing)) {}
  QuietCgal(const QuietCgal&) = delete;
  QuietCgal& operator=(const QuietCgal&) = delete;
  ~QuietCgal() {
    CGAL::set_error_handler(error_);
    CGAL::set_warning_handler(warning_);
  }

 private:
  CGAL::Failure_function error_;
  CGAL::Failure_function warning_;
};

}  // namespace

void call_cgal(const std::function<void()>& call) {
  const QuietCgal quiet;
  try {
    call();
  } catch (const CGAL::Failure_exception& failure) {
    const std::string message = failure.message().empty() ? "" : " (" + failure.message() + ")";
    throw MethodFailed(fmt::format("CGAL: violated condition '{}'{} at {}:{}", failure.expression(), message,
                                   std::filesystem::path(failure.filename()).filename().string(), failure.line_number()));
  }
}

void require_finite_result(const TriangleMesh& mesh) {
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    if (!mesh.points[v].allFinite()) throw MethodFailed(fmt::format("CGAL: vertex {} of the result is not finite", v));
}

}  // namespace smopt::baselines
