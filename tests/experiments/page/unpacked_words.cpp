#include "tests/experiments/page/unpacked_words.h"

#include <gtest/gtest.h>

#include "smopt/io/base64.h"
#include "smopt/io/gzip.h"

namespace smopt::testing {

std::vector<std::uint32_t> unpacked_words(const std::string& text, std::size_t stride) {
  const std::optional<std::string> packed = decode_base64(text);
  if (!packed || !is_gzip(*packed)) {
    ADD_FAILURE() << "not base64 of gzip";
    return {};
  }
  const std::string planes = gunzip(*packed, "words");
  const std::size_t count = planes.size() / 4;
  std::vector<std::uint32_t> words(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t byte = 0; byte < 4; ++byte)
      words[i] += std::uint32_t{static_cast<unsigned char>(planes[byte * count + i])} << (8 * byte);
    if (i >= stride) words[i] += words[i - stride];
  }
  return words;
}

}  // namespace smopt::testing
