#include "smopt/io/vtp.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <zlib.h>

#include "smopt/io/base64.h"
#include "smopt/io/bytes.h"
#include "tests/io/rejection.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using ::testing::HasSubstr;

const TriangleMesh kMesh = {{{0, 0, 0.5}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};

// As VTK 9 writes it in text mode, with the other cells and data fields that it always writes.
const std::string kText = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <PolyData>
    <Piece NumberOfPoints="3"                    NumberOfVerts="0"                    NumberOfLines="0"                    NumberOfStrips="0"                    NumberOfPolys="2"                   >
      <PointData Normals="Normals">
        <DataArray type="Float32" Name="Normals" NumberOfComponents="3" format="ascii" RangeMin="1" RangeMax="1">
          0 0 1 0 0 1
          0 0 1
        </DataArray>
      </PointData>
      <CellData>
      </CellData>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii" RangeMin="0.5" RangeMax="1">
          0 0 0.5 1 0 0
          0 1 0
          <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2">
            <Value index="0">
              0.5
            </Value>
          </InformationKey>
        </DataArray>
      </Points>
      <Verts>
        <DataArray type="Int64" Name="connectivity" format="ascii" RangeMin="1e+299" RangeMax="-1e+299">
        </DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii" RangeMin="1e+299" RangeMax="-1e+299">
        </DataArray>
      </Verts>
      <Polys>
        <DataArray type="Int64" Name="connectivity" format="ascii" RangeMin="0" RangeMax="2">
          0 1 2 0 2 1
        </DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii" RangeMin="3" RangeMax="6">
          3 6
        </DataArray>
      </Polys>
    </Piece>
  </PolyData>
</VTKFile>
)";

std::string vtp_rejection(std::string_view content) {
  return mesh_rejection("a.vtp", content);
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  return text.replace(text.find(what), what.size(), by);
}

/// How a file stores its arrays.
struct Storage {
  std::endian order = std::endian::little;
  std::size_t word_size = 4;
  bool packed = false;
  bool appended = false;
  bool raw = false;
};

template <class T>
void append(std::string& out, T value, std::endian order) {
  std::string bytes;
  append_little_endian(bytes, value);
  if (order == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  out += bytes;
}

/// Stores arrays by the rules of "VTK file formats", written without the library's own writer.
class Store {
 public:
  explicit Store(const Storage& storage) : s_(storage) {}

  /// A DataArray that holds these values.
  template <class T>
  std::string array(std::string_view type, std::string_view name, int components, const std::vector<T>& values) {
    std::string bytes;
    for (const T value : values) append(bytes, value, s_.order);
    const std::string stored = s_.packed ? packed(bytes) : unpacked(bytes);
    const std::string start = fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}")", type, name, components);
    if (!s_.appended) return start + " format=\"binary\">\n  " + stored + "\n</DataArray>\n";
    const std::size_t offset = appended_.size();
    appended_ += stored;
    return fmt::format("{} format=\"appended\" offset=\"{}\"/>\n", start, offset);
  }

  std::string document(const std::string& poly_data) const {
    const std::string appended =
        fmt::format("<AppendedData encoding=\"{}\">\n  _{}\n</AppendedData>\n", s_.raw ? "raw" : "base64", appended_);
    return fmt::format(
        "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"{}\" header_type=\"{}\"{}>\n<PolyData>\n{}</PolyData>\n{}</VTKFile>\n",
        s_.order == std::endian::big ? "BigEndian" : "LittleEndian", s_.word_size == 8 ? "UInt64" : "UInt32",
        s_.packed ? " compressor=\"vtkZLibDataCompressor\"" : "", poly_data, s_.appended ? appended : "");
  }

 private:
  void append_word(std::string& out, std::uint64_t value) const {
    if (s_.word_size == 8)
      append(out, value, s_.order);
    else
      append(out, static_cast<std::uint32_t>(value), s_.order);
  }
  std::string encoded(const std::string& bytes) const { return s_.raw ? bytes : encode_base64(bytes); }

  std::string unpacked(const std::string& bytes) const {
    std::string out;
    append_word(out, bytes.size());
    return encoded(out + bytes);
  }

  /// In blocks of 16 bytes; the header is encoded apart from the data.
  std::string packed(const std::string& bytes) const {
    constexpr std::size_t block = 16;
    std::string sizes;
    std::string data;
    for (std::size_t at = 0; at < bytes.size(); at += block) {
      const std::string piece = bytes.substr(at, block);
      std::string out(compressBound(piece.size()), '\0');
      uLongf size = out.size();
      compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
      append_word(sizes, size);
      data += out.substr(0, size);
    }
    std::string header;
    append_word(header, (bytes.size() + block - 1) / block);
    append_word(header, block);
    append_word(header, bytes.size() % block);
    return encoded(header + sizes) + encoded(data);
  }

  Storage s_;
  std::string appended_;
};

/// kMesh stored in one of VTK's ways.
std::string stored_mesh(const Storage& storage) {
  Store store(storage);
  std::string data = "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"2\">\n<PointData>\n";
  data += store.array<std::uint8_t>("UInt8", "</AppendedData", 1, {'<', '/', '_'}) + "</PointData>\n<Points>\n";
  data += store.array<double>("Float64", "Points", 3, {0, 0, 0.5, 1, 0, 0, 0, 1, 0}) + "</Points>\n<Polys>\n";
  data += store.array<std::int32_t>("Int32", "connectivity", 1, {0, 1, 2, 0, 2, 1});
  data += store.array<std::int64_t>("Int64", "offsets", 1, {3, 6}) + "</Polys>\n</Piece>\n";
  return store.document(data);
}

TEST(Vtp, IsReadFromText) {
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.vtp", kText), kMesh));
}

TEST(Vtp, IsReadHoweverVtkStoresIt) {
  for (const std::endian order : {std::endian::little, std::endian::big})
    for (const std::size_t word_size : {4U, 8U})
      for (const bool packed : {false, true})
        for (const Storage& s : {Storage{order, word_size, packed, false, false}, Storage{order, word_size, packed, true, false},
                                 Storage{order, word_size, packed, true, true}})
          EXPECT_TRUE(is_bitwise_equal(mesh_in("a.vtp", stored_mesh(s)), kMesh))
              << "big endian " << (order == std::endian::big) << ", word " << word_size << ", packed " << packed << ", appended "
              << s.appended << ", raw " << s.raw;
}

TEST(Vtp, PiecesAreJoined) {
  const std::size_t begin = kText.find("    <Piece");
  const std::size_t end = kText.find("  </PolyData>");
  EXPECT_TRUE(is_bitwise_equal(mesh_in("a.vtp", kText.substr(0, end) + kText.substr(begin)), joined(kMesh, kMesh)));
}

TEST(Vtp, WritesWhatTheRulesSay) {
  const std::string ours = format_vtp(kMesh, {});
  Store store({.word_size = 8});
  const std::string points = store.array<double>("Float64", "Points", 3, {0, 0, 0.5, 1, 0, 0, 0, 1, 0});
  const std::size_t data = points.find("AAAA");
  EXPECT_THAT(ours, HasSubstr(points.substr(data, points.find("\n</") - data)));
  EXPECT_THAT(format_vtp({{{2.0 / 3, 1, 0}}, {}}, {.digits = 3}), HasSubstr("0.667 1 0\n"));
}

TEST(Vtp, RejectsAWrongHeader) {
  EXPECT_EQ(vtp_rejection("OFF\n"), "a.vtp:1: not an XML file: it does not begin with <");
  EXPECT_EQ(vtp_rejection("<html></html>"), "a.vtp:1: not a VTK PolyData file: <html type=\"\">");
  EXPECT_EQ(vtp_rejection(replaced(kText, "type=\"PolyData\"", "type=\"UnstructuredGrid\"")),
            "a.vtp:1: not a VTK PolyData file: <VTKFile type=\"UnstructuredGrid\">");
  EXPECT_EQ(vtp_rejection(replaced(kText, "LittleEndian", "MiddleEndian")),
            "a.vtp:2: VTKFile: byte_order \"MiddleEndian\" is not LittleEndian or BigEndian");
  EXPECT_EQ(vtp_rejection(replaced(kText, "header_type=\"UInt64\"", "compressor=\"vtkLZ4DataCompressor\"")),
            "a.vtp:2: VTKFile: compressor \"vtkLZ4DataCompressor\" is not supported");
}

TEST(Vtp, RejectsATruncatedFile) {
  EXPECT_EQ(vtp_rejection(kText.substr(0, kText.find("</Polys>"))), "a.vtp:37: the file ends before </Polys>");
  const std::string base64 = format_vtp(tetrahedron(), {});
  const std::size_t data = base64.find("format=\"binary\">\n") + 17;
  EXPECT_THAT(vtp_rejection(base64.substr(0, data + 40) + base64.substr(base64.find("\n</DataArray>"))),
              HasSubstr("a.vtp:6: DataArray Points: its data are truncated: 22 of 96 bytes"));
  EXPECT_THAT(vtp_rejection(replaced(base64, "AAAA", "AA*A")), HasSubstr("a.vtp:6: DataArray Points: its data are not base64"));
}

TEST(Vtp, RejectsCountsThatDoNotMatch) {
  EXPECT_EQ(vtp_rejection(replaced(kText, "NumberOfPoints=\"3\"", "NumberOfPoints=\"4\"")),
            "a.vtp:14: DataArray Points: 9 values, but NumberOfPoints is 4, which takes 12");
  EXPECT_EQ(vtp_rejection(replaced(kText, "NumberOfPoints=\"3\"", "NumberOfPoints=\"2\"")),
            "a.vtp:14: DataArray Points: 9 values, but NumberOfPoints is 2, which takes 6");
  EXPECT_EQ(vtp_rejection(replaced(kText, "NumberOfPolys=\"2\"", "NumberOfPolys=\"1\"")),
            "a.vtp:34: DataArray offsets: 2 values, but NumberOfPolys is 1");
  EXPECT_EQ(vtp_rejection(replaced(kText, "0 1 2 0 2 1", "0 1 2 0 2")),
            "a.vtp:31: DataArray connectivity: 5 values, but NumberOfPolys is 2, which takes 6");
  EXPECT_EQ(vtp_rejection(kText + "junk"), "a.vtp:41: something follows the root element");
}

TEST(Vtp, RejectsAbsurdCountsBeforeItAllocates) {
  EXPECT_THAT(vtp_rejection(replaced(kText, "NumberOfPoints=\"3\"", "NumberOfPoints=\"1000000000000\"")),
              HasSubstr("expected 0 to 4294967294"));
  EXPECT_THAT(vtp_rejection(replaced(kText, "NumberOfPoints=\"3\"", "NumberOfPoints=\"-3\"")), HasSubstr("NumberOfPoints is -3"));
  EXPECT_THAT(vtp_rejection(replaced(kText, "NumberOfPoints=\"3\"", "NumberOfPoints=\"4000000000\"")), HasSubstr("9 values, but"));
  std::string header;
  for (const std::uint32_t word : {1000000000U, 4000000000U, 0U, 1U}) append_little_endian(header, word);
  const std::string packed = stored_mesh({.packed = true});
  const std::size_t data = packed.find("  ", packed.find("Points\" NumberOfComponents")) + 2;
  EXPECT_THAT(vtp_rejection(packed.substr(0, data) + encode_base64(header) + packed.substr(packed.find("\n</DataArray>", data))),
              HasSubstr("DataArray Points: its data are truncated"));
}

TEST(Vtp, RejectsAnIndexOutOfRange) {
  const std::string message =
      "a.vtp:31: DataArray connectivity: face 1: vertex index {} is out of range, there are 3 vertices, counted from 0";
  EXPECT_EQ(vtp_rejection(replaced(kText, "0 1 2 0 2 1", "0 1 2 0 3 1")), fmt::format(fmt::runtime(message), 3));
  EXPECT_EQ(vtp_rejection(replaced(kText, "0 1 2 0 2 1", "0 1 2 0 -1 1")), fmt::format(fmt::runtime(message), -1));
}

TEST(Vtp, RejectsAFaceOfFourVertices) {
  EXPECT_EQ(vtp_rejection(replaced(kText, "3 6\n", "3 7\n")), "a.vtp:34: DataArray offsets: face 1 has 4 vertices, expected 3");
}

TEST(Vtp, RejectsTriangleStrips) {
  EXPECT_EQ(vtp_rejection(replaced(kText, "NumberOfStrips=\"0\"", "NumberOfStrips=\"1\"")),
            "a.vtp:4: Piece: triangle strips are not supported");
}

TEST(Vtp, RejectsWhatIsNoNumber) {
  EXPECT_EQ(vtp_rejection(replaced(kText, "0 0 0.5 1 0 0", "0 0 half 1 0 0")),
            "a.vtp:14: DataArray Points: value 2 is \"half\", expected a number");
}

TEST(Vtp, RejectsBrokenXml) {
  EXPECT_EQ(vtp_rejection(replaced(kText, "</Piece>", "</Peace>")), "a.vtp:38: </Peace> where </Piece> is expected");
  EXPECT_EQ(vtp_rejection("<VTKFile type=\"PolyData>"), "a.vtp:1: the value's closing quote is missing");
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_EQ(vtp_rejection(deep), "a.vtp:1: more than 32 elements inside one another");
}

// RFC 4648, section 10.
TEST(Base64, AgreesWithThePublishedExamples) {
  const std::vector<std::pair<std::string, std::string>> examples = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : examples) {
    EXPECT_EQ(encode_base64(bytes), text);
    EXPECT_EQ(decode_base64(text), bytes);
  }
  EXPECT_EQ(decode_base64("Zm8=\n Zm9v"), "fofoo");
  for (const char* wrong : {"Z", "Zg=", "Z===", "=", "Zg=g", "Zm9v!"}) EXPECT_EQ(decode_base64(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace smopt::testing
