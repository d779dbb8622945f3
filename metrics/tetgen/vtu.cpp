#include "metrics/tetgen/vtu.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

#include "smopt/io/base64.h"

namespace smopt::metrics {
namespace {

static_assert(std::endian::native == std::endian::little, "the byte order below is written as it lies in memory");

constexpr std::uint8_t kVtkTetra = 10;  ///< VTK_TETRA
constexpr std::int64_t kCorners = 4;

/// Length and content, each as it lies in memory, in one base64 text: VTK's in-place binary array.
template <class T>
std::string binary_array(const std::vector<T>& values, std::string_view attributes) {
  const std::uint64_t size = values.size() * sizeof(T);
  std::string bytes(reinterpret_cast<const char*>(&size), sizeof(size));
  bytes.append(reinterpret_cast<const char*>(values.data()), size);
  return fmt::format("<DataArray {} format=\"binary\">\n{}\n</DataArray>\n", attributes, encode_base64(bytes));
}

std::vector<double> coordinates(const TetMesh& mesh) {
  std::vector<double> values;
  for (const Vec3& p : mesh.points) values.insert(values.end(), p.begin(), p.end());
  return values;
}

std::vector<std::int64_t> connectivity(const TetMesh& mesh) {
  std::vector<std::int64_t> values;
  for (const auto& [a, b, c, d] : mesh.tetrahedra) values.insert(values.end(), {a, b, c, d});
  return values;
}

std::vector<std::int64_t> offsets(const TetMesh& mesh) {
  std::vector<std::int64_t> values;
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) values.push_back(kCorners * static_cast<std::int64_t>(i + 1));
  return values;
}

}  // namespace

std::string to_vtu(const TetMesh& mesh) {
  const std::vector<std::uint8_t> types(mesh.tetrahedra.size(), kVtkTetra);
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
  text +=
      fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.points.size(), mesh.tetrahedra.size());
  text += "<Points>\n" + binary_array(coordinates(mesh), R"(type="Float64" Name="Points" NumberOfComponents="3")") + "</Points>\n";
  text += "<Cells>\n" + binary_array(connectivity(mesh), R"(type="Int64" Name="connectivity")");
  text += binary_array(offsets(mesh), R"(type="Int64" Name="offsets")");
  text += binary_array(types, R"(type="UInt8" Name="types")") + "</Cells>\n";
  return text + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace smopt::metrics
