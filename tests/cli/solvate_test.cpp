#include <fmt/format.h>
#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>

#include "metrics/solvation/dielectric_model.h"
#include "smopt/io/bytes.h"
#include "smopt/io/mesh_io.h"
#include "tests/cli/smopt_program.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr double kRadius = 2;
constexpr double kCharge = 1;
const metrics::DielectricModel kMedium;

/// An ion in the middle of a sphere of 2562 vertices.
class Solvate : public ::testing::Test {
 protected:
  [[nodiscard]] ProgramResult solvate(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"solvate", mesh, ion};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_smopt(arguments);
  }
  /// What files there are in the folder besides the two above.
  [[nodiscard]] std::vector<std::string> new_files() const {
    std::vector<std::string> files = files_in(folder);
    std::erase(files, "ion.off");
    std::erase(files, "ion.pqr");
    return files;
  }

  TemporaryFolder folder;
  std::string mesh = put_mesh(folder, "ion.off", icosphere(4, kRadius));
  std::string ion = folder.file("ion.pqr", fmt::format("ATOM 1 NA NA 1 0.0 0.0 0.0 {} {}\n", kCharge, kRadius)).string();
};

/// Born's energy of an ion in an electrolyte, kcal/mol.
double born_energy(const metrics::DielectricModel& medium) {
  const double outside = 1 / (medium.outer * (1 + medium.kappa() * kRadius));
  return metrics::kCoulombConstant * kCharge * kCharge / (2 * kRadius) * (outside - 1 / medium.inner);
}

double relative_error(double value, double truth) {
  return std::abs(value / truth - 1);
}

/// Discretisation allows that much at 2562 vertices; a wrong unit or factor is far beyond.
constexpr double kTolerance = 0.02;

TEST_F(Solvate, AnIonHasBornsEnergy) {
  const ProgramResult r = solvate({"--json"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const json answer = json::parse(r.out);
  EXPECT_EQ(answer["status"], "success");
  EXPECT_LT(relative_error(answer["polar_kcal_per_mol"], born_energy(kMedium)), kTolerance) << r.out;
  EXPECT_EQ(answer["charges_outside"], 0);
  EXPECT_EQ(answer["degenerate_vertices"], 0);
  EXPECT_THAT(new_files(), IsEmpty());
}

TEST_F(Solvate, TheMediumIsWhatTheOptionsSay) {
  const metrics::DielectricModel medium = {.inner = 4, .outer = 10, .ionic_strength = 0, .temperature = 280};
  const ProgramResult r = solvate({"--json", "--inner", "4", "--outer", "10", "--ionic-strength", "0", "--temperature", "280", "--direct"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_LT(relative_error(json::parse(r.out)["polar_kcal_per_mol"], born_energy(medium)), kTolerance) << r.out;
}

TEST_F(Solvate, TheNonpolarPartIsOfAreaAndVolume) {
  const json answer = json::parse(solvate({"--json", "--surface-tension", "2", "--pressure", "3"}).out);
  const double area = answer["area"], volume = answer["volume"];
  EXPECT_LT(relative_error(area, 16 * std::acos(-1.0)), 0.01);
  EXPECT_LT(relative_error(volume, 32 * std::acos(-1.0) / 3), 0.01);
  EXPECT_NEAR(answer["nonpolar_kcal_per_mol"].get<double>(), 2 * area + 3 * volume, 1e-9 * area);
  EXPECT_NEAR(answer["total_kcal_per_mol"].get<double>(),
              answer["polar_kcal_per_mol"].get<double>() + answer["nonpolar_kcal_per_mol"].get<double>(), 1e-9 * area);
}

TEST_F(Solvate, JsonHasTheKeysOfTheContract) {
  const json contract = json::parse(R"({"status": "", "reason": null, "polar_kcal_per_mol": 0.0, "nonpolar_kcal_per_mol": 0.0,
    "total_kcal_per_mol": 0.0, "iterations": 0, "relative_residual": 0.0, "degenerate_vertices": 0, "degenerate_vertex_ids": [],
    "charges_outside": 0, "area": 0.0, "volume": 0.0, "seconds": 0.0, "predicted_memory_mb": 0.0})");
  for (const std::string limit : {"1", "100"}) {
    const ProgramResult r = solvate({"--json", "--max-iterations", limit});
    EXPECT_EQ(why_not_shaped_like(contract, json::parse(r.out)), "");
  }
}

TEST_F(Solvate, PrintsWhatItFound) {
  const ProgramResult r = solvate();
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_THAT(r.out, AllOf(StartsWith("success\n"), ContainsRegex("polar +-[0-9.]+ kcal/mol"), ContainsRegex("nonpolar +[0-9.]+ kcal/mol"),
                           ContainsRegex("total +-[0-9.]+ kcal/mol"), ContainsRegex("charges outside +0 of 1\n")));
}

/// The doubles at the vertices of a PLY file that the program wrote: a row of position, potential and derivative for each.
std::vector<double> vertex_rows(const std::string& ply, std::size_t vertices) {
  const std::size_t body = ply.find("end_header\n") + 11;
  std::vector<double> rows(5 * vertices);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = load<double>(ply.data() + body + 8 * i, std::endian::little);
  return rows;
}

TEST_F(Solvate, WritesThePotentialInUnitsOfKt) {
  const std::string output = path_in(folder, "potential.ply");
  const ProgramResult r = solvate({"-o", output});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const std::string ply = bytes_of(output);
  EXPECT_THAT(ply, HasSubstr("property double potential_kT_per_e\nproperty double normal_derivative_kT_per_e_A\nelement face"));
  const TriangleMesh given = read_mesh(mesh);
  const std::vector<double> rows = vertex_rows(ply, given.vertex_count());
  const double unit = metrics::kCoulombConstant * kCharge / kMedium.thermal_energy();
  const double potential = unit / (kMedium.outer * kRadius * (1 + kMedium.kappa() * kRadius));
  const double derivative = -unit / (kMedium.inner * kRadius * kRadius);
  double mean_potential = 0, mean_derivative = 0;
  for (std::size_t v = 0; v < given.vertex_count(); ++v) {
    EXPECT_EQ(rows[5 * v], given.points[v].x());
    EXPECT_LT(relative_error(rows[5 * v + 3], potential), 5 * kTolerance) << "vertex " << v;
    EXPECT_LT(relative_error(rows[5 * v + 4], derivative), 5 * kTolerance) << "vertex " << v;
    mean_potential += rows[5 * v + 3] / static_cast<double>(given.vertex_count());
    mean_derivative += rows[5 * v + 4] / static_cast<double>(given.vertex_count());
  }
  EXPECT_LT(relative_error(mean_potential, potential), kTolerance);
  EXPECT_LT(relative_error(mean_derivative, derivative), kTolerance);
}

TEST_F(Solvate, WritesVtpWithThePotentialActive) {
  const std::string output = path_in(folder, "potential.vtp");
  ASSERT_EQ(solvate({"-o", output}).exit_code, 0);
  EXPECT_THAT(bytes_of(output), AllOf(HasSubstr("<PointData Scalars=\"potential_kT_per_e\">"), HasSubstr("normal_derivative_kT_per_e_A")));
  EXPECT_EQ(read_mesh(output).triangles, read_mesh(mesh).triangles);
}

TEST_F(Solvate, TooFewIterationsExitWith1AndTheReason) {
  const ProgramResult r = solvate({"--max-iterations", "1", "--residual", "1e-12", "-o", path_in(folder, "potential.vtp")});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_THAT(r.out, ContainsRegex("^not_converged: .+\n"));
  EXPECT_THAT(new_files(), ElementsAre("potential.vtp"));
}

TEST_F(Solvate, AMoleculeWithoutChargesExitsWith1AndSaysWhichFormatHasThem) {
  const std::string pdb = folder.file("a.pdb", "ATOM      1  CA  ALA A   1       0.000   0.000   0.000  1.00  0.00           C\n").string();
  const std::string xyzr = folder.file("a.xyzr", "0 0 0 1.5\n").string();
  for (const std::string& molecule : {pdb, xyzr}) {
    const ProgramResult r = run_smopt({"solvate", mesh, molecule, "-o", path_in(folder, "out.vtp")});
    EXPECT_EQ(r.exit_code, 1) << r.err;
    EXPECT_THAT(r.out, AllOf(StartsWith("no_charges: "), HasSubstr("PQR")));
    const json answer = json::parse(run_smopt({"solvate", mesh, molecule, "--json", "--quiet"}).out);
    EXPECT_EQ(answer["status"], "no_charges");
    EXPECT_EQ(answer["polar_kcal_per_mol"], 0.0);
    EXPECT_GT(answer["nonpolar_kcal_per_mol"], 0.0);
    EXPECT_THAT(answer["reason"].get<std::string>(), HasSubstr("PQR"));
  }
  EXPECT_THAT(new_files(), ElementsAre("a.pdb", "a.xyzr"));
  const std::string zero = folder.file("zero.pqr", "ATOM 1 NA NA 1 0.0 0.0 0.0 0.0 2.0\n").string();
  const ProgramResult r = run_smopt({"solvate", mesh, zero});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_THAT(r.out, AllOf(StartsWith("no_charges: "), ::testing::Not(HasSubstr("PQR files do"))));
}

TEST_F(Solvate, ChargesOutsideAreCounted) {
  const std::string two = folder.file("two.pqr", "ATOM 1 A A 1 0.0 0.0 0.0 1.0 2.0\nATOM 2 B B 1 9.0 0.0 0.0 -1.0 2.0\n").string();
  const ProgramResult r = run_smopt({"solvate", mesh, two});
  EXPECT_THAT(r.out, ContainsRegex("charges outside +1 of 2\n"));
}

TEST_F(Solvate, DegenerateVerticesAreNamed) {
  TriangleMesh flat = icosphere(3, kRadius);
  const auto [a, b, c] = flat.triangles.front();
  const auto on_edge = static_cast<VertexId>(flat.points.size());  // a triangle divided at a point on top of its first corner, twice over
  for (int i = 0; i < 2; ++i) flat.points.push_back(flat.points[a]);
  flat.triangles.front() = {a, b, on_edge};
  flat.triangles.insert(flat.triangles.end(),
                        {{on_edge, b, on_edge + 1}, {on_edge + 1, b, c}, {on_edge + 1, c, a}, {a, on_edge, on_edge + 1}});
  const ProgramResult r = run_smopt({"solvate", put_mesh(folder, "flat.off", flat), ion, "--json"});
  const json answer = json::parse(r.out);
  EXPECT_EQ(answer["degenerate_vertices"], 1);
  EXPECT_EQ(answer["degenerate_vertex_ids"], json::array({on_edge}));
}

TEST_F(Solvate, AMeshThatIsNoClosedSurfaceExitsWith3AndWritesNothing) {
  TriangleMesh open = icosphere(1);
  open.triangles.pop_back();
  TriangleMesh not_finite = icosphere(1);
  not_finite.points[17].y() = std::numeric_limits<double>::quiet_NaN();
  TriangleMesh twice = icosphere(1);
  twice.triangles.push_back(twice.triangles[5]);
  for (const TriangleMesh& bad : {open, not_finite, twice, TriangleMesh{{{0, 0, 0}}, {}}}) {
    const std::string file = put_mesh(folder, "bad.off", bad);
    const ProgramResult r = run_smopt({"solvate", file, ion, "-o", path_in(folder, "out.vtp"), "--json"});
    EXPECT_EQ(r.exit_code, 3) << r.err;
    EXPECT_THAT(r.err, HasSubstr(file));
    EXPECT_THAT(r.out, IsEmpty());
    EXPECT_THAT(new_files(), ElementsAre("bad.off"));
  }
}

TEST_F(Solvate, ABadMoleculeIsNamed) {
  const std::string bad = folder.file("bad.pqr", "ATOM 1 N ALA 1 0.0 zero 0.0 1.0 2.0\n").string();
  for (const auto& [file, place] : {std::tuple(bad, "bad.pqr:1: "), std::tuple(path_in(folder, "no.pqr"), "no.pqr: No such file")}) {
    const ProgramResult r = run_smopt({"solvate", mesh, file, "-o", path_in(folder, "out.vtp")});
    EXPECT_EQ(r.exit_code, 3) << r.out;
    EXPECT_THAT(r.err, HasSubstr(place));
  }
  EXPECT_THAT(new_files(), ElementsAre("bad.pqr"));
}

TEST_F(Solvate, AnOutputThatCannotBeWrittenIsNamedBeforeTheWork) {
  const std::string nowhere = path_in(folder, "no/such/folder/out.vtp");
  const ProgramResult unwritable = run_smopt({"solvate", path_in(folder, "missing.off"), ion, "-o", nowhere});
  EXPECT_EQ(unwritable.exit_code, 3);
  EXPECT_THAT(unwritable.err, HasSubstr(nowhere));
  for (const char* name : {"out.off", "-", "out.docx"}) {
    const ProgramResult format = solvate({"-o", name});
    EXPECT_EQ(format.exit_code, 2) << name;
    EXPECT_THAT(format.err, AllOf(HasSubstr(name), HasSubstr("vtp"))) << name;
  }
  EXPECT_THAT(new_files(), IsEmpty());
}

TEST_F(Solvate, OptionsOutOfRangeAreWrongUsage) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--inner", "0"},    {"--outer", "-80"}, {"--ionic-strength", "-1"}, {"--temperature", "0"},   {"--accuracy", "0.5"},
      {"--residual", "1"}, {"--restart", "0"}, {"--max-iterations", "0"},  {"--max-memory", "much"}, {"--inner", "nan"}};
  for (const auto& option : wrong) {
    const ProgramResult r = solvate(option);
    EXPECT_EQ(r.exit_code, 2) << option[0] << r.err;
    EXPECT_THAT(r.out, IsEmpty()) << option[0];
  }
  EXPECT_EQ(run_smopt({"solvate", "-", "-"}).exit_code, 2);
  EXPECT_EQ(run_smopt({"solvate", mesh}).exit_code, 2);
}

TEST_F(Solvate, WhatNeedsMoreMemoryThanAllowedIsRefusedWithTheEstimate) {
  const ProgramResult r = solvate({"--max-memory", "64KB"});
  EXPECT_EQ(r.exit_code, 3) << r.out;
  EXPECT_THAT(r.err, ContainsRegex("[0-9.]+ MB"));
}

TEST_F(Solvate, TheMeshOrTheMoleculeMayComeThroughAPipe) {
  const std::string expected = json::parse(solvate({"--json"}).out)["polar_kcal_per_mol"].dump();
  EXPECT_EQ(json::parse(run_smopt({"solvate", "-", ion, "--json"}, bytes_of(mesh)).out)["polar_kcal_per_mol"].dump(), expected);
  EXPECT_EQ(json::parse(run_smopt({"solvate", mesh, "-", "--json"}, bytes_of(ion)).out)["polar_kcal_per_mol"].dump(), expected);
}

TEST_F(Solvate, WritesTheSameBytesForAnyNumberOfThreads) {
  const std::string one = path_in(folder, "one.ply"), three = path_in(folder, "three.ply");
  ASSERT_EQ(solvate({"-o", one, "--threads", "1"}).exit_code, 0);
  ASSERT_EQ(solvate({"-o", three, "--threads", "3"}).exit_code, 0);
  EXPECT_TRUE(bytes_of(one) == bytes_of(three));
}

}  // namespace
}  // namespace smopt::testing
