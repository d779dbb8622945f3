#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <optional>

#include "smopt/io/base64.h"
#include "smopt/io/bytes.h"
#include "smopt/io/file.h"
#include "tests/io/rejection.h"
#include "tests/support/shapes.h"

/// Numbers at the vertices, read back by the formats' own rules and without the library's readers, which pass over them.
namespace smopt::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const TriangleMesh kMesh = tetrahedron();
const std::vector<double> kPotential = {-1.0 / 3, std::numeric_limits<double>::quiet_NaN(), 5e-324, 1e300};
const std::vector<double> kDerivative = {0.0, -0.0, kInfinity, -kInfinity};
const std::vector<VertexScalars> kScalars = {{"potential", kPotential}, {"normal_derivative", kDerivative}};

std::vector<double> doubles_in(std::string_view bytes) {
  std::vector<double> values;
  for (std::size_t at = 0; at + sizeof(double) <= bytes.size(); at += sizeof(double))
    values.push_back(load<double>(bytes.data() + at, std::endian::little));
  return values;
}

/// The bits of each, so that numbers that are not a number can be compared.
std::vector<std::uint64_t> bits_of(std::span<const double> values) {
  std::vector<std::uint64_t> bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

/// The array of that name of a VTP file, its leading size checked.
std::vector<double> vtp_array(const std::string& document, const std::string& name) {
  const std::size_t array = document.find("<DataArray type=\"Float64\" Name=\"" + name + "\" format=\"binary\">");
  if (array == std::string::npos) return {};
  const std::size_t begin = document.find('\n', array) + 1;
  const std::string bytes = decode_base64(document.substr(begin, document.find('<', begin) - begin)).value_or("");
  if (bytes.size() < 8 || load<std::uint64_t>(bytes.data(), std::endian::little) != bytes.size() - 8) return {};
  return doubles_in(std::string_view(bytes).substr(8));
}

/// The doubles of a PLY file's vertices, row by row, if its header says that they are these.
std::vector<double> ply_rows(const std::string& bytes, const std::string& properties) {
  const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 4\n" + properties +
                             "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  if (!bytes.starts_with(header)) return {};
  constexpr std::size_t kTriangles = 4 * (1 + 3 * 4);
  return doubles_in(std::string_view(bytes).substr(header.size(), bytes.size() - header.size() - kTriangles));
}

class ScalarFormat : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] fs::path path() const { return folder_.path() / (std::string("mesh.") + GetParam()); }

  TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Io, ScalarFormat, ::testing::Values("vtp", "ply", "vtp.gz", "ply.gz"), [](const auto& format) {
  std::string name = format.param;
  return name.substr(0, 3) + (name.size() > 3 ? "_gz" : "");
});

TEST_P(ScalarFormat, TheMeshIsReadBackBesideThem) {
  EXPECT_TRUE(is_scalar_mesh_format(path()));
  write_mesh_with_scalars(path(), kMesh, kScalars);
  EXPECT_TRUE(is_bitwise_equal(read_mesh(path()), kMesh));
}

TEST_P(ScalarFormat, WithoutAnyItIsThePlainMesh) {
  write_mesh(path(), kMesh);
  const std::string plain = bytes_of(path());
  write_mesh_with_scalars(path(), kMesh, {});
  EXPECT_EQ(bytes_of(path()), plain);
}

TEST_P(ScalarFormat, AnEmptyMeshHasEmptyArrays) {
  const std::vector<VertexScalars> empty = {{"potential", {}}};
  write_mesh_with_scalars(path(), {}, empty);
  EXPECT_EQ(read_mesh(path()).vertex_count(), 0U);
}

TEST_P(ScalarFormat, RefusesNamesAndLengthsThatDoNotFitAndWritesNothing) {
  const std::span<const double> three = std::span(kPotential).first(3);
  const std::vector<std::vector<VertexScalars>> wrong = {{{"potential", three}},    {{"", kPotential}},
                                                         {{"x", kPotential}},       {{"two words", kPotential}},
                                                         {{"quote\"", kPotential}}, {{"a", kPotential}, {"a", kDerivative}}};
  for (const auto& scalars : wrong) EXPECT_THROW(write_mesh_with_scalars(path(), kMesh, scalars), InvalidOption) << scalars.front().name;
  EXPECT_FALSE(fs::exists(path()));
}

TEST(VtpScalars, AreBinaryPointDataWithTheFirstActive) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.vtp.gz";
  write_mesh_with_scalars(path, kMesh, kScalars);
  const std::string document = read_file(path);
  const std::size_t begin = document.find("<PointData Scalars=\"potential\">");
  ASSERT_NE(begin, std::string::npos) << document;
  const std::string point_data = document.substr(begin, document.find("</PointData>") - begin);
  EXPECT_EQ(bits_of(vtp_array(point_data, "potential")), bits_of(kPotential));
  EXPECT_EQ(bits_of(vtp_array(point_data, "normal_derivative")), bits_of(kDerivative));
}

TEST(PlyScalars, AreFurtherPropertiesOfTheVertices) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "a.ply";
  write_mesh_with_scalars(path, kMesh, kScalars);
  const std::vector<double> rows = ply_rows(bytes_of(path),
                                            "property double x\nproperty double y\nproperty double z\nproperty double "
                                            "potential\nproperty double normal_derivative\n");
  std::vector<double> expected;
  for (std::size_t v = 0; v < 4; ++v) {
    const Vec3& p = kMesh.points[v];
    expected.insert(expected.end(), {p.x(), p.y(), p.z(), kPotential[v], kDerivative[v]});
  }
  EXPECT_EQ(bits_of(rows), bits_of(expected));
}

TEST(Scalars, OtherFormatsAreRefusedWithTheNamesOfThoseThatHoldThem) {
  const TemporaryFolder folder;
  for (const std::string ending : {"off", "stl", "obj", "vert", "face", "off.gz"}) {
    const fs::path path = folder.path() / ("a." + ending);
    EXPECT_FALSE(is_scalar_mesh_format(path));
    EXPECT_EQ(rejection(folder.path(), [&] { write_mesh_with_scalars(path, kMesh, kScalars); }),
              "a." + ending + ": " + ending.substr(0, ending.find('.')) +
                  " does not hold numbers at the vertices; these do: ply, vtp (each also .gz)");
  }
  EXPECT_THAT(rejection(folder.path(), [&] { write_mesh_with_scalars(folder.path() / "a.xyz", kMesh, kScalars); }),
              HasSubstr("a.xyz: not a mesh format by its name"));
  EXPECT_FALSE(is_scalar_mesh_format("a.xyz"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace smopt::testing
