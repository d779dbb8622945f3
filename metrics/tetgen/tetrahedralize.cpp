#include "metrics/tetgen/tetrahedralize.h"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <regex>

#include "metrics/intersections.h"
#include "metrics/shape.h"
#include "metrics/tetgen/verification.h"
#include "metrics/tetgen/worker_location.h"
#include "metrics/tetgen/worker_protocol.h"
#include "smopt/error.h"
#include "smopt/io/child_process.h"
#include "smopt/io/scratch_folder.h"

namespace smopt::metrics {
namespace {

/// Switches that keep the input a surface and the output a mesh of four-cornered tetrahedra in the order this file relies on. Left out:
/// refining and coarsening (r, R, m, i), detecting (d), second order (o), weighting (w), hulls (c), other numbering (z), files (B, E, F, I,
/// N, e, f, g, k, n, v).
constexpr std::string_view kAllowedLetters = "pYqaASTMOXDCVQJ";
constexpr std::string_view kAllowedInNumbers = "0123456789./,-+e";  // as a switch, e only lists the edges too
constexpr std::size_t kLongestSwitches = 200;                       ///< TetGen copies them into buffers of 1024 characters

/// TetGen counts points and facets in ints, and three times as many array entries.
constexpr std::size_t kLargestCount = std::numeric_limits<int>::max() / 3;

/// The surface without the points that are in no triangle, and where its points come from.
struct Trimmed {
  TriangleMesh surface;
  std::vector<VertexId> original;
};

Trimmed without_isolated_points(const TriangleMesh& mesh) {
  constexpr VertexId kUnused = std::numeric_limits<VertexId>::max();
  std::vector<VertexId> new_id(mesh.vertex_count(), kUnused);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t) new_id[v] = 0;
  Trimmed trimmed;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (new_id[v] == kUnused) continue;
    new_id[v] = static_cast<VertexId>(trimmed.original.size());
    trimmed.original.push_back(static_cast<VertexId>(v));
    trimmed.surface.points.push_back(mesh.points[v]);
  }
  for (const auto& [a, b, c] : mesh.triangles) trimmed.surface.triangles.push_back({new_id[a], new_id[b], new_id[c]});
  return trimmed;
}

void require_options(const TetrahedralizeOptions& options) {
  const std::string& s = options.switches;
  if (s.size() > kLongestSwitches) throw InvalidOption("the TetGen switches are too long");
  if (s.find('p') == std::string::npos)
    throw InvalidOption(fmt::format("the TetGen switches '{}' lack p (mesh what a surface encloses)", s));
  for (const char c : s)
    if (kAllowedLetters.find(c) == std::string_view::npos && kAllowedInNumbers.find(c) == std::string_view::npos)
      throw InvalidOption(fmt::format("the TetGen switch '{}' is not for meshing a surface; allowed are {}", c, kAllowedLetters));
  if (!(options.time_limit_seconds > 0)) throw InvalidOption("the time limit must be positive");
}

/// Without what would hide messages or flood us with them; with J, which keeps the points' numbers.
std::string switches_for_worker(std::string switches) {
  std::erase_if(switches, [](char c) { return c == 'Q' || c == 'V'; });
  return switches + "J";
}

/// Empty when TetGen can be asked at all.
std::string why_not_worth_starting(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return "the mesh has no triangles";
  if (mesh.vertex_count() > kLargestCount || mesh.triangle_count() > kLargestCount)
    return "the mesh has more points or triangles than TetGen can count";
  for (std::size_t f = 0; f < mesh.triangle_count(); ++f) {
    for (const VertexId v : mesh.triangles[f]) {
      if (v >= mesh.vertex_count()) return fmt::format("triangle {} names vertex {} of {}", f, v, mesh.vertex_count());
      if (!mesh.points[v].allFinite()) return fmt::format("vertex {} of triangle {} has a coordinate that is not finite", v, f);
    }
  }
  return {};
}

/// What terminatetetgen()'s argument means (tetgen.h, version 1.5).
std::string meaning_of_code(int code, std::size_t memory_limit_mb) {
  switch (code) {
    case 1:
      return memory_limit_mb > 0 ? fmt::format("memory limit of {} MB exceeded", memory_limit_mb) : "out of memory";
    case 2:
      return "internal error of TetGen";
    case 3:
      return "self-intersection";
    case 4:
      return "very small input feature";
    case 5:
      return "two very close facets";
    case 10:
      return "input error";
    default:
      return "unknown error of TetGen";
  }
}

std::string name_of_signal(int signal) {
  const char* name = sigabbrev_np(signal);
  return name != nullptr ? fmt::format("SIG{}", name) : fmt::format("{}", signal);
}

/// TetGen's own words about points that it took for one, or empty. Numbers are those of the caller's mesh.
std::string merged_points(const std::string& output, const Trimmed& trimmed) {
  static const std::regex pattern(R"(Point #?(\d+) is (?:replaced by point |coincident with #)(\d+))");
  std::smatch match;
  if (!std::regex_search(output, match, pattern)) return {};
  const auto i = std::stoul(match[1]);
  const auto j = std::stoul(match[2]);
  if (i >= trimmed.original.size() || j >= trimmed.original.size()) return "near-duplicate points were merged";
  const double distance = (trimmed.surface.points[i] - trimmed.surface.points[j]).norm();
  return fmt::format("near-duplicate points {} and {} (distance {:.3g}) were merged", trimmed.original[i], trimmed.original[j], distance);
}

/// An angle below this (degrees) is worth naming when TetGen gives up on a surface without intersections; it meshes thinner ones now and
/// then.
constexpr double kSuspiciousAngle = 1;

/// What is known to be wrong with a surface that failed; empty when nothing is.
std::string diagnosis(const TriangleMesh& surface) {
  constexpr std::size_t kMany = 10'000;  // enough for a reason: of a tangle of a million vertices, counting all would take minutes
  const Intersections found = find_intersections(surface, {.list_limit = 1, .count_limit = kMany});
  if (!found.count) return "intersecting pairs of triangles: " + found.why_not_counted;
  if (found.pairs.empty()) {
    std::vector<std::string> ignored;
    const double angle = measure_shape(surface, ignored).angle.min.value_or(kSuspiciousAngle);
    return angle < kSuspiciousAngle ? fmt::format("no triangles intersect, the smallest angle is {:.3g}°", angle) : std::string();
  }
  const auto [f, g] = found.pairs.front();
  if (found.count == 1U) return fmt::format("triangles {} and {} intersect", f, g);
  return fmt::format("{} pairs of triangles intersect, first {} and {}", *found.count, f, g);
}

/// One try: the worker's end, its answer (if there is one), and what they mean.
class Attempt {
 public:
  Attempt(const Trimmed& trimmed, const TetrahedralizeOptions& options) : trimmed_(trimmed), options_(options) {}

  Tetrahedralization run() {
    ask_worker();
    Tetrahedralization result;
    result.reason = why_failed();
    result.success = result.reason.empty();
    result.code = answer_.code;
    result.seconds = process_.seconds;
    result.peak_memory_mb = answer_.code ? answer_.peak_memory_mb : process_.peak_memory_mb;
    result.tetgen_version = answer_.tetgen_version;
    result.tetrahedra = answer_.mesh.tetrahedra.size();
    if (result.success) result.mesh = std::move(answer_.mesh);
    return result;
  }

 private:
  void ask_worker() {
    const std::filesystem::path worker = find_tetgen_worker();
    const ScratchFolder folder("tetgen");
    const std::filesystem::path task = folder / "task", answer = folder / "answer";
    worker::write_bytes(task, worker::encode(worker::Task{switches_for_worker(options_.switches), trimmed_.surface}));
    process_ = run_process({worker.string(), task.string(), answer.string()}, {options_.time_limit_seconds, options_.memory_limit_mb},
                           "tetgen", options_.progress);
    if (process_.signal == SIGTERM || process_.signal == SIGINT) throw Cancelled();  // somebody ends all that runs: no verdict on the mesh
    read_answer(answer);
  }

  void read_answer(const std::filesystem::path& path) {
    try {
      answer_ = worker::decode_answer(worker::read_bytes(path));
    } catch (const InvalidInput&) {
      answer_ = {};  // it ended before it wrote one, or in the middle; how it ended is told by the process
    }
  }

  [[nodiscard]] std::string why_failed() const {
    std::string reason = process_fault();
    if (reason.empty() && answer_.code != 0)
      reason = fmt::format("{} (code {})", meaning_of_code(*answer_.code, options_.memory_limit_mb), *answer_.code);
    const std::string merged = merged_points(process_.output, trimmed_);
    if (reason.empty() && !merged.empty()) return merged;
    if (reason.empty()) reason = why_not_a_mesh_of(trimmed_.surface, answer_.mesh, options_.switches.find('Y') != std::string::npos);
    if (reason.empty()) return reason;
    for (const std::string& more : {merged, diagnosis(trimmed_.surface)})
      if (!more.empty()) reason += "; " + more;
    return reason;
  }

  /// Empty when the worker ended by itself and with an answer.
  [[nodiscard]] std::string process_fault() const {
    if (process_.out_of_time) return fmt::format("time limit of {:g} s exceeded", options_.time_limit_seconds);
    if (process_.signal) return fmt::format("TetGen crashed with signal {}{}", name_of_signal(*process_.signal), near_the_limit());
    if (process_.exit_status != 0)
      return fmt::format("the TetGen worker ended with status {}{}", process_.exit_status.value_or(-1), last_line());
    if (!answer_.code) return "the TetGen worker ended without an answer";
    return {};
  }

  /// ", its memory near the limit of 8192 MB", or empty: it crashes where it is short of memory.
  [[nodiscard]] std::string near_the_limit() const {
    constexpr double kNear = 0.9;  // what is limited is address space, which is more than what is resident
    const auto limit = static_cast<double>(options_.memory_limit_mb);
    if (limit == 0 || process_.peak_memory_mb < kNear * limit) return "";
    return fmt::format(", its memory near the limit of {} MB", options_.memory_limit_mb);
  }

  [[nodiscard]] std::string last_line() const {
    std::string_view text = process_.output;
    while (text.ends_with('\n')) text.remove_suffix(1);
    const std::string_view line = text.substr(text.rfind('\n') + 1);
    return line.empty() ? std::string() : fmt::format(": {}", line);
  }

  const Trimmed& trimmed_;
  const TetrahedralizeOptions& options_;
  ProcessOutcome process_;
  worker::Answer answer_;
};

}  // namespace

Tetrahedralization tetrahedralize(const TriangleMesh& surface, const TetrahedralizeOptions& options) {
  require_options(options);
  Tetrahedralization result;
  if (std::string why = why_not_worth_starting(surface); !why.empty())
    result.reason = std::move(why);
  else
    result = Attempt(without_isolated_points(surface), options).run();
  result.switches = options.switches;
  return result;
}

nlohmann::ordered_json to_json(const Tetrahedralization& r) {
  using Json = nlohmann::ordered_json;
  return {{"status", r.success ? "success" : "failed"},
          {"reason", r.reason.empty() ? Json() : Json(r.reason)},
          {"code", r.code ? Json(*r.code) : Json()},
          {"switches", r.switches},
          {"tetrahedra", r.tetrahedra},
          {"seconds", r.seconds},
          {"peak_memory_mb", r.peak_memory_mb},
          {"tetgen_version", r.tetgen_version.empty() ? Json() : Json(r.tetgen_version)}};
}

}  // namespace smopt::metrics
