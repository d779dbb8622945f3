#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/cli/smopt_program.h"
#include "tests/support/shapes.h"

namespace smopt::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

/// The commands that the program's own help lists.
std::vector<std::string> listed_commands() {
  const std::string help = run_smopt({"--help"}).out;
  const std::string list = help.substr(std::min(help.size(), help.find("Subcommands:")));
  static const std::regex kLine(R"(\n  ([a-z]+) )");
  std::vector<std::string> commands;
  for (auto it = std::sregex_iterator(list.begin(), list.end(), kLine); it != std::sregex_iterator(); ++it) commands.push_back((*it)[1]);
  return commands;
}

TEST(Usage, HelpListsTheCommands) {
  const std::vector<std::string> commands = listed_commands();
  for (const char* command : {"generate", "improve", "methods", "measure", "tetrahedralize", "solvate", "convert"})
    EXPECT_THAT(commands, Contains(command));
}

TEST(Usage, HelpOfEveryCommandShowsAnExample) {
  for (const std::string& command : listed_commands()) {
    const ProgramResult r = run_smopt({command, "--help"});
    EXPECT_EQ(r.exit_code, 0) << command;
    EXPECT_THAT(r.out, HasSubstr("Example")) << command;
    EXPECT_THAT(r.out, HasSubstr("smopt " + command)) << command;
    EXPECT_THAT(r.err, IsEmpty()) << command;
  }
}

TEST(Usage, HelpOfImproveShowsTheOptionsOfTheMethodAskedFor) {
  EXPECT_THAT(run_smopt({"improve", "--help"}).out, HasSubstr("--rounds-per-screening"));
  EXPECT_THAT(run_smopt({"improve", "--method", "laplacian", "--help"}).out, HasSubstr("--beta"));
  EXPECT_THAT(run_smopt({"improve", "--method=laplacian", "--help"}).out, HasSubstr("--beta"));
}

TEST(Usage, VersionIsPrintedOnStandardOutput) {
  const ProgramResult r = run_smopt({"--version"});
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_THAT(r.out, MatchesRegex("smopt [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Usage, MethodsListsEveryMethodWithItsDefaults) {
  const ProgramResult r = run_smopt({"methods", "--json"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const auto methods = nlohmann::json::parse(r.out);
  ASSERT_GE(methods.size(), 3U);
  EXPECT_EQ(methods[0]["name"], "smopt");
  EXPECT_EQ(methods[1]["name"], "smopt2");
  EXPECT_EQ(methods[2]["name"], "laplacian");
  const std::string table = run_smopt({"methods"}).out;
  for (const auto& method : methods) {
    EXPECT_THAT(table, HasSubstr(method["name"].get<std::string>()));
    EXPECT_FALSE(method["source"].get<std::string>().empty()) << method["name"];
    for (const auto& option : method["options"]) {
      EXPECT_THAT(table, HasSubstr("--" + option["name"].get<std::string>())) << method["name"];
      EXPECT_FALSE(option["help"].get<std::string>().empty()) << option["name"];
    }
  }
}

/// Arguments that no run can be meant by, and a word that the complaint must have. `@` stands for the test's folder.
struct WrongUsage {
  std::string name;
  std::vector<std::string> arguments;
  std::string complaint;
};

void PrintTo(const WrongUsage& usage, std::ostream* out) {
  *out << usage.name;
}

class Wrong : public ::testing::TestWithParam<WrongUsage> {};

TEST_P(Wrong, ExitsWith2SaysWhyAndWritesNothing) {
  const TemporaryFolder folder;
  put_mesh(folder, "in.off", icosphere(1));
  std::vector<std::string> arguments = GetParam().arguments;
  for (std::string& argument : arguments)
    if (argument.starts_with("@/")) argument = path_in(folder, argument.substr(2));
  const ProgramResult r = run_smopt(arguments);
  EXPECT_EQ(r.exit_code, 2) << r.err;
  EXPECT_THAT(r.err, HasSubstr(GetParam().complaint));
  EXPECT_THAT(r.out, IsEmpty());
  EXPECT_THAT(files_in(folder), ::testing::ElementsAre("in.off"));
}

INSTANTIATE_TEST_SUITE_P(
    Usage, Wrong,
    ::testing::Values(WrongUsage{"NoCommand", {}, "subcommand"}, WrongUsage{"UnknownCommand", {"enlarge"}, "enlarge"},
                      WrongUsage{"UnknownOption", {"measure", "@/in.off", "--colour"}, "--colour"},
                      WrongUsage{"NoMesh", {"measure"}, "meshes"}, WrongUsage{"NoOutput", {"improve", "@/in.off"}, "--output"},
                      WrongUsage{"NoThreads", {"measure", "@/in.off", "--threads", "0"}, "--threads"},
                      WrongUsage{"UnknownMethod", {"improve", "@/in.off", "-o", "@/out.off", "--method", "magic"}, "magic"},
                      WrongUsage{"OptionOfAnotherMethod", {"improve", "@/in.off", "-o", "@/out.off", "--beta", "1"}, "--beta"},
                      WrongUsage{"RoundsThatAreNoNumber", {"improve", "@/in.off", "-o", "@/out.off", "--rounds", "many"}, "--rounds"},
                      WrongUsage{"NegativeRounds", {"improve", "@/in.off", "-o", "@/out.off", "--rounds", "-1"}, "--rounds"},
                      WrongUsage{"HalfARound", {"improve", "@/in.off", "-o", "@/out.off", "--rounds", "1.5"}, "--rounds"},
                      WrongUsage{"AnAngleThatIsNoNumber", {"improve", "@/in.off", "-o", "@/out.off", "--min-angle", "nan"}, "--min-angle"},
                      WrongUsage{"ARatioAboveOne", {"improve", "@/in.off", "-o", "@/out.off", "--edge-ratio", "2"}, "edge-ratio"},
                      WrongUsage{"AnAngleNoTriangleCanHave", {"improve", "@/in.off", "-o", "@/out.off", "--min-angle", "61"}, "min-angle"},
                      WrongUsage{"UnknownStep", {"improve", "@/in.off", "-o", "@/out.off", "--step", "leap"}, "leap"},
                      WrongUsage{"UnknownCavityPolicy", {"improve", "@/in.off", "-o", "@/out.off", "--cavities", "fill"}, "fill"},
                      WrongUsage{"BadTolerance", {"improve", "@/in.off", "-o", "@/out.off", "--tolerance", "1e-4abs"}, "--tolerance"},
                      WrongUsage{"NoDigits", {"improve", "@/in.off", "-o", "@/out.off", "--digits", "0"}, "--digits"},
                      WrongUsage{"TooManyDigits", {"convert", "@/in.off", "@/out.off", "--digits", "18"}, "--digits"},
                      WrongUsage{"TwoThingsOnStandardOutput", {"improve", "@/in.off", "-o", "-", "--json"}, "standard output"},
                      WrongUsage{"UnwritableFormatOfImprove", {"improve", "@/in.off", "-o", "@/out.docx"}, "out.docx"},
                      WrongUsage{"UnwritableFormatOfConvert", {"convert", "@/in.off", "@/out.docx"}, "out.docx"},
                      WrongUsage{"UnwritableFormatOfGenerate", {"generate", "@/in.pqr", "-o", "@/out.docx"}, "out.docx"},
                      WrongUsage{"UnwritableFormatOfTetrahedralize", {"tetrahedralize", "@/in.off", "-o", "@/out.off"}, "out.off"},
                      WrongUsage{"SwitchesWithoutP", {"tetrahedralize", "@/in.off", "-o", "@/out.vtu", "--switches", "q"}, "'q'"},
                      WrongUsage{"SwitchesThatReadFiles", {"tetrahedralize", "@/in.off", "-o", "@/out.vtu", "--switches", "pr"}, "'r'"},
                      WrongUsage{"NoTime", {"tetrahedralize", "@/in.off", "-o", "@/out.vtu", "--time-limit", "0"}, "time"},
                      WrongUsage{
                          "NegativeMemory", {"tetrahedralize", "@/in.off", "-o", "@/out.vtu", "--max-memory", "-1"}, "--max-memory"}),
    [](const auto& param) { return param.param.name; });

TEST(Usage, GenerateRefusesSurfacesThatDoNotExist) {
  const TemporaryFolder folder;
  const std::string molecule = folder.file("ion.pqr", "ATOM 1 NA NA 1 0.0 0.0 0.0 1.0 2.0\n").string();
  for (const char* option : {"--decay", "--isovalue", "--spacing"}) {
    for (const char* value : {"0", "-1", "nan", "inf", "much"}) {
      const ProgramResult r = run_smopt({"generate", molecule, "-o", path_in(folder, "out.off"), option, value});
      EXPECT_EQ(r.exit_code, 2) << option << " " << value << ": " << r.err;
      EXPECT_THAT(r.err, HasSubstr(std::string(option).substr(2))) << value;
    }
  }
  EXPECT_THAT(files_in(folder), ::testing::ElementsAre("ion.pqr"));
}

TEST(Usage, AFullStandardOutputIsAnError) {
  const TemporaryFolder folder;
  const std::string mesh = put_mesh(folder, "in.off", icosphere(1));
  const std::string program = smopt_program().string();
  for (const std::string& arguments : {"measure " + mesh, "measure --json " + mesh, std::string("methods"), "convert " + mesh + " -"}) {
    const ProgramResult r = run_program("/bin/sh", {"-c", program + " " + arguments + " > /dev/full"});
    EXPECT_EQ(r.exit_code, 3) << arguments;
    EXPECT_THAT(r.err, HasSubstr("No space left on device")) << arguments;
  }
}

}  // namespace
}  // namespace smopt::testing
