#include "experiments/page/packed_words.h"

#include "smopt/io/base64.h"
#include "smopt/io/gzip.h"

namespace smopt::experiments {

std::string pack_words(std::span<const std::uint32_t> words, std::size_t stride) {
  constexpr std::size_t kBytes = sizeof(std::uint32_t);
  std::string planes(kBytes * words.size(), '\0');
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::uint32_t difference = i < stride ? words[i] : words[i] - words[i - stride];
    for (std::size_t byte = 0; byte < kBytes; ++byte) planes[byte * words.size() + i] = static_cast<char>(difference >> (8 * byte) & 0xffU);
  }
  return encode_base64(gzip(planes));
}

}  // namespace smopt::experiments
