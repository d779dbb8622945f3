#include "experiments/remesh_study/mesh_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "metrics/edges.h"
#include "metrics/intersections.h"
#include "metrics/topology.h"
#include "smopt/error.h"
#include "smopt/io/child_process.h"
#include "smopt/io/mesh_io.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;

/// Some twenty megabytes are unpacked in a second.
constexpr double kUnpackingLimitSeconds = 120;

/// By name, so that the order is the same everywhere.
std::vector<fs::path> off_files(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InvalidInput(fmt::format("{}: no such folder", folder.string()));
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".off") files.push_back(entry.path());
  std::ranges::sort(files, {}, [](const fs::path& file) { return file.filename(); });
  return files;
}

/// What is wrong with a mesh and how it is said; the first that holds counts.
struct Fault {
  const char* text;
  bool (*holds)(const metrics::Topology&);
};

constexpr Fault kFaults[] = {
    {"coordinates that are not finite", [](const metrics::Topology& t) { return t.nonfinite_vertices > 0; }},
    {"not edge-manifold", [](const metrics::Topology& t) { return !t.edge_manifold; }},
    {"not closed", [](const metrics::Topology& t) { return !t.closed; }},
    {"not vertex-manifold", [](const metrics::Topology& t) { return !t.vertex_manifold; }},
    {"not consistently oriented", [](const metrics::Topology& t) { return !t.oriented; }},
    {"triangles without an area", [](const metrics::Topology& t) { return t.degenerate_triangles > 0; }},
    {"several vertices at one place", [](const metrics::Topology& t) { return t.duplicate_vertices > 0; }},
};

MeshFault uncleanness_of(const TriangleMesh& mesh) {
  std::vector<std::string> ignored;
  const metrics::Topology topology = metrics::measure_topology(mesh, ignored);
  for (const Fault& fault : kFaults)
    if (fault.holds(topology)) return {fault.text, ""};
  const auto pairs = metrics::find_intersections(mesh, {.list_limit = 0}).count;
  return pairs == 0 ? MeshFault() : MeshFault{"intersecting pairs", pairs ? fmt::format("{}", *pairs) : "too many to count"};
}

std::vector<Vec3> unit_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangle_count());
  for (const auto& [a, b, c] : mesh.triangles)
    normals.push_back((mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).stableNormalized());
  return normals;
}

/// What the reader says, without the file's name and the line.
std::string without_place(const std::string& message, const fs::path& file) {
  const std::string place = file.string() + ":";
  if (!message.starts_with(place)) return message;
  return message.substr(std::min(message.find_first_not_of(" :0123456789", place.size()), message.size()));
}

/// Reads a file; `judge` says what is wrong with its mesh.
template <class Judge>
MeshCandidate candidate_of(const fs::path& file, const Judge& judge) {
  MeshCandidate candidate;
  candidate.name = file.stem().string();
  candidate.file = file;
  try {
    TriangleMesh mesh = read_mesh(file);
    candidate.vertices = mesh.vertex_count();
    candidate.fault = judge(mesh);
    if (candidate.fault.reason.empty()) candidate.mesh = std::move(mesh);
  } catch (const InvalidInput& error) {
    candidate.fault = {"not read", without_place(error.what(), file)};
  }
  return candidate;
}

template <class Judge>
std::vector<MeshCandidate> candidates_in(const fs::path& folder, const Judge& judge) {
  std::vector<MeshCandidate> candidates;
  for (const fs::path& file : off_files(folder)) candidates.push_back(candidate_of(file, judge));
  return candidates;
}

}  // namespace

double share_of_sharp_edges(const TriangleMesh& mesh, double turn_deg) {
  const std::vector<Vec3> normals = unit_normals(mesh);
  const double least_cosine = std::cos(turn_deg * std::numbers::pi / 180);
  std::size_t edges = 0, sharp = 0;
  metrics::for_each_edge(metrics::edge_uses(mesh), [&](std::span<const metrics::EdgeUse> uses) {
    if (uses.size() != 2) return;
    const Vec3 &one = normals[uses[0].face], &other = normals[uses[1].face];
    if (one.isZero() || other.isZero()) return;
    ++edges;
    sharp += one.dot(other) < least_cosine ? 1 : 0;
  });
  return edges > 0 ? static_cast<double>(sharp) / static_cast<double>(edges) : 0;
}

MeshFault fault_of(const TriangleMesh& mesh, const MeshChoiceRule& rule) {
  if (mesh.vertex_count() < rule.least_vertices) return {fmt::format("fewer than {} vertices", rule.least_vertices), ""};
  if (MeshFault fault = uncleanness_of(mesh); !fault.reason.empty()) return fault;
  const double share = share_of_sharp_edges(mesh, rule.sharp_turn_deg);
  if (share <= rule.largest_sharp_share) return {};
  return {"not smooth", fmt::format("{:.1f} % of the edges are sharp", 100 * share)};
}

std::vector<MeshCandidate> choose_meshes(const fs::path& folder, const MeshChoiceRule& rule) {
  return candidates_in(folder, [&](const TriangleMesh& mesh) { return fault_of(mesh, rule); });
}

std::vector<MeshCandidate> all_meshes(const fs::path& folder) {
  return candidates_in(folder, [](const TriangleMesh&) { return MeshFault(); });
}

void unpack_meshes(const fs::path& archive, const fs::path& folder) {
  const std::vector<std::string> command = {"/usr/bin/env", "tar", "-xzf", archive.string(), "-C", folder.string(), "--wildcards", "*.off"};
  const ProcessOutcome outcome = run_process(command, {kUnpackingLimitSeconds, 0}, "unpack", {});
  if (outcome.exit_status != 0) throw InvalidInput(fmt::format("{}: {}", archive.string(), outcome.output));
}

}  // namespace smopt::experiments
