#include "experiments/page/packed_words.h"

#include <gmock/gmock.h>

#include <random>

#include "tests/experiments/page/unpacked_words.h"

namespace smopt::experiments {
namespace {

TEST(PackedWords, UnpackToWhatWasPacked) {
  std::mt19937 random(11);
  for (const std::size_t stride : {1U, 3U}) {
    for (const std::size_t count : {0U, 1U, 2U, 3U, 4U, 1000U}) {
      std::vector<std::uint32_t> words(count);
      for (std::uint32_t& word : words) word = static_cast<std::uint32_t>(random());
      EXPECT_EQ(testing::unpacked_words(pack_words(words, stride), stride), words) << count << " words, stride " << stride;
    }
  }
}

TEST(PackedWords, AreSmallWhereNeighboursAreAlike) {
  std::vector<std::uint32_t> words(30'000);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint32_t>(1'000'000 + 2 * i + i * i % 7);
  EXPECT_LT(pack_words(words, 1).size(), words.size());  // a fourth of the plain words
}

}  // namespace
}  // namespace smopt::experiments
