// MeshLab itself as the judge of baselines/meshlab.

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "baselines/external/external_meshlab.h"
#include "baselines/meshlab.h"
#include "smopt/error.h"
#include "smopt/io/mesh_io.h"
#include "tests/baselines/external/tool_fixture.h"
#include "tests/support/program.h"

namespace smopt::baselines {
namespace {

using namespace smopt::testing;

namespace fs = std::filesystem;

/// Positions that MeshLab reads without rounding.
TriangleMesh in_float32(TriangleMesh mesh) {
  for (Vec3& p : mesh.points) p = p.cast<float>().cast<double>();
  return mesh;
}

/// Closed, well-shaped, within ±1: 2562 and 1800 vertices.
std::vector<TriangleMesh> oracle_meshes() {
  return {in_float32(noisy(icosphere(4, 0.9), 0.02, 7)), in_float32(noisy(torus(0.6, 0.3, 60, 30), 0.01, 3))};
}

TriangleMesh by_us(TriangleMesh mesh, const MeshlabOptions& options) {
  smooth_meshlab(mesh, options);
  return mesh;
}

/// A coordinate as MeshLab prints it.
struct Printed {
  double value = 0;
  int digits = 0;  ///< from the first that is not 0 to the last
};

Printed parse(const std::string& text) {
  const std::string mantissa = text.substr(0, text.find_first_of("eE"));
  Printed result{std::stod(text), 0};
  bool has_begun = false;
  for (const char c : mantissa) {
    has_begun = has_begun || (c >= '1' && c <= '9');
    result.digits += has_begun && c >= '0' && c <= '9' ? 1 : 0;
  }
  return result;
}

/// The coordinates in an OFF file.
std::vector<Printed> printed_coordinates(const std::string& off) {
  std::istringstream in(off);
  std::string word;
  std::size_t vertices = 0, triangles = 0, edges = 0;
  in >> word >> vertices >> triangles >> edges;
  std::vector<Printed> result;
  for (std::size_t i = 0; i < 3 * vertices && in >> word; ++i) result.push_back(parse(word));
  return result;
}

/// One of the last digit of a coordinate that is printed with `digits` significant ones, zeros at the end left out.
double unit_of(double value, int digits) {
  const double magnitude = value == 0 ? 0 : std::floor(std::log10(std::abs(value))) + 1;
  return std::pow(10, magnitude - digits);
}

class MeshlabOracle : public ToolTest {
 protected:
  void SetUp() override {
    for (const char* name : {"/usr/bin/meshlabserver", "/usr/bin/xvfb-run", "/usr/bin/xauth"})
      if (!fs::exists(name)) GTEST_SKIP() << name << " is not installed";
  }

  /// What meshlabserver prints, started without any of our own code for that.
  std::vector<Printed> printed_by_meshlab(const TriangleMesh& mesh, int steps) {
    const fs::path in = folder() / "in.off", out = folder() / "out.off";
    write_mesh(in, mesh);
    const fs::path script = folder() / "s.mlx";
    write_script(script, steps);
    set_variable("LIBGL_ALWAYS_SOFTWARE", "1");
    const ProgramResult result =
        run_program("/usr/bin/xvfb-run", {"-a", "/usr/bin/meshlabserver", "-i", in.string(), "-o", out.string(), "-s", script.string()});
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    return printed_coordinates(bytes_of(out));
  }

 private:
  static void write_script(const fs::path& path, int steps) {
    std::ofstream(path) << "<!DOCTYPE FilterScript>\n<FilterScript>\n<filter name=\"Laplacian Smooth\">\n"
                        << "<Param type=\"RichInt\" value=\"" << steps << "\" name=\"stepSmoothNum\"/>\n"
                        << "<Param type=\"RichBool\" value=\"true\" name=\"Boundary\"/>\n"
                        << "<Param type=\"RichBool\" value=\"false\" name=\"cotangentWeight\"/>\n"
                        << "<Param type=\"RichBool\" value=\"false\" name=\"Selected\"/>\n</filter>\n</FilterScript>\n";
  }
};

TEST_F(MeshlabOracle, UniformWeightsAgreeToTwoUnitsOfItsLastPrintedDigit) {
  constexpr double kUnits = 2;
  for (const TriangleMesh& mesh : oracle_meshes()) {
    for (const int steps : {1, 3, 10}) {
      const std::vector<Printed> theirs = printed_by_meshlab(mesh, steps);
      const TriangleMesh ours = by_us(mesh, {steps, MeshlabWeights::uniform});
      ASSERT_EQ(theirs.size(), 3 * mesh.vertex_count());
      int digits = 0;  // in which it prints
      for (const Printed& p : theirs) digits = std::max(digits, p.digits);
      EXPECT_GE(digits, 6);
      for (std::size_t i = 0; i < theirs.size(); ++i) {
        const double coordinate = ours.points[i / 3][static_cast<int>(i % 3)];
        ASSERT_NEAR(coordinate, theirs[i].value, kUnits * unit_of(theirs[i].value, digits))
            << "vertex " << i / 3 << ", " << steps << " steps";
      }
    }
  }
}

/// The same mesh by MeshLab, as binary float32.
TriangleMesh by_meshlab(const TriangleMesh& mesh, int steps, const char* weights) {
  return run_method(external_meshlab_method(), mesh, {{"rounds", std::to_string(steps)}, {"weights", weights}}).mesh;
}

TEST_F(MeshlabOracle, BothWeightsAgreeToTheLastBitOfFloat32) {
  for (const TriangleMesh& mesh : oracle_meshes()) {
    for (const int steps : {1, 3, 10}) {
      EXPECT_EQ(by_us(mesh, {steps, MeshlabWeights::uniform}).points, by_meshlab(mesh, steps, "uniform").points) << steps << " steps";
      EXPECT_EQ(by_us(mesh, {steps, MeshlabWeights::cotangent}).points, by_meshlab(mesh, steps, "cotangent").points) << steps << " steps";
    }
  }
}

}  // namespace
}  // namespace smopt::baselines
