#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace smopt::experiments {

/// Numbers of 32 bits as text for the page, whose program unpacks them (app/unpack.ts): each word less the word `stride` before it (modulo
/// 2³²), the lowest bytes of all of them first, then the second, third and highest; gzip; base64. Neighbours in a mesh are alike, so that the
/// higher bytes are nearly all zero: a mesh takes about half of what its plain arrays would.
/// \param stride  3 for coordinates, 1 for a list; at least 1.
std::string pack_words(std::span<const std::uint32_t> words, std::size_t stride);

}  // namespace smopt::experiments
