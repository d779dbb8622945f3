#include "smopt/io/file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <random>

#include "smopt/io/gzip.h"
#include "tests/io/rejection.h"
#include "tests/support/files.h"

namespace smopt::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Bytes that do not pack, so that a packed file is long enough to be cut anywhere.
std::string random_bytes(std::size_t size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::string bytes(size, '\0');
  for (char& c : bytes) c = static_cast<char>(random() & 0xFF);
  return bytes;
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// While it lives no file of this process can grow beyond `bytes`: writing fails as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*old_handler_)(int);
  rlimit old_{};
};

/// While it lives, a standard descriptor is another file.
class Redirection {
 public:
  Redirection(int fd, const fs::path& path, int flags) : fd_(fd), saved_(dup(fd)) {
    const int file = open(path.c_str(), flags, 0666);
    dup2(file, fd);
    close(file);
  }
  ~Redirection() {
    dup2(saved_, fd_);
    close(saved_);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;

 private:
  int fd_;
  int saved_;
};

TEST(File, ReadsBackWhatItWrites) {
  const TemporaryFolder folder;
  for (const std::size_t size : {0, 1, 65536, 65537, 1000000}) {
    const std::string bytes = random_bytes(size, 1);
    write_file(folder.path() / "a", bytes);
    EXPECT_EQ(read_file(folder.path() / "a"), bytes) << size;
    write_file(folder.path() / "a.gz", bytes);
    EXPECT_EQ(read_file(folder.path() / "a.gz"), bytes) << size;
  }
  EXPECT_EQ(files_in(folder.path()), 2U);
}

TEST(File, PacksByNameAndUnpacksByContent) {
  const TemporaryFolder folder;
  write_file(folder.path() / "a.off.GZ", "text");
  EXPECT_TRUE(is_gzip(bytes_of(folder.path() / "a.off.GZ")));
  fs::rename(folder.path() / "a.off.GZ", folder.path() / "a.off");
  EXPECT_EQ(read_file(folder.path() / "a.off"), "text");
  EXPECT_EQ(read_file(folder.file("plain.gz", "not packed")), "not packed");
}

TEST(File, GzipAgreesWithTheGzipProgram) {
  const TemporaryFolder folder;
  const std::string bytes = random_bytes(100000, 2) + std::string(100000, 'a');
  put_file(folder, "theirs", bytes);
  write_file(folder.path() / "ours.gz", bytes);
  const std::string commands = "cd '" + folder.path().string() + "' && gzip theirs && gzip -d ours.gz";
  ASSERT_EQ(std::system(commands.c_str()), 0);
  EXPECT_EQ(read_file(folder.path() / "theirs.gz"), bytes);
  EXPECT_EQ(bytes_of(folder.path() / "ours"), bytes);
}

TEST(File, JoinedGzipMembersAreOneContent) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_file(folder.file("a.gz", gzip("one,") + gzip("") + gzip("two") + std::string(5, '\0'))), "one,two");
}

TEST(File, GzipBytesDependOnTheContentOnly) {
  EXPECT_EQ(gzip("abc"), gzip("abc"));
}

TEST(File, RejectsAGzipFileCutAnywhere) {
  const TemporaryFolder folder;
  const std::string packed = gzip(random_bytes(300, 3));
  for (std::size_t size = 2; size < packed.size(); ++size) {
    ASSERT_EQ(rejection(folder.path(), [&] { gunzip(packed.substr(0, size), "a.gz"); }), "a.gz: the gzip file is truncated") << size;
  }
}

TEST(File, RejectsADamagedGzipFile) {
  const TemporaryFolder folder;
  std::string packed = gzip(std::string(1000, 'x'));
  packed[packed.size() - 6] = static_cast<char>(packed[packed.size() - 6] ^ 1);  // in the check sum
  const fs::path path = folder.file("a.gz", packed);
  EXPECT_THAT(rejection(folder.path(), [&] { read_file(path); }), HasSubstr("a.gz: the gzip file is damaged"));
}

TEST(File, RejectsBytesBehindTheGzipData) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.gz", gzip("text") + "junk");
  EXPECT_EQ(rejection(folder.path(), [&] { read_file(path); }), "a.gz: 4 bytes follow the end of the gzip data");
}

TEST(File, NamesAMissingFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(rejection(folder.path(), [&] { read_file(folder.path() / "none"); }), "none: No such file or directory");
}

TEST(File, RejectsAFolder) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "sub");
  EXPECT_EQ(rejection(folder.path(), [&] { read_file(folder.path() / "sub"); }), "sub: Is a directory");
  EXPECT_EQ(rejection(folder.path(), [&] { write_file(folder.path() / "sub", "x"); }), "sub: Is a directory");
}

TEST(File, AFailedWriteLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a", "old");
  {
    const FileSizeLimit limit(1000);
    EXPECT_EQ(rejection(folder.path(), [&] { write_file(path, std::string(2000, 'x')); }), "a: File too large");
  }
  EXPECT_EQ(bytes_of(path), "old");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(File, AFailedWriteLeavesNoNewFile) {
  const TemporaryFolder folder;
  {
    const FileSizeLimit limit(1000);
    EXPECT_NE(rejection(folder.path(), [&] { write_file(folder.path() / "a", std::string(2000, 'x')); }), "");
  }
  EXPECT_EQ(files_in(folder.path()), 0U);
  EXPECT_EQ(rejection(folder.path(), [&] { write_file(folder.path() / "none" / "a", "x"); }), "none/a: No such file or directory");
}

TEST(File, OfFilesThatBelongTogetherNoneIsReplacedWhenOneFails) {
  const TemporaryFolder folder;
  const fs::path first = folder.file("first", "old first");
  const fs::path second = folder.file("second", "old second");
  const std::string large(2000, 'x');
  const std::array<FileContent, 2> files = {{{first, "new"}, {second, large}}};
  {
    const FileSizeLimit limit(1000);
    EXPECT_EQ(rejection(folder.path(), [&] { write_files(files); }), "second: File too large");
  }
  EXPECT_EQ(bytes_of(first), "old first");
  EXPECT_EQ(bytes_of(second), "old second");
  EXPECT_EQ(files_in(folder.path()), 2U);
}

TEST(File, ReplacingKeepsPermissionsAndLinks) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a", "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  fs::create_symlink("a", folder.path() / "link");
  write_file(folder.path() / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_EQ(bytes_of(path), "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST(File, ADeviceIsWrittenToAndNotReplaced) {
  write_file("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(rejection("/none", [] { write_file("/dev/full", "text"); }), "/dev/full: No space left on device");
}

TEST(File, AMinusIsStandardInputAndOutput) {
  const TemporaryFolder folder;
  const fs::path in = folder.file("in", random_bytes(200000, 4));
  {
    const Redirection from(STDIN_FILENO, in, O_RDONLY);
    const Redirection to(STDOUT_FILENO, folder.path() / "out", O_WRONLY | O_CREAT);
    write_file("-", read_file("-"));
  }
  EXPECT_EQ(bytes_of(folder.path() / "out"), bytes_of(in));
}

TEST(File, TheEndingTellsTheFormat) {
  EXPECT_EQ(format_ending("dir.ply/a.OFF.gz"), "off");
  EXPECT_EQ(format_ending("a.b.Vert"), "vert");
  EXPECT_EQ(format_ending("-"), "off");
  EXPECT_EQ(format_ending("a.gz"), "");
  EXPECT_EQ(format_ending("dir.off/a"), "");
}

}  // namespace
}  // namespace smopt::testing
