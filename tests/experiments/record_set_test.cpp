#include "experiments/record_set.h"
#include "experiments/run_layout.h"

#include <gmock/gmock.h>

#include <fstream>

#include "experiments/record.h"
#include "smopt/error.h"
#include "tests/experiments/made_records.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using smopt::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Optional;
using ::testing::ThrowsMessage;

void save(const TemporaryFolder& folder, const Json& record) {
  const auto path = record_path(folder.path(), record.at("molecule").at("name").get<std::string>(), record.at("method").get<std::string>());
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << record.dump();
}

TEST(RecordSet, ReadsWhatIsThereInTheOrderOfTheListsOfMoleculesAndMethods) {
  const TemporaryFolder folder;
  for (const char* molecule : {"aaa", "1a63", "connexin_2zw3", "ache-monomer"})
    for (const char* method : {"my-method", "laplacian", "initial", "hc", "smopt"})
      save(folder, testing::made_record(testing::made_dataset(molecule), method));
  const RecordSet records = RecordSet::load(folder.path());
  EXPECT_THAT(records.molecules(), ElementsAre("ache-monomer", "connexin_2zw3", "1a63", "aaa"));
  EXPECT_THAT(records.methods(), ElementsAre("initial", "smopt", "laplacian", "hc", "my-method"));
  EXPECT_THAT(paper_methods(records), ElementsAre("initial", "smopt", "laplacian"));
  EXPECT_NE(records.find("aaa", "hc"), nullptr);
  EXPECT_EQ(records.find("aaa", "taubin"), nullptr);
  EXPECT_EQ(records.find("bbb", "hc"), nullptr);
}

TEST(RecordSet, ACaseIsCalledAsItsRecordsSay) {
  RecordSet records;
  MethodCase changed = find_method_case("smopt");
  changed.title = "SMOPT (guard=none)";
  records.add(record_header(testing::made_dataset("a"), changed), "a");
  EXPECT_EQ(method_title(records, "smopt"), "SMOPT (guard=none)");
  EXPECT_EQ(method_title(records, "laplacian"), find_method_case("laplacian").title);
}

TEST(RecordSet, AFolderWithoutRecordsIsSaidToBeOne) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { RecordSet::load(folder.path()); }, ThrowsMessage<InvalidInput>(HasSubstr("no records")));
}

TEST(RecordSet, NamesTheFileThatIsNoRecord) {
  const TemporaryFolder folder;
  save(folder, testing::made_record(testing::made_dataset("m"), "smopt"));
  const auto file = record_path(folder.path(), "m", "broken");
  for (const auto& [content, what] : {std::pair("{\"half\": ", "not JSON"), std::pair("[1, 2]", "not the record of a case"),
                                      std::pair("{\"schema_version\": 1}", "not the record of a case")}) {
    std::ofstream(file) << content;
    EXPECT_THAT([&] { RecordSet::load(folder.path()); },
                ThrowsMessage<InvalidInput>(::testing::AllOf(HasSubstr("broken.json"), HasSubstr(what))));
  }
}

TEST(RecordSet, RefusesRecordsOfAnotherSchema) {
  Json record = testing::made_record(testing::made_dataset("m"), "smopt");
  record["schema_version"] = kRecordSchema + 1;
  RecordSet records;
  EXPECT_THAT([&] { records.add(record, "m.json"); }, ThrowsMessage<InvalidInput>(HasSubstr("schema")));
}

TEST(RecordSet, AValueThatIsNotThereIsNothing) {
  const Json record = testing::made_record(testing::made_dataset("m"), "smopt");
  EXPECT_THAT(number_at(&record, "/metrics/after/area"), Optional(290.0));
  EXPECT_THAT(text_at(&record, "/tetgen/p/reason"), Optional<std::string>("too sharp"));
  EXPECT_FALSE(number_at(&record, "/metrics/after/genus"));
  EXPECT_FALSE(number_at(&record, "/status"));
  EXPECT_FALSE(text_at(&record, "/tetgen/pY/reason"));
  EXPECT_FALSE(number_at(nullptr, "/metrics/after/area"));
}

}  // namespace
}  // namespace smopt::experiments
