#include "experiments/page/run_views.h"

#include <fmt/format.h>

#include <map>

#include "experiments/method_cases.h"
#include "experiments/record.h"
#include "experiments/run_layout.h"
#include "smopt/io/mesh_io.h"

namespace smopt::experiments {
namespace {

constexpr std::string_view kWithoutCavitiesTitle = "initial, cavities deleted";

std::string view_title(const RecordSet& records, std::string_view method) {
  return method == kWithoutCavities ? std::string(kWithoutCavitiesTitle) : method_title(records, method);
}

/// Initial first, as it says where is looked; what the methods were given last, as it differs little from it.
std::vector<std::string> methods_to_show(const RecordSet& records) {
  std::vector<std::string> methods = {std::string(kInitial)};
  for (std::string& method : records.methods())
    if (method != kInitial) methods.push_back(std::move(method));
  methods.emplace_back(kWithoutCavities);
  return methods;
}

/// Whether the record leaves it possible that triangles of the mesh intersect.
bool may_have_pairs(const RecordSet& records, std::string_view molecule, std::string_view method) {
  const std::string_view counted =
      method == kWithoutCavities ? kInitial : method;  // without cavities there are no more pairs than with them
  return number_at(records.find(molecule, counted), "/metrics/after/intersecting_pairs").value_or(1) > 0;
}

/// Puts views together as they come.
class ViewCollector {
 public:
  ViewCollector(const RecordSet& records, const std::filesystem::path& directory, const ViewLimits& limits)
      : records_(records), directory_(directory), limits_(limits) {}

  void add(const std::string& molecule, const std::string& method) {
    const std::optional<std::filesystem::path> path = find_mesh(directory_, molecule, method);
    if (!path) return;
    try {
      add_mesh(molecule, method, read_mesh(*path));
    } catch (const InvalidInput& error) {
      leave_out(molecule, method, error.what());
    }
  }

  RunViews take() { return std::move(views_); }

 private:
  void add_mesh(const std::string& molecule, const std::string& method, const TriangleMesh& mesh) {
    const bool has_pairs = may_have_pairs(records_, molecule, method);
    const Ball ball = balls_.try_emplace(molecule, ball_of(mesh, molecule, has_pairs)).first->second;
    MeshView view = mesh_view(mesh, ball, has_pairs);
    if (packed_bytes_ + new_bytes(view) > limits_.packed_bytes) {
      leave_out(molecule, method, fmt::format("the page's {} MB for meshes are used up", limits_.packed_bytes / 1'000'000));
      return;
    }
    view.facts["title"] = view_title(records_, method);
    view.facts["positions"] = blob_number(std::move(view.positions));
    view.facts["indices"] = blob_number(std::move(view.indices));
    entry(molecule)["meshes"][method] = std::move(view.facts);
    entry(molecule)["radius"] = ball.is_whole() ? nlohmann::ordered_json() : nlohmann::ordered_json(ball.radius);
  }

  /// The first mesh that is there, which is the initial one if the run has it, says where is looked.
  [[nodiscard]] Ball ball_of(const TriangleMesh& mesh, const std::string& molecule, bool has_pairs) const {
    return balls_.contains(molecule) ? Ball{} : ball_to_show(mesh, limits_.shown_triangles, has_pairs);
  }

  [[nodiscard]] std::size_t new_bytes(const MeshView& view) const {
    return (numbers_.contains(view.positions) ? 0 : view.positions.size()) + (numbers_.contains(view.indices) ? 0 : view.indices.size());
  }

  std::size_t blob_number(std::string blob) {
    const auto [place, is_new] = numbers_.try_emplace(std::move(blob), views_.blobs.size());
    if (is_new) {
      views_.blobs.push_back(place->first);
      packed_bytes_ += place->first.size();
    }
    return place->second;
  }

  void leave_out(const std::string& molecule, const std::string& method, const std::string& why) {
    entry(molecule)["left_out"][method] = {{"title", view_title(records_, method)}, {"why", why}};
  }

  nlohmann::ordered_json& entry(const std::string& molecule) {
    nlohmann::ordered_json& result = views_.molecules[molecule];
    if (result.is_null())
      result = {{"radius", nullptr}, {"meshes", nlohmann::ordered_json::object()}, {"left_out", nlohmann::ordered_json::object()}};
    return result;
  }

  const RecordSet& records_;
  const std::filesystem::path& directory_;
  const ViewLimits& limits_;
  RunViews views_;
  std::map<std::string, Ball> balls_;
  std::map<std::string, std::size_t> numbers_;  ///< of the blobs, by content
  std::size_t packed_bytes_ = 0;
};

}  // namespace

RunViews run_views(const RecordSet& records, const std::filesystem::path& directory, const ViewLimits& limits,
                   const ProgressCallback& progress) {
  const std::vector<std::string> molecules = records.molecules();
  const std::vector<std::string> methods = methods_to_show(records);
  ViewCollector collector(records, directory, limits);
  std::size_t done = 0;
  for (const std::string& method : methods) {
    for (const std::string& molecule : molecules) {
      report_progress(progress, "page", static_cast<double>(done++) / static_cast<double>(methods.size() * molecules.size()));
      collector.add(molecule, method);
    }
  }
  return collector.take();
}

}  // namespace smopt::experiments
