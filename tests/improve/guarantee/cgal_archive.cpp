#include "tests/improve/guarantee/cgal_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "metrics/topology.h"
#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "smopt/io/sha256.h"
#include "tests/improve/judge.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace smopt::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kArchive = "/usr/share/doc/libcgal-dev/data.tar.gz";

/// Unpacks the archive's files that match a pattern.
void unpack(const std::string& pattern, const fs::path& folder) {
  const ProgramResult result = run_program("/bin/tar", {"-xzf", kArchive, "-C", folder, "--wildcards", pattern});
  if (result.exit_code != 0) throw std::runtime_error(fmt::format("{}: tar says {}", kArchive.string(), result.err));
}

/// The OFF files in a folder, sorted by name, each content once.
std::vector<fs::path> distinct_off_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() == ".off") files.push_back(entry.path());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) { return a.filename() < b.filename(); });
  std::set<std::string> seen;
  std::erase_if(files, [&seen](const fs::path& file) { return !seen.insert(sha256_of_file(file)).second; });
  return files;
}

std::string why_unusable(const TriangleMesh& mesh) {
  std::vector<std::string> notes;
  const metrics::Topology topology = metrics::measure_topology(mesh, notes);
  if (topology.triangles == 0) return "no triangles";
  if (topology.nonfinite_vertices > 0) return "not finite";
  if (!topology.edge_manifold) return "an edge with more than two triangles";
  if (!topology.closed) return "open";
  if (!topology.vertex_manifold) return "a vertex with more than one fan";
  const std::size_t pairs = intersecting_pairs(mesh).size();
  return pairs > 0 ? fmt::format("{} intersecting pairs", pairs) : "";
}

}  // namespace

bool has_cgal_archive() {
  return fs::exists(kArchive);
}

std::vector<ArchiveMesh> read_cgal_archive(std::vector<std::string>* rejected) {
  const TemporaryFolder folder;
  unpack("*.off", folder.path());
  std::vector<ArchiveMesh> meshes;
  for (const fs::path& file : distinct_off_files(folder.path())) {
    try {
      TriangleMesh mesh = read_mesh(file);
      std::string why = why_unusable(mesh);
      meshes.push_back({file.stem(), std::move(mesh), std::move(why)});
    } catch (const InvalidInput& error) {
      const std::string what = error.what();
      if (rejected != nullptr) rejected->push_back(what.substr(what.find(file.filename().string())));
    }
  }
  return meshes;
}

TriangleMesh read_from_cgal_archive(const std::string& name) {
  const TemporaryFolder folder;
  unpack("*/" + name + ".off", folder.path());
  const std::vector<fs::path> files = distinct_off_files(folder.path());
  if (files.empty()) throw std::runtime_error(fmt::format("no {}.off in {}", name, kArchive.string()));
  return read_mesh(files.front());
}

}  // namespace smopt::testing
