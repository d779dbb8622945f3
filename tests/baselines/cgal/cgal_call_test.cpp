#include "baselines/cgal/cgal_call.h"

#include <CGAL/assertions.h>
#include <CGAL/exceptions.h>
#include <gmock/gmock.h>

#include <limits>

#include "baselines/cgal/call_watch.h"
#include "smopt/error.h"
#include "tests/support/shapes.h"

namespace smopt::baselines {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

void violate() {
  CGAL::precondition_fail("x > 0", "/some/folder/file.h", 12, "x must be positive");
}

TEST(CallCgal, TurnsAViolatedConditionIntoAFailureThatNamesIt) {
  EXPECT_THAT([] { call_cgal(violate); }, ThrowsMessage<MethodFailed>(HasSubstr("'x > 0' (x must be positive) at file.h:12")));
}

TEST(CallCgal, PrintsNothing) {
  ::testing::internal::CaptureStderr();
  EXPECT_THROW(call_cgal(violate), MethodFailed);
  EXPECT_NO_THROW(call_cgal([] { CGAL::warning_fail("x < 5", "file.h", 13, ""); }));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(CallCgal, PutsTheHandlersBackThatWereThere) {
  static int calls;
  calls = 0;
  const CGAL::Failure_function before = CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) { ++calls; });
  EXPECT_THROW(call_cgal(violate), MethodFailed);
  EXPECT_EQ(calls, 0);
  EXPECT_THROW(violate(), CGAL::Precondition_exception);
  EXPECT_EQ(calls, 1);
  CGAL::set_error_handler(before);
}

TEST(CallCgal, LetsOtherExceptionsThrough) {
  EXPECT_THROW(call_cgal([] { throw Cancelled(); }), Cancelled);
}

TEST(FiniteResult, NamesTheFirstVertexThatIsNot) {
  TriangleMesh mesh = smopt::testing::cube();
  EXPECT_NO_THROW(require_finite_result(mesh));
  mesh.points[5].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { require_finite_result(mesh); }, ThrowsMessage<MethodFailed>(HasSubstr("vertex 5")));
}

TEST(CallWatch, ReportsFractionsThatRiseToOne) {
  std::vector<double> fractions;
  const ProgressCallback progress = [&](std::string_view, double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  constexpr std::size_t kCounts = 20'000;
  CallWatch watch(progress, "stage", kCounts);
  for (std::size_t i = 0; i < 2 * kCounts; ++i) watch.count();  // twice what was expected
  EXPECT_EQ(watch.counted(), 2 * kCounts);
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_GT(fractions.size(), 5U);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
}

}  // namespace
}  // namespace smopt::baselines
