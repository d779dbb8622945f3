#pragma once

#include <string>
#include <string_view>

namespace smopt {

/// Whether `bytes` begin as a gzip file does.
bool is_gzip(std::string_view bytes);

/// Unpacks a gzip file of one or more members (RFC 1952); zero bytes after the last member are padding.
/// \param name  how messages call it.
/// \throws InvalidInput when it is truncated or damaged, or something else follows it.
/// Cost: O(unpacked size), which is held once.
std::string gunzip(std::string_view packed, const std::string& name);

/// One gzip member without name or time, so that the same content gives the same bytes.
std::string gzip(std::string_view content);

}  // namespace smopt
