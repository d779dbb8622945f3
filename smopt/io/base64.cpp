#include "smopt/io/base64.h"

#include <array>
#include <cstdint>

namespace smopt {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::int8_t kNone = -1;
constexpr std::int8_t kBlank = -2;
constexpr std::int8_t kPadding = -3;

constexpr std::array<std::int8_t, 256> make_values() {
  std::array<std::int8_t, 256> values{};
  values.fill(kNone);
  for (std::size_t i = 0; i < kAlphabet.size(); ++i) values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
  for (const char c : {' ', '\t', '\r', '\n'}) values[static_cast<unsigned char>(c)] = kBlank;
  values['='] = kPadding;
  return values;
}
constexpr std::array<std::int8_t, 256> kValues = make_values();

/// Collects four characters into up to three bytes.
class Group {
 public:
  bool add(std::int8_t value) {
    const bool is_padding = value == kPadding;
    if (is_padding ? size_ < 2 : padding_ > 0) return false;
    bits_ = (bits_ << 6) | (is_padding ? 0U : static_cast<std::uint32_t>(value));
    padding_ += is_padding ? 1 : 0;
    ++size_;
    return true;
  }
  [[nodiscard]] bool is_empty() const { return size_ == 0; }
  [[nodiscard]] bool is_full() const { return size_ == 4; }
  void move_to(std::string& out) {
    for (int i = 0; i < 3 - padding_; ++i) out.push_back(static_cast<char>((bits_ >> (16 - 8 * i)) & 0xFF));
    *this = Group();
  }

 private:
  std::uint32_t bits_ = 0;
  int size_ = 0;
  int padding_ = 0;
};

std::uint32_t byte_at(std::string_view bytes, std::size_t i) {
  return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
}

}  // namespace

std::string encode_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::uint32_t bits = byte_at(bytes, i) << 16 | byte_at(bytes, i + 1) << 8 | byte_at(bytes, i + 2);
    for (std::size_t k = 0; k < 4; ++k) text.push_back(i + k <= bytes.size() ? kAlphabet[(bits >> (18 - 6 * k)) & 0x3F] : '=');
  }
  return text;
}

std::optional<std::string> decode_base64(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  Group group;
  for (const char c : text) {
    const std::int8_t value = kValues[static_cast<unsigned char>(c)];
    if (value == kBlank) continue;
    if (value == kNone || !group.add(value)) return std::nullopt;
    if (group.is_full()) group.move_to(bytes);
  }
  if (!group.is_empty()) return std::nullopt;
  return bytes;
}

}  // namespace smopt
