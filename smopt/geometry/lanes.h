#pragma once

#include <cstdint>

namespace smopt {

/// Four single-precision numbers that are worked on at once (the compiler's vector extension: SSE, NEON or plain code).
using Floats = float __attribute__((vector_size(16)));
/// What comparing them gives: a lane has all bits set where the comparison holds, none elsewhere.
using Masks = std::int32_t __attribute__((vector_size(16)));
inline constexpr std::size_t kLanes = 4;

inline Floats in_all_lanes(float x) {
  return Floats{x, x, x, x};
}
inline Floats absolute(Floats a) {
  return a < 0 ? -a : a;
}
inline Floats smaller_of(Floats a, Floats b) {
  return a < b ? a : b;
}
inline Floats larger_of(Floats a, Floats b) {
  return a > b ? a : b;
}

/// One bit a lane, lane 0 lowest: which lanes are set.
inline unsigned lanes_set(Masks m) {
#if defined(__SSE__)
  return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<Floats>(m)));
#else
  return static_cast<unsigned>((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}
/// The same for eight 16-bit lanes.
inline unsigned lanes_set(std::int16_t __attribute__((vector_size(16))) m) {
#if defined(__SSE2__)
  using Bytes = char __attribute__((vector_size(16)));
  const auto lanes = reinterpret_cast<short __attribute__((vector_size(16)))>(m);
  return static_cast<unsigned>(__builtin_ia32_pmovmskb128(reinterpret_cast<Bytes>(__builtin_ia32_packsswb128(lanes, lanes)))) & 0xFF;
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= (m[i] != 0 ? 1U : 0U) << i;
  return bits;
#endif
}
inline bool is_set_in_all(Masks m) {
  return lanes_set(m) == 0xF;
}

}  // namespace smopt
