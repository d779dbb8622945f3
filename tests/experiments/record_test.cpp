#include "experiments/record.h"

#include <gmock/gmock.h>

#include "experiments/run_report.h"
#include "tests/experiments/made_records.h"

namespace smopt::experiments {
namespace {

TEST(Record, IsFailedUntilItIsMarkedDone) {
  Json record = record_header(testing::ache_monomer(), "smopt");
  EXPECT_EQ(record.at("status"), "failed");
  mark_done(record);
  EXPECT_EQ(record.at("status"), "done");
  EXPECT_TRUE(record.at("reason").is_null());
}

TEST(Record, SaysWhatMadeIt) {
  const Json record = record_header(testing::ache_monomer(), "smopt");
  EXPECT_EQ(record.at("schema_version"), kRecordSchema);
  EXPECT_EQ(record.at("molecule").at("role"), "real");
  EXPECT_EQ(record.at("method_title"), "SMOPT");
  EXPECT_FALSE(record.at("version").get<std::string>().empty());
  EXPECT_FALSE(record.at("compiler").get<std::string>().empty());
  EXPECT_GE(record.at("machine").at("cores").get<int>(), 1);
}

TEST(Record, KeepsEveryRepeatAndTellsTheMedian) {
  Json record = record_header(testing::ache_monomer(), "smopt");
  testing::set_cpu_seconds(record, {{.smoothing = 5}, {.smoothing = 1}, {.smoothing = 2}});
  ASSERT_EQ(record.at("repeats").size(), 3U);
  EXPECT_EQ(record.at("repeats").at(0).at("cpu_seconds").at("smoothing"), 5.0);
  EXPECT_EQ(record.at("repeats").at(1).at("cpu_seconds").at("smoothing"), 1.0);
  EXPECT_EQ(record.at("cpu_seconds").at("smoothing"), 2.0);
}

TEST(Record, TheMedianOfAnEvenNumberIsTheMeanOfTheMiddleTwo) {
  EXPECT_EQ(median({9, 1, 3, 4}), 3.5);
  EXPECT_EQ(median({2}), 2);
}

}  // namespace
}  // namespace smopt::experiments
