#include "experiments/page/page.h"

#include <gmock/gmock.h>

#include "experiments/page/page_data.h"
#include "experiments/page/page_template.h"
#include "smopt/error.h"
#include "tests/experiments/made_records.h"
#include "tests/experiments/page/made_run.h"
#include "tests/support/files.h"

namespace smopt::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using testing::TemporaryFolder;

constexpr std::string_view kTemplate = "<p>head</p><!--smopt:data--><script>program</script><!--smopt:meshes--></html>";

/// The data in a filled template, as a browser cuts them out: up to the first thing that ends a script element.
std::string data_text(const std::string& page) {
  const std::string opening = "id=\"report-data\">";
  const std::size_t begin = page.find(opening) + opening.size();
  return page.substr(begin, page.find("</script", begin) - begin);
}

TEST(Page, HoldsTheDataBeforeTheProgramAndTheMeshesAfterIt) {
  RunViews views;
  views.blobs = {"QUJD", "REVG"};
  views.molecules["m"] = {{"radius", nullptr}};
  const std::string page = fill_template(kTemplate, {{"name", "run"}}, views);
  EXPECT_EQ(
      page,
      "<p>head</p><script type=\"application/json\" id=\"report-data\">{\"name\":\"run\",\"views\":{\"m\":{\"radius\":null}}}</script>"
      "<script>program</script><script type=\"text/plain\" id=\"blob-0\">QUJD</script>\n"
      "<script type=\"text/plain\" id=\"blob-1\">REVG</script>\n</html>");
}

TEST(Page, KeepsWhatLooksLikeMarkupInsideItsData) {
  for (const std::string text : {testing::kMarkupReason, "</script>", "<!--<script>", "</SCRIPT >", "\\u003c \\ \" \u2028"}) {
    const std::string page = fill_template(kTemplate, {{"reason", text}}, {});
    const Json data = Json::parse(data_text(page));
    EXPECT_EQ(data.at("reason"), text);
    EXPECT_THAT(data_text(page), Not(HasSubstr("<")));
  }
}

TEST(Page, TakesMessagesThatAreNotUtf8) {
  const Json data = Json::parse(data_text(fill_template(kTemplate, {{"reason", "caf\xe9"}}, {})));
  EXPECT_THAT(data.at("reason").get<std::string>(), StartsWith("caf"));
}

TEST(Page, RefusesATemplateWithoutItsMarks) {
  EXPECT_THROW(fill_template("<html></html>", {}, {}), InvalidOption);
}

TEST(Page, IsWrittenOrItIsSaidWhyNot) {
  const TemporaryFolder folder;
  testing::make_run(folder.path());
  const std::optional<std::string> why_not = write_page(RecordSet::load(folder.path()), folder.path());
  EXPECT_EQ(why_not.has_value(), page_template().empty());
  if (why_not) {
    EXPECT_THAT(*why_not, Not(::testing::IsEmpty()));
  } else {
    const Json data = Json::parse(data_text(testing::bytes_of(folder.path() / "report.html")));
    EXPECT_EQ(data.at("name"), folder.path().filename().string());
    EXPECT_EQ(data.at("views").size(), 2U);
    EXPECT_EQ(data.at("cases").at("ring").at("laplacian").at("reason"), testing::kMarkupReason);
  }
}

}  // namespace
}  // namespace smopt::experiments
