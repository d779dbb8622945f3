#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace smopt {

/// The SHA-256 digest (FIPS 180-4) as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

/// The digest of a file as it is stored: what `sha256sum` prints, a `.gz` not unpacked.
/// \throws InvalidInput when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace smopt
