#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <tuple>

#include "smopt/io/mesh_io.h"
#include "tests/cli/smopt_program.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using nlohmann::json;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// What the output file holds before a command that must not touch it.
constexpr const char* kOldContent = "what was there before";

/// A command that reads a mesh: its arguments with `in` and `out` in place of the files' names.
struct Command {
  std::string name;
  std::vector<std::string> arguments;
  std::string output;  ///< its file; empty where it has none
};

void PrintTo(const Command& command, std::ostream* out) {
  *out << command.name;
}

const std::vector<Command> kMeshCommands = {
    {"improve", {"improve", "in", "-o", "out"}, "out.off"},
    {"laplacian", {"improve", "in", "-o", "out", "--method", "laplacian"}, "out.off"},
    {"measure", {"measure", "in"}, ""},
    {"measure_json", {"measure", "in", "--json"}, ""},
    {"convert", {"convert", "in", "out"}, "out.ply"},
    {"tetrahedralize", {"tetrahedralize", "in", "-o", "out"}, "out.vtu"},
    {"solvate", {"solvate", "in", "not_reached.pqr", "-o", "out"}, "out.vtp"},
};
const std::vector<Command> kMoleculeCommands = {{"generate", {"generate", "in", "-o", "out"}, "out.off"}};

std::vector<std::string> arguments_of(const Command& command, const std::string& input, const std::string& output) {
  std::vector<std::string> arguments = command.arguments;
  for (std::string& argument : arguments) {
    if (argument == "in") argument = input;
    if (argument == "out") argument = output;
  }
  return arguments;
}

/// A file that cannot be read as what it should be, and what the complaint must say about the place.
struct Unreadable {
  std::string name;
  std::string file;
  std::optional<std::string> content;  ///< empty: there is no such file
  std::string place;                   ///< regular expression
};

void PrintTo(const Unreadable& bad, std::ostream* out) {
  *out << bad.name;
}

/// A tetrahedron in OFF, one line each, to be broken. Lines are counted from 1.
constexpr const char* kTetrahedron = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

std::string broken(std::string_view what, std::string_view with) {
  std::string text = kTetrahedron;
  return text.replace(text.find(what), what.size(), with);
}

const std::vector<Unreadable> kUnreadableMeshes = {
    {"Missing", "in.off", std::nullopt, "in\\.off: No such file"},
    {"Empty", "in.off", "", "in\\.off: .*empty"},
    {"Truncated", "in.off", std::string(kTetrahedron).substr(0, 42), "in\\.off:[0-9]+: .*ends"},
    {"TruncatedInANumber", "in.off", std::string(kTetrahedron).substr(0, std::string(kTetrahedron).size() - 3), "in\\.off:10: "},
    {"WrongHeader", "in.off", broken("OFF", "FOO"), "in\\.off:1: .*OFF"},
    {"NotText", "in.off",
     std::string("\x7f"
                 "ELF\0\1\2\3",
                 8),
     "in\\.off:1: "},
    {"MoreVerticesCounted", "in.off", broken("4 4 6", "5 4 6"), "in\\.off:[0-9]+: "},
    {"FewerVerticesCounted", "in.off", broken("4 4 6", "3 4 6"), "in\\.off:[0-9]+: "},
    {"MoreFacesCounted", "in.off", broken("4 4 6", "4 5 6"), "in\\.off:[0-9]+: .*faces"},
    {"FewerFacesCounted", "in.off", broken("4 4 6", "4 3 6"), "in\\.off:10: "},
    {"NegativeCount", "in.off", broken("4 4 6", "-4 4 6"), "in\\.off:2: "},
    {"HugeCount", "in.off", broken("4 4 6", "4000000000 4 6"), "in\\.off:2: "},
    {"IndexOutOfRange", "in.off", broken("3 0 1 3", "3 0 1 4"), "in\\.off:8: .*4"},
    {"NegativeIndex", "in.off", broken("3 0 1 3", "3 0 -1 3"), "in\\.off:8: .*-1"},
    {"PolygonOfFour", "in.off", broken("3 0 1 3", "4 0 1 3 2"), "in\\.off:8: face 1 has 4 vertices"},
    {"CoordinateThatIsNoNumber", "in.off", broken("0 1 0", "0 one 0"), "in\\.off:5: .*one"},
    {"TruncatedGzip", "in.off.gz", "\x1f\x8b\x08", "in\\.off\\.gz: "},
    {"UnknownFormat", "in.docx", kTetrahedron, "in\\.docx: "},
    {"TruncatedPly", "in.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\nelement face 1\nproperty list "
     "uchar "
     "int vertex_indices\nend_header\n0 0 0\n1 0 0\n",
     "in\\.ply:[0-9]+: "},
    {"PolygonOfFourInObj", "in.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "in\\.obj:5: "},
    {"IndexOutOfRangeInObj", "in.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n", "in\\.obj:4: .*9"},
    {"TruncatedStl", "in.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", "in\\.stl:[0-9]+: "},
    {"BrokenXml", "in.vtp", "<VTKFile type=\"PolyData\"><PolyData>", "in\\.vtp"},
    {"AFaceFileWithoutItsVertFile", "in.face", "# faces\n4 1 1.0 1.5\n1 2 3 1 1\n", "in\\.vert: No such file"},
};

const std::vector<Unreadable> kUnreadableMolecules = {
    {"Missing", "in.pqr", std::nullopt, "in\\.pqr: No such file"},
    {"Empty", "in.pqr", "", "in\\.pqr: .*empty"},
    {"WithoutAtoms", "in.pqr", "REMARK nothing here\nTER\nEND\n", "in\\.pqr.*atom"},
    {"TruncatedLine", "in.pqr", "ATOM 1 N ALA 1 0.0 0.0 0.0 1.0 2.0\nATOM 2 CA ALA 1 1.0 0.0\n", "in\\.pqr:2: "},
    {"CoordinateThatIsNoNumber", "in.pqr", "ATOM 1 N ALA 1 0.0 zero 0.0 1.0 2.0\n", "in\\.pqr:1: "},
    {"CoordinateThatIsNotFinite", "in.pqr", "ATOM 1 N ALA 1 0.0 nan 0.0 1.0 2.0\n", "in\\.pqr:1: "},
    {"NegativeRadius", "in.pqr", "ATOM 1 N ALA 1 0.0 0.0 0.0 1.0 -2.0\n", "in\\.pqr:1: "},
    {"TruncatedGzip", "in.pqr.gz", "\x1f\x8b\x08", "in\\.pqr\\.gz: "},
    {"UnknownFormat", "in.docx", "ATOM 1 N ALA 1 0.0 0.0 0.0 1.0 2.0\n", "in\\.docx: "},
};

class UnreadableInput : public ::testing::TestWithParam<std::tuple<Command, Unreadable>> {};

TEST_P(UnreadableInput, ExitsWith3NamesThePlaceAndLeavesTheOutputAlone) {
  const auto& [command, bad] = GetParam();
  const TemporaryFolder folder;
  const std::string output = path_in(folder, command.output);
  if (bad.content) std::ignore = folder.file(bad.file, *bad.content);
  for (const bool has_old_output : {false, true}) {
    if (has_old_output && command.output.empty()) continue;
    if (has_old_output) std::ignore = folder.file(command.output, kOldContent);
    const std::vector<std::string> before = files_in(folder);
    const ProgramResult r = run_smopt(arguments_of(command, path_in(folder, bad.file), output));
    EXPECT_EQ(r.exit_code, 3) << r.err << r.out;
    EXPECT_THAT(r.err, ContainsRegex(bad.place));
    EXPECT_THAT(r.out, IsEmpty());
    EXPECT_EQ(files_in(folder), before);
    if (has_old_output) {
      EXPECT_EQ(bytes_of(output), kOldContent);
    }
  }
}

std::string name_of(const ::testing::TestParamInfo<std::tuple<Command, Unreadable>>& info) {
  return std::get<0>(info.param).name + "_" + std::get<1>(info.param).name;
}

INSTANTIATE_TEST_SUITE_P(Meshes, UnreadableInput,
                         ::testing::Combine(::testing::ValuesIn(kMeshCommands), ::testing::ValuesIn(kUnreadableMeshes)), name_of);
INSTANTIATE_TEST_SUITE_P(Molecules, UnreadableInput,
                         ::testing::Combine(::testing::ValuesIn(kMoleculeCommands), ::testing::ValuesIn(kUnreadableMolecules)), name_of);

TEST(BadInput, StandardInputIsNamedAsSuch) {
  for (const Command& command : kMeshCommands) {
    const TemporaryFolder folder;
    const ProgramResult r = run_smopt(arguments_of(command, "-", path_in(folder, command.output)), broken("3 0 1 3", "3 0 1 4"));
    EXPECT_EQ(r.exit_code, 3) << command.name;
    EXPECT_THAT(r.err, HasSubstr("standard input:8: ")) << command.name;
    EXPECT_THAT(files_in(folder), IsEmpty()) << command.name;
  }
}

TEST(BadInput, OneBadMeshAmongSeveralPrintsNoHalfTable) {
  const TemporaryFolder folder;
  const std::string good = put_mesh(folder, "good.off", cube());
  const ProgramResult r = run_smopt({"measure", good, path_in(folder, "missing.off"), "--json"});
  EXPECT_EQ(r.exit_code, 3);
  EXPECT_THAT(r.err, HasSubstr("missing.off"));
  EXPECT_THAT(r.out, IsEmpty());
}

TEST(BadInput, ABadReferenceIsNamed) {
  const TemporaryFolder folder;
  const std::string good = put_mesh(folder, "good.off", cube());
  const ProgramResult r = run_smopt({"measure", good, "--reference", folder.file("bad.off", broken("OFF", "FOO")).string()});
  EXPECT_EQ(r.exit_code, 3);
  EXPECT_THAT(r.err, HasSubstr("bad.off:1: "));
}

/// A mesh that can be read and is no closed manifold; what `improve` must name and what `measure` must report.
struct Faulty {
  std::string name;
  TriangleMesh mesh;
  std::string place;  ///< in the complaint of `improve`
  std::string key;    ///< of `measure --json`
  json measured;
  bool is_hopeless_for_tetgen = true;  ///< a surface that is not manifold may still enclose something
};

void PrintTo(const Faulty& faulty, std::ostream* out) {
  *out << faulty.name;
}

TriangleMesh with_coordinate(double value) {
  TriangleMesh mesh = icosphere(1);
  mesh.points[17].y() = value;
  return mesh;
}

TriangleMesh with_face_twice() {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.push_back(mesh.triangles[5]);
  return mesh;
}

TriangleMesh without_face() {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.pop_back();
  return mesh;
}

/// Two cubes that share the vertex (1, 1, 1), or the edge above it.
TriangleMesh cubes_sharing(const std::vector<std::pair<VertexId, VertexId>>& same, const Vec3& shift) {
  TriangleMesh mesh = joined(cube(), translated(cube(), shift));
  for (Triangle& t : mesh.triangles)
    for (VertexId& v : t)
      for (const auto& [second, first] : same)
        if (v == second + 8) v = first;
  return mesh;
}

TriangleMesh with_repeated_corner() {
  TriangleMesh mesh = icosphere(1);
  mesh.triangles.push_back({3, 3, 4});
  return mesh;
}

const std::vector<Faulty> kFaulty = {
    {"NaN", with_coordinate(std::numeric_limits<double>::quiet_NaN()), "vertex 17", "nonfinite_vertices", 1},
    {"Infinite", with_coordinate(-std::numeric_limits<double>::infinity()), "vertex 17", "nonfinite_vertices", 1},
    {"DuplicateFaces", with_face_twice(), "faces 5 and 80", "edge_manifold", false},
    {"Open", without_face(), "edge [0-9]+-[0-9]+ \\(face [0-9]+\\)", "closed", false},
    {"NonManifoldVertex", cubes_sharing({{0, 7}}, {1, 1, 1}), "vertex 7 with 2 fans", "vertex_manifold", false, false},
    {"NonManifoldEdge", cubes_sharing({{0, 6}, {1, 7}}, {0, 1, 1}), "edge 6-7 with 4 faces", "edge_manifold", false, false},
    {"RepeatedCorner", with_repeated_corner(), "face 80 \\(3 3 4\\)", "degenerate_triangles", 1, false},
    {"NoTriangles", {{{0, 0, 0}}, {}}, "no triangles", "triangles", 0},
};

class FaultyMesh : public ::testing::TestWithParam<Faulty> {
 protected:
  TemporaryFolder folder;
  std::string input = put_mesh(folder, "in.off", GetParam().mesh);
};

TEST_P(FaultyMesh, IsRefusedByEveryMethodOfImproveWithThePlace) {
  for (const auto& method : json::parse(run_smopt({"methods", "--json"}).out)) {
    const ProgramResult r = run_smopt({"improve", input, "-o", path_in(folder, "out.off"), "--method", method["name"]});
    EXPECT_EQ(r.exit_code, 3) << method["name"] << r.err;
    EXPECT_THAT(r.err, HasSubstr(input)) << method["name"];
    EXPECT_THAT(r.err, ContainsRegex(GetParam().place)) << method["name"];
    EXPECT_THAT(files_in(folder), ::testing::ElementsAre("in.off")) << method["name"];
  }
}

TEST_P(FaultyMesh, LeavesTheOldOutputOfImproveAlone) {
  const std::string old = folder.file("out.off", kOldContent).string();
  EXPECT_EQ(run_smopt({"improve", input, "-o", old}).exit_code, 3);
  EXPECT_EQ(bytes_of(old), kOldContent);
}

TEST_P(FaultyMesh, IsNamedWhenItComesThroughAPipe) {
  const ProgramResult r = run_smopt({"improve", "-", "-o", "-"}, bytes_of(input));
  EXPECT_EQ(r.exit_code, 3);
  EXPECT_THAT(r.err, HasSubstr("standard input: "));
  EXPECT_THAT(r.err, ContainsRegex(GetParam().place));
  EXPECT_THAT(r.out, IsEmpty());
}

TEST_P(FaultyMesh, IsReportedByMeasure) {
  const ProgramResult r = run_smopt({"measure", input, "--json"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(json::parse(r.out)[GetParam().key], GetParam().measured) << r.out;
  EXPECT_EQ(run_smopt({"measure", input}).exit_code, 0);
}

TEST_P(FaultyMesh, IsConvertedAsItIs) {
  const std::string ply = path_in(folder, "copy.ply");
  const std::string back = path_in(folder, "copy.off");
  ASSERT_EQ(run_smopt({"convert", input, ply}).exit_code, 0);
  ASSERT_EQ(run_smopt({"convert", ply, back}).exit_code, 0);
  EXPECT_EQ(bytes_of(back), bytes_of(input));
}

TEST_P(FaultyMesh, IsAnAnswerOfTetrahedralizeAndNotACrash) {
  const ProgramResult r = run_smopt({"tetrahedralize", input, "--json"});
  const json answer = json::parse(r.out);
  EXPECT_EQ(r.exit_code, answer["status"] == "success" ? 0 : 1) << r.out;
  EXPECT_EQ(answer["status"] == "failed", answer["reason"].is_string()) << r.out;
  if (GetParam().is_hopeless_for_tetgen) {
    EXPECT_EQ(answer["status"], "failed");
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, FaultyMesh, ::testing::ValuesIn(kFaulty), [](const auto& faulty) { return faulty.param.name; });

}  // namespace
}  // namespace smopt::testing
