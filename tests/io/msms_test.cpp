#include "smopt/io/msms.h"

#include <gmock/gmock.h>

#include <fstream>

#include "smopt/io/gzip.h"
#include "tests/io/rejection.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

namespace fs = std::filesystem;

// In the layout of MSMS 2.6.1.
const std::string kVert =
    "# MSMS solvent excluded surface vertices for a.xyzr\n#vertex #sphere density probe_r\n      3      1  1.00  1.50\n"
    "    1.000     0.000     0.000     1.000     0.000     0.000       0      1  2\n"
    "    0.000     1.000     0.000     0.000     1.000     0.000       0      1  2\n"
    "    0.000     0.000     1.000     0.000     0.000     1.000       0      1  2\n";
const std::string kFace =
    "# MSMS solvent excluded surface faces for a.xyzr\n#faces  #sphere density probe_r\n      1      1  1.00  1.50\n"
    "      1      2      3  1      1\n";
const TriangleMesh kMesh = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}}};

std::string pair_rejection(std::string_view vert, std::string_view face) {
  const TemporaryFolder folder;
  put_file(folder, "a.vert", vert);
  put_file(folder, "a.face", face);
  return rejection(folder.path(), [&] { read_mesh(folder.path() / "a.vert"); });
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(Msms, EitherNameMeansThePair) {
  const TemporaryFolder folder;
  put_file(folder, "a.vert", kVert);
  put_file(folder, "a.face", kFace);
  EXPECT_TRUE(is_bitwise_equal(read_mesh(folder.path() / "a.vert"), kMesh));
  EXPECT_TRUE(is_bitwise_equal(read_mesh(folder.path() / "a.face"), kMesh));
}

TEST(Msms, ThePairMayBePackedBothOrEither) {
  const TemporaryFolder folder;
  put_file(folder, "a.b.vert.gz", gzip(kVert));
  put_file(folder, "a.b.face", kFace);
  EXPECT_TRUE(is_bitwise_equal(read_mesh(folder.path() / "a.b.vert.gz"), kMesh));
  EXPECT_TRUE(is_bitwise_equal(read_mesh(folder.path() / "a.b.face"), kMesh));
  write_mesh(folder.path() / "c.d.face.gz", kMesh);
  EXPECT_TRUE(is_gzip(bytes_of(folder.path() / "c.d.vert.gz")));
  EXPECT_TRUE(is_bitwise_equal(read_mesh(folder.path() / "c.d.vert.gz"), kMesh));
}

TEST(Msms, NormalsPointOutwards) {
  const MsmsText text = format_msms(icosphere(1, 2.0), {});
  std::istringstream lines(text.vert.substr(text.vert.find("\n42 ") + 1));
  std::string line;
  std::getline(lines, line);
  int vertices = 0;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    Vec3 p;
    Vec3 n;
    fields >> p.x() >> p.y() >> p.z() >> n.x() >> n.y() >> n.z();
    ASSERT_TRUE(fields);
    EXPECT_NEAR(n.norm(), 1, 1e-12);
    EXPECT_GT(n.dot(p) / 2, 0.99);
    ++vertices;
  }
  EXPECT_EQ(vertices, 42);
}

TEST(Msms, RejectsWhenTheOtherFileIsMissing) {
  const TemporaryFolder folder;
  put_file(folder, "a.vert", kVert);
  EXPECT_EQ(rejection(folder.path(), [&] { read_mesh(folder.path() / "a.vert"); }), "a.face: No such file or directory");
}

TEST(Msms, RejectsAWrongHeader) {
  EXPECT_EQ(pair_rejection("vertices 3\n", kFace), "a.vert:1: number of vertices is \"vertices\", expected an integer");
  EXPECT_EQ(pair_rejection("# nothing\n", kFace), "a.vert:1: the file ends before number of vertices");
}

TEST(Msms, RejectsATruncatedFile) {
  EXPECT_EQ(pair_rejection(kVert.substr(0, kVert.find("\n    0.000     0.000")), kFace), "a.vert:5: the file ends after 2 of 3 vertices");
  EXPECT_EQ(pair_rejection(kVert, replaced(kFace, "  3  1      1\n", "")), "a.face:4: vertex index is missing");
}

TEST(Msms, RejectsCountsThatDoNotMatch) {
  EXPECT_EQ(pair_rejection(replaced(kVert, "3      1  1.00", "2      1  1.00"), kFace),
            "a.vert:6: \"0.000\" follows as many vertices as the header counts");
  EXPECT_EQ(pair_rejection(replaced(kVert, "3      1  1.00", "4      1  1.00"), kFace), "a.vert:6: the file ends after 3 of 4 vertices");
  EXPECT_EQ(pair_rejection(kVert, replaced(kFace, "1      1  1.00", "2      1  1.00")), "a.face:4: the file ends after 1 of 2 faces");
  EXPECT_EQ(pair_rejection(kVert, kFace + "junk\n"), "a.face:5: \"junk\" follows as many faces as the header counts");
}

TEST(Msms, RejectsAbsurdCountsBeforeItAllocates) {
  EXPECT_EQ(pair_rejection("1000000000000 0 0 0\n0 0 0\n", kFace), "a.vert:1: number of vertices is 1000000000000, more than 4294967294");
  EXPECT_EQ(pair_rejection(kVert, "4000000000\n1 2 3\n"), "a.face:1: number of faces is 4000000000, but the file ends after 7 more bytes");
  EXPECT_EQ(pair_rejection(kVert, "-1\n1 2 3\n"), "a.face:1: number of faces is -1, less than none");
}

TEST(Msms, RejectsAnIndexOutOfRange) {
  const std::string count = "there are 3 vertices, counted from 1";
  EXPECT_EQ(pair_rejection(kVert, replaced(kFace, "3  1      1\n", "4  1      1\n")),
            "a.face:4: face 0: vertex index 4 is out of range, " + count);
  EXPECT_EQ(pair_rejection(kVert, replaced(kFace, "3  1      1\n", "0  1      1\n")),
            "a.face:4: face 0: vertex index 0 is out of range, " + count);
}

TEST(Msms, RejectsWhatIsNoNumber) {
  EXPECT_EQ(pair_rejection(replaced(kVert, "    1.000", "    1.0o0"), kFace), "a.vert:4: coordinate x is \"1.0o0\", expected a number");
}

}  // namespace
}  // namespace smopt::testing
