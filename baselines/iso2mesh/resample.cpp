#include "baselines/iso2mesh/resample.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>

#include "baselines/cgal/cgal_call.h"
#include "baselines/cgal/surface_conversion.h"
#include "smopt/error.h"

namespace smopt::baselines {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
namespace sms = CGAL::Surface_mesh_simplification;

/// A cost without which no edge that touches a border is collapsed.
template <class Cost>
struct CostAwayFromBorders : Cost {
  template <class Profile, class Placement>
  auto operator()(const Profile& profile, const Placement& placement) const -> decltype(Cost::operator()(profile, placement)) {
    if (!profile.border_edges().empty()) return boost::none;
    return Cost::operator()(profile, placement);
  }
};

/// Progress by the edges that are still to go.
class CollapseVisitor : public sms::Edge_collapse_visitor_base<Surface> {
 public:
  CollapseVisitor(const ProgressCallback& progress, double stop_ratio) : progress_(&progress), stop_ratio_(stop_ratio) {}

  template <class Profile, class Cost>
  void OnSelected(const Profile& /*profile*/, const Cost& /*cost*/, std::size_t initial, std::size_t current) {
    if (++selected_ % kEdgesPerReport != 0) return;
    const double gone = 1 - static_cast<double>(current) / static_cast<double>(initial);
    report_progress(*progress_, "resampling", std::min(1.0, gone / (1 - stop_ratio_)));
  }

 private:
  /// A few milliseconds' worth.
  static constexpr std::size_t kEdgesPerReport = 1024;

  const ProgressCallback* progress_;
  double stop_ratio_;
  std::size_t selected_ = 0;
};

/// The ratio of edges below which there are `vertices` vertices left: a collapse takes three edges and a vertex. CGAL stops once the ratio
/// is less; half a vertex more than wanted is between two counts, whatever the rounding.
double stop_ratio(const Surface& surface, std::size_t vertices) {
  const double edges = surface.number_of_edges();
  const double collapses = static_cast<double>(surface.number_of_vertices()) - static_cast<double>(vertices);
  return (edges - 3 * (collapses - 0.5)) / edges;
}

template <class Cost, class Placement>
void collapse(Surface& surface, double ratio, const ProgressCallback& progress) {
  const sms::Count_ratio_stop_predicate<Surface> stop(ratio);
  sms::edge_collapse(surface, stop,
                     CGAL::parameters::get_cost(CostAwayFromBorders<Cost>())
                         .get_placement(Placement())
                         .visitor(CollapseVisitor(progress, ratio))
                         .geom_traits(Kernel()));
  surface.collect_garbage();
}

using CollapseFunction = void (*)(Surface&, double, const ProgressCallback&);
CollapseFunction collapse_function(CollapsePlacement placement) {
  return placement == CollapsePlacement::midpoint ? collapse<sms::Edge_length_cost<Surface>, sms::Midpoint_placement<Surface>>
                                                  : collapse<sms::LindstromTurk_cost<Surface>, sms::LindstromTurk_placement<Surface>>;
}

/// The number that a text of so many significant digits would give back.
double rounded(double value, int digits) {
  std::array<char, 32> text{};  // sign, 17 digits, point and exponent take 24
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
  double result = 0;
  std::from_chars(text.data(), end, result);
  return result + 0.0;  // −0 becomes 0
}

bool is_before(const Vec3& p, const Vec3& q) {
  return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
}

/// For each point, the first that is equal to it.
std::vector<VertexId> first_equals(const std::vector<Vec3>& points) {
  std::vector<VertexId> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](VertexId v, VertexId w) { return is_before(points[v], points[w]) || (points[v] == points[w] && v < w); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_repeated = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = is_repeated ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::size_t merge_equal_vertices(TriangleMesh& mesh) {
  const std::vector<VertexId> first = first_equals(mesh.points);
  std::vector<VertexId> new_id(mesh.points.size());
  std::vector<Vec3> kept;
  for (VertexId v = 0; v < first.size(); ++v) {
    new_id[v] = first[v] == v ? static_cast<VertexId>(kept.size()) : new_id[first[v]];
    if (first[v] == v) kept.push_back(mesh.points[v]);
  }
  for (Triangle& triangle : mesh.triangles)
    for (VertexId& v : triangle) v = new_id[v];
  const std::size_t merged = mesh.points.size() - kept.size();
  mesh.points = std::move(kept);
  return merged;
}

std::size_t round_and_merge(TriangleMesh& mesh, int digits) {
  if (digits == 0) return 0;
  for (Vec3& p : mesh.points) p = p.unaryExpr([&](double x) { return rounded(x, digits); });
  return merge_equal_vertices(mesh);
}

void require_options(const ResampleOptions& options) {
  constexpr int kMostDigits = 17;  // enough for any double
  if (options.digits < 0 || options.digits > kMostDigits)
    throw InvalidOption(fmt::format("digits to round to: expected 0 to {}, got {}", kMostDigits, options.digits));
}

}  // namespace

ResampleReport resample(TriangleMesh& mesh, const ResampleOptions& options, const ProgressCallback& progress) {
  require_options(options);
  require_surface(mesh, Borders::allowed);
  report_progress(progress, "resampling", 0);
  ResampleReport report;
  report.vertices_before = report.vertices_after = mesh.vertex_count();
  if (mesh.vertex_count() > options.vertices) {
    auto surface = to_surface<Surface>(mesh);
    call_cgal([&] { collapse_function(options.placement)(surface, stop_ratio(surface, options.vertices), progress); });
    mesh = from_surface(surface);
    report.merged_vertices = round_and_merge(mesh, options.digits);
    report.vertices_after = mesh.vertex_count();
  }
  const double off = static_cast<double>(report.vertices_after) - static_cast<double>(options.vertices);
  report.is_target_met = std::abs(off) <= kResampleTolerance * static_cast<double>(options.vertices);
  return report;
}

}  // namespace smopt::baselines
