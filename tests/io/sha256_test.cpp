#include "smopt/io/sha256.h"

#include <gtest/gtest.h>

#include "smopt/error.h"
#include "smopt/io/gzip.h"
#include "tests/support/files.h"

namespace smopt::testing {
namespace {

// FIPS 180-4's examples, as NIST publishes them.
TEST(Sha256, AgreesWithThePublishedExamples) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, OfAFileIsThatOfItsBytesAsStored) {
  const TemporaryFolder folder;
  const std::string packed = gzip("text");
  EXPECT_EQ(sha256_of_file(folder.file("a.gz", packed)), sha256_hex(packed));
  const std::string large(3000000, 'x');  // more than one block
  EXPECT_EQ(sha256_of_file(folder.file("b", large)), sha256_hex(large));
  EXPECT_EQ(sha256_of_file(folder.file("empty", "")), sha256_hex(""));
}

TEST(Sha256, RejectsAFileThatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THROW(sha256_of_file(folder.path() / "none"), InvalidInput);
  EXPECT_THROW(sha256_of_file(folder.path()), InvalidInput);
}

}  // namespace
}  // namespace smopt::testing
