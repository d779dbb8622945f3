#include "experiments/page/page_data.h"

#include <gmock/gmock.h>

#include <limits>

#include "experiments/tables/methods_table.h"
#include "tests/experiments/made_records.h"
#include "tests/experiments/page/made_run.h"

namespace smopt::experiments {
namespace {

using testing::ache_monomer;
using ::testing::ElementsAre;
using testing::made_dataset;
using testing::made_record;

TEST(PageData, HoldATableCellByCell) {
  const Table table = {
      "name", "Caption.", {{"a", "A"}, {"b", "B"}, {"c", "C"}, {"d", "D"}}, {{{}, "text", 7L, Decimal{1.25, 2}}}, {"A note."}};
  EXPECT_EQ(table_json(table).dump(),
            R"({"name":"name","caption":"Caption.","columns":[{"id":"a","title":"A"},{"id":"b","title":"B"},{"id":"c","title":"C"},)"
            R"({"id":"d","title":"D"}],"rows":[[null,"text",7,[1.25,2]]],"notes":["A note."]})");
}

TEST(PageData, HoldThePapersTablesAndThatOfTheMethods) {
  RecordSet records;
  records.add(made_record(ache_monomer(), "initial"), "test");
  records.add(made_record(ache_monomer(), "smopt"), "test");
  const Json data = page_data(records, "run");
  std::vector<std::string> names;
  for (const Json& table : data.at("tables")) names.push_back(table.at("name"));
  EXPECT_THAT(names, ElementsAre("table1", "table2", "table3", "methods"));
  EXPECT_EQ(data.at("tables")[3], table_json(methods_table(records)));
}

TEST(PageData, NameMoleculesAndMethodsInTheOrderOfTheTables) {
  RecordSet records;
  for (const auto& dataset : {made_dataset("zzz", Role::stand_in), ache_monomer()})
    for (const char* method : {"taubin", "smopt", "initial"}) records.add(made_record(dataset, method), "test");
  const Json data = page_data(records, "run");
  EXPECT_EQ(data.at("molecules")[0].at("title"), "AChE monomer");
  EXPECT_EQ(data.at("molecules")[1].at("title"), "The zzz (stand-in)");
  std::vector<std::string> methods;
  std::vector<bool> in_paper;
  for (const Json& method : data.at("methods")) {
    methods.push_back(method.at("name"));
    in_paper.push_back(method.at("in_paper"));
  }
  EXPECT_THAT(methods, ElementsAre("initial", "smopt", "taubin"));
  EXPECT_THAT(in_paper, ElementsAre(true, true, false));
}

TEST(PageData, OfACaseThatFailedTellItsReason) {
  RecordSet records;
  records.add(testing::failed_record(ache_monomer(), "smopt", testing::kMarkupReason), "test");
  const Json failed = page_data(records, "run").at("cases").at("ache-monomer").at("smopt");
  EXPECT_EQ(failed.at("status"), "failed");
  EXPECT_EQ(failed.at("reason"), testing::kMarkupReason);
}

TEST(PageData, HoldTheNumbersOfTheResultAndNoHistogramOfWhatWasGiven) {
  RecordSet records;
  const Json record = made_record(ache_monomer(), "smopt");
  records.add(record, "test");
  const Json metrics = page_data(records, "run").at("cases").at("ache-monomer").at("smopt").at("metrics");
  EXPECT_EQ(metrics.at("after"), record.at("metrics").at("after"));
  EXPECT_EQ(metrics.at("before").at("volume"), record.at("metrics").at("before").at("volume"));
  EXPECT_FALSE(metrics.at("before").at("angle_deg").contains("histogram"));
}

TEST(PageData, SayEachDifferentProvenanceOnce) {
  RecordSet records;
  Json first = made_record(ache_monomer(), "initial");
  Json second = made_record(ache_monomer(), "smopt");
  Json third = made_record(ache_monomer(), "hc");
  first["threads"] = 1;
  second["threads"] = 2;
  third["threads"] = 1;
  first["machine"] = {{"cpu", "Some CPU"}, {"cores", 2}, {"memory_mb", 24576}};
  second["machine"] = first["machine"];
  third["machine"] = nullptr;
  for (const Json& record : {first, second, third}) records.add(record, "test");
  const Json provenance = page_data(records, "run").at("provenance");
  EXPECT_EQ(provenance.at("threads").dump(), R"(["1","2"])");
  EXPECT_EQ(provenance.at("machine").dump(), R"(["Some CPU, 2 cores, 24 GiB"])");
  EXPECT_EQ(provenance.at("version").size(), 1U);
}

}  // namespace
}  // namespace smopt::experiments
