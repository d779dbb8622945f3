#include "experiments/regression/accept.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "experiments/run_layout.h"
#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::experiments {
namespace {

namespace fs = std::filesystem;

/// Laid out like a run's folder, so that `record_path` finds the records in it; beside the reference's own, on the same file system.
constexpr const char* kStaging = ".accepting";

/// The records as they are going to be, removed at the end of the scope with whatever is in it then.
class StagedRecords {
 public:
  explicit StagedRecords(const fs::path& reference) : root_(reference / kStaging) {
    fs::remove_all(root_);  // of a run that was killed
    fs::create_directory(root_);
    fs::copy(reference / "records", root_ / "records", fs::copy_options::recursive);
  }
  ~StagedRecords() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  StagedRecords(const StagedRecords&) = delete;
  StagedRecords& operator=(const StagedRecords&) = delete;

  /// Whether the case's record changed.
  [[nodiscard]] bool put(const CaseName& name, const std::string& bytes) const {
    const fs::path path = record_path(root_, name.molecule, name.method);
    if (fs::exists(path) && read_file(path) == bytes) return false;
    fs::create_directories(path.parent_path());
    write_file(path, bytes);
    return true;
  }

  void take_the_place_of(const fs::path& records) const {
    if (::renameat2(AT_FDCWD, (root_ / "records").c_str(), AT_FDCWD, records.c_str(), RENAME_EXCHANGE) == 0) return;
    if (errno != EINVAL && errno != ENOSYS) throw fs::filesystem_error("cannot replace", records, {errno, std::generic_category()});
    fs::rename(records, root_ / "before");  // a file system that cannot exchange: for a moment there are no records, never some of them
    fs::rename(root_ / "records", records);
  }

 private:
  fs::path root_;
};

bool is_not_installed(const std::string& record) {
  const auto json = RecordSet::Json::parse(record, nullptr, false);
  return text_at(&json, "/status") == "not installed";
}

}  // namespace

std::vector<CaseName> accept(const fs::path& run, const fs::path& reference, const Comparison& comparison) {
  if (fs::equivalent(run, reference)) throw InvalidOption(fmt::format("{}: cannot accept a run into itself", run.string()));
  std::vector<CaseName> names = comparison.compared, changed;
  names.insert(names.end(), comparison.only_in_run.begin(), comparison.only_in_run.end());
  const StagedRecords staged(reference);
  for (const CaseName& name : names) {
    const std::string record = read_file(record_path(run, name.molecule, name.method));
    if (!is_not_installed(record) && staged.put(name, record)) changed.push_back(name);
  }
  if (!changed.empty()) staged.take_the_place_of(reference / "records");
  return changed;
}

}  // namespace smopt::experiments
