#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace smopt {

/// Base64 (RFC 4648) with padding, without line breaks.
std::string encode_base64(std::string_view bytes);

/// The bytes of a base64 text; blanks and line breaks are passed over, and padding may stand inside, as where two texts are joined.
/// \return nothing when the text is not base64 or ends inside a group of four.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace smopt
