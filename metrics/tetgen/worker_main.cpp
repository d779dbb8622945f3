// smopt-tetgen-worker TASK ANSWER: runs TetGen's library on a surface. A program of its own because the library crashes, never ends or
// takes all memory on some input; see tetrahedralize.h for who starts it and worker_protocol.h for the two files.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "metrics/tetgen/worker_protocol.h"
#include "smopt/peak_memory.h"

#define TETLIBRARY
#include <tetgen.h>

namespace smopt::metrics::worker {
namespace {

constexpr int kOutOfMemory = 1;    ///< terminatetetgen()'s code for it
constexpr int kInternalError = 2;  ///< likewise

std::filesystem::path answer_path;  ///< global, since terminatetetgen() brings nothing along
Answer answer;

/// "1.5.0" from the file name of the loaded libtet.so.1.5.0; from the header when the library is linked statically.
std::string tetgen_version() {
  using Function = void (*)(tetgenbehavior*, tetgenio*, tetgenio*, tetgenio*, tetgenio*);
  const Function function = tetrahedralize;
  Dl_info info{};
  std::error_code error;
  if (dladdr(reinterpret_cast<const void*>(function), &info) != 0 && info.dli_fname != nullptr) {
    const std::string name = std::filesystem::canonical(info.dli_fname, error).filename().string();
    constexpr std::string_view kBeforeVersion = ".so.";
    if (const auto at = name.find(kBeforeVersion); at != std::string::npos) return name.substr(at + kBeforeVersion.size());
  }
  return SMOPT_TETGEN_HEADER_VERSION;
}

void write_answer(std::optional<int> code) {
  answer.code = code;
  answer.peak_memory_mb = peak_memory_mb();
  write_bytes(answer_path, encode(answer));
}

void fill(tetgenio& in, const TriangleMesh& surface) {
  in.numberofpoints = static_cast<int>(surface.vertex_count());
  in.pointlist = new double[3 * surface.vertex_count()];
  for (std::size_t i = 0; i < surface.vertex_count(); ++i)
    for (int k = 0; k < 3; ++k) in.pointlist[3 * i + k] = surface.points[i][k];

  in.numberoffacets = static_cast<int>(surface.triangle_count());
  in.facetlist = new tetgenio::facet[surface.triangle_count()];
  in.facetmarkerlist = new int[surface.triangle_count()];
  for (std::size_t f = 0; f < surface.triangle_count(); ++f) {
    const auto& [a, b, c] = surface.triangles[f];
    tetgenio::facet& facet = in.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    facet.polygonlist[0] = {new int[3]{static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)}, 3};
    in.facetmarkerlist[f] = static_cast<int>(f) + 1;  // 0 means "no marker"
  }
}

TetMesh mesh_of(const tetgenio& out) {
  TetMesh mesh;
  for (int i = 0; i < out.numberofpoints; ++i)
    mesh.points.emplace_back(out.pointlist[3 * i], out.pointlist[3 * i + 1], out.pointlist[3 * i + 2]);
  for (int i = 0; i < out.numberoftetrahedra; ++i) {
    const int* t = out.tetrahedronlist + i * out.numberofcorners;
    mesh.tetrahedra.push_back(
        {static_cast<VertexId>(t[0]), static_cast<VertexId>(t[1]), static_cast<VertexId>(t[2]), static_cast<VertexId>(t[3])});
  }
  if (out.trifacelist == nullptr || out.trifacemarkerlist == nullptr) return mesh;
  for (int i = 0; i < out.numberoftrifaces; ++i) {
    const int* t = out.trifacelist + 3 * i;
    mesh.boundary_faces.push_back({static_cast<VertexId>(t[0]), static_cast<VertexId>(t[1]), static_cast<VertexId>(t[2])});
    mesh.surface_triangle.push_back(static_cast<FaceId>(out.trifacemarkerlist[i] - 1));
  }
  return mesh;
}

[[noreturn]] void leave(int status) {
  std::fflush(nullptr);
  std::_Exit(status);  // no destructors: TetGen's free memory twice after a failure
}

void run(const std::filesystem::path& task_path) {
  answer.tetgen_version = tetgen_version();
  write_answer(std::nullopt);
  Task task = decode_task(read_bytes(task_path));
  tetgenio in;
  tetgenio out;
  fill(in, task.surface);
  tetrahedralize(task.switches.data(), &in, &out);
  answer.mesh = mesh_of(out);
  write_answer(0);
  leave(EXIT_SUCCESS);
}

}  // namespace

[[noreturn]] void finish_with_code(int code);

void finish_with_code(int code) {
  write_answer(code);
  leave(EXIT_SUCCESS);
}

}  // namespace smopt::metrics::worker

int main(int argc, char** argv) {
  using namespace smopt::metrics::worker;
  if (argc != 3) {
    std::fputs("usage: smopt-tetgen-worker TASK ANSWER (started by smopt tetrahedralize)\n", stderr);
    return 2;
  }
  answer_path = argv[2];
  try {
    run(argv[1]);
  } catch (const std::bad_alloc&) {
    finish_with_code(kOutOfMemory);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (int code) {
    finish_with_code(code == 0 ? kInternalError : code);
  }
  return 4;
}
