#include "smopt/io/mesh_io.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/io/rejection.h"
#include "tests/support/files.h"
#include "tests/support/shapes.h"

/// What holds for every format; what is special to one is in its own file.
namespace smopt::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A mesh of doubles of all magnitudes, which a text has to write with up to 17 digits.
TriangleMesh awkward_mesh(std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> exponent(-300, 300);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  TriangleMesh mesh = torus(3, 1, 12, 9);
  for (Vec3& p : mesh.points)
    for (int k = 0; k < 3; ++k) p[k] = mantissa(random) * std::pow(10.0, exponent(random));
  mesh.points[0] = {0.1, -0.0, std::numeric_limits<double>::denorm_min()};
  mesh.points[1] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::min(), 1.0 / 3};
  return mesh;
}

class MeshFormat : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] fs::path path() const { return folder_.path() / (std::string("mesh.") + GetParam()); }
  [[nodiscard]] TriangleMesh written_and_read(const TriangleMesh& mesh, const MeshWriteOptions& options = {}) const {
    write_mesh(path(), mesh, options);
    return read_mesh(path());
  }

  /// Puts the file there anew: some file systems wait for the disk when a file is cut and written again.
  [[nodiscard]] fs::path replaced_by(std::string_view content) const {
    fs::remove(path());
    return folder_.file(path().filename().string(), content);
  }

  TemporaryFolder folder_;
};

std::string test_name(const ::testing::TestParamInfo<const char*>& format) {
  std::string name = format.param;
  std::ranges::replace(name, '.', '_');
  return name;
}

/// Formats that hold the whole mesh (STL does not), that hold it as text, and that hold how large it is (OBJ does not).
class EveryMeshFormat : public MeshFormat {};
class WholeMeshFormat : public MeshFormat {};
class TextMeshFormat : public MeshFormat {};
class CountedMeshFormat : public MeshFormat {};
INSTANTIATE_TEST_SUITE_P(Io, EveryMeshFormat,
                         ::testing::Values("off", "off.gz", "ply", "ply.gz", "stl", "stl.gz", "obj", "obj.gz", "vtp", "vtp.gz", "vert",
                                           "face", "vert.gz"),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Io, WholeMeshFormat,
                         ::testing::Values("off", "off.gz", "ply", "ply.gz", "obj", "obj.gz", "vtp", "vtp.gz", "vert", "face", "vert.gz"),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Io, TextMeshFormat, ::testing::Values("off", "obj", "vtp", "vert", "face.gz"), test_name);
INSTANTIATE_TEST_SUITE_P(Io, CountedMeshFormat, ::testing::Values("off", "off.gz", "ply", "stl", "vtp", "vert", "face"), test_name);

TEST_P(EveryMeshFormat, IsReadableAndWritable) {
  EXPECT_TRUE(is_readable_mesh_format(path()));
  EXPECT_TRUE(is_writable_mesh_format(path()));
  EXPECT_FALSE(fs::exists(path()));
}

TEST_P(WholeMeshFormat, GivesTheSameDoublesBack) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const TriangleMesh mesh = awkward_mesh(seed);
    EXPECT_TRUE(is_bitwise_equal(written_and_read(mesh), mesh)) << "seed " << seed;
  }
}

TEST_P(TextMeshFormat, GivesPositionsToTheAskedDigits) {
  const TriangleMesh mesh = noisy(icosphere(2, 30), 1, 7);
  const TriangleMesh read = written_and_read(mesh, {.digits = 6});
  ASSERT_EQ(read.triangles, mesh.triangles);
  double largest_relative_error = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const double error = std::abs(read.points[i][k] / mesh.points[i][k] - 1);
      largest_relative_error = std::max(largest_relative_error, error);
    }
  EXPECT_LE(largest_relative_error, 0.5000001e-5);
  EXPECT_GT(largest_relative_error, 1e-8);
}

TEST_P(EveryMeshFormat, KeepsCoordinatesThatAreNotFinite) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  TriangleMesh mesh = tetrahedron();
  mesh.points[0] = {std::nan(""), inf, -inf};
  const TriangleMesh read = written_and_read(mesh);
  ASSERT_EQ(read.triangles, mesh.triangles);
  EXPECT_TRUE(std::isnan(read.points[0].x()));
  EXPECT_EQ(read.points[0].y(), inf);
  EXPECT_EQ(read.points[0].z(), -inf);
}

TEST_P(WholeMeshFormat, KeepsVerticesWithoutTriangles) {
  TriangleMesh mesh = tetrahedron();
  mesh.points.insert(mesh.points.begin() + 2, {7, 8, 9});
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t) v += v >= 2 ? 1U : 0U;
  EXPECT_TRUE(is_bitwise_equal(written_and_read(mesh), mesh));
}

TEST_P(WholeMeshFormat, KeepsAMeshWithoutTriangles) {
  const TriangleMesh mesh{{{1, 2, 3}, {4, 5, 6}}, {}};
  EXPECT_TRUE(is_bitwise_equal(written_and_read(mesh), mesh));
}

TEST_P(EveryMeshFormat, WritesTheSameBytesTwice) {
  const TriangleMesh mesh = noisy(icosphere(2), 0.1, 4);
  write_mesh(path(), mesh);
  const std::string first = bytes_of(path());
  write_mesh(path(), mesh);
  EXPECT_EQ(bytes_of(path()), first);
}

TEST_P(EveryMeshFormat, RejectsAMissingFile) {
  EXPECT_THAT(rejection(folder_.path(), [&] { read_mesh(path()); }), HasSubstr(": No such file or directory"));
}

TEST_P(EveryMeshFormat, RejectsAnEmptyFile) {
  write_mesh(path(), tetrahedron());
  const fs::path empty = replaced_by("");
  EXPECT_EQ(rejection(folder_.path(), [&] { read_mesh(empty); }), empty.filename().string() + ": the file is empty");
}

TEST_P(EveryMeshFormat, RejectsBytesOfAnotherKind) {
  write_mesh(path(), tetrahedron());
  const fs::path wrong = replaced_by("\x7f\x45LF\x01\x02\x03 this is no mesh\n1 2\n");
  EXPECT_THAT(rejection(folder_.path(), [&] { read_mesh(wrong); }), StartsWith(wrong.filename().string() + ":"));
}

// A file cut behind some byte is refused unless what is left is a whole mesh by the format's own rules.
TEST_P(CountedMeshFormat, NeverReadsACutFileAsAMeshOfOtherSize) {
  const TriangleMesh mesh = tetrahedron();
  write_mesh(path(), mesh);
  const std::string whole = bytes_of(path());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const fs::path cut = replaced_by(whole.substr(0, size));
    try {
      const TriangleMesh read = read_mesh(cut);
      EXPECT_EQ(read.points.size(), mesh.points.size()) << "cut to " << size;
      EXPECT_EQ(read.triangles.size(), mesh.triangles.size()) << "cut to " << size;
    } catch (const InvalidInput&) {
    }
  }
}

// Whatever a byte is changed to, the answer is a mesh with valid indices or an InvalidInput.
TEST_P(EveryMeshFormat, SurvivesDamage) {
  write_mesh(path(), tetrahedron());
  const std::string whole = bytes_of(path());
  std::mt19937 random(11);
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = whole;
    for (int changes = 1 + static_cast<int>(random() % 3); changes > 0; --changes)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    const fs::path file = replaced_by(damaged);
    try {
      const TriangleMesh mesh = read_mesh(file);
      for (const Triangle& t : mesh.triangles)
        for (const VertexId v : t) ASSERT_LT(v, mesh.points.size()) << "seed 11, case " << i;
    } catch (const InvalidInput&) {
    }
  }
}

TEST_P(TextMeshFormat, RejectsDigitsOutOfRange) {
  EXPECT_THROW(write_mesh(path(), tetrahedron(), {.digits = 18}), InvalidOption);
  EXPECT_THROW(write_mesh(path(), tetrahedron(), {.digits = -1}), InvalidOption);
  EXPECT_FALSE(fs::exists(path()));
}

TEST(MeshIo, NamesTheFormatsWhenItDoesNotKnowOne) {
  const TemporaryFolder folder;
  const std::string message = "a.xyz: not a mesh format by its name; known are off, ply, stl, obj, vtp, vert/face (each also .gz)";
  EXPECT_EQ(rejection(folder.path(), [&] { read_mesh(folder.path() / "a.xyz"); }), message);
  EXPECT_EQ(rejection(folder.path(), [&] { write_mesh(folder.path() / "a.xyz", tetrahedron()); }), message);
  EXPECT_FALSE(is_readable_mesh_format("a.xyz"));
  EXPECT_FALSE(is_writable_mesh_format("gz"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(MeshIo, AMinusIsOff) {
  EXPECT_TRUE(is_readable_mesh_format("-"));
  EXPECT_TRUE(is_writable_mesh_format("-"));
}

}  // namespace
}  // namespace smopt::testing
