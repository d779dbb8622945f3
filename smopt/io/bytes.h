#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace smopt {

/// The unsigned integer of a given size.
template <std::size_t Size>
struct UnsignedOfSize;
template <>
struct UnsignedOfSize<1> {
  using type = std::uint8_t;
};
template <>
struct UnsignedOfSize<2> {
  using type = std::uint16_t;
};
template <>
struct UnsignedOfSize<4> {
  using type = std::uint32_t;
};
template <>
struct UnsignedOfSize<8> {
  using type = std::uint64_t;
};

/// The same integer with its bytes in the other order.
template <std::unsigned_integral U>
constexpr U swap_bytes(U value) {
  if constexpr (sizeof(U) == 1) return value;
  if constexpr (sizeof(U) == 2) return static_cast<U>((value << 8) | (value >> 8));
  if constexpr (sizeof(U) == 4) return __builtin_bswap32(value);
  if constexpr (sizeof(U) == 8) return __builtin_bswap64(value);
}

/// The number stored at `bytes`, which need not be aligned.
template <class T>
T load(const char* bytes, std::endian order) {
  typename UnsignedOfSize<sizeof(T)>::type bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return std::bit_cast<T>(order == std::endian::native ? bits : swap_bytes(bits));
}

/// Appends a number's bytes, the least significant first.
template <class T>
void append_little_endian(std::string& out, T value) {
  auto bits = std::bit_cast<typename UnsignedOfSize<sizeof(T)>::type>(value);
  if constexpr (std::endian::native != std::endian::little) bits = swap_bytes(bits);
  char bytes[sizeof bits];
  std::memcpy(bytes, &bits, sizeof bits);
  out.append(bytes, sizeof bits);
}

}  // namespace smopt
