#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace smopt::testing {

/// What the page's program makes of the text of `pack_words`. Fails the test when it is none.
std::vector<std::uint32_t> unpacked_words(const std::string& text, std::size_t stride);

}  // namespace smopt::testing
