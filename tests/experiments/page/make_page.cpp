// make_page DIR: writes a made run and its page into two folders for the browser's test, DIR/run (with meshes) and DIR/bare (records only),
// and DIR/large/report.html, where the meshes are shown in part. Exit status 77 and the reason when this build has no page.
#include <fmt/format.h>

#include <exception>

#include "experiments/page/page.h"
#include "experiments/page/page_data.h"
#include "experiments/page/page_template.h"
#include "smopt/io/file.h"
#include "tests/experiments/page/made_run.h"

namespace {

namespace fs = std::filesystem;
using smopt::experiments::RecordSet;

/// What ctest takes for "skipped".
constexpr int kSkipped = 77;

void make_pages(const fs::path& folder) {
  smopt::testing::make_run(folder / "run");
  smopt::experiments::write_page(RecordSet::load(folder / "run"), folder / "run");
  smopt::testing::make_run(folder / "bare");
  fs::remove_all(folder / "bare" / "meshes");
  smopt::experiments::write_page(RecordSet::load(folder / "bare"), folder / "bare");
  const RecordSet records = RecordSet::load(folder / "run");
  fs::create_directories(folder / "large");
  smopt::write_file(folder / "large" / "report.html",
                    smopt::experiments::fill_template(smopt::experiments::page_template(), smopt::experiments::page_data(records, "large"),
                                                      smopt::experiments::run_views(records, folder / "run", {.shown_triangles = 400})));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  if (smopt::experiments::page_template().empty()) {
    fmt::print("skipped: {}\n", smopt::experiments::why_no_page_template());
    return kSkipped;
  }
  try {
    make_pages(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
