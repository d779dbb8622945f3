#pragma once

#include <cstdint>

namespace smopt {

/// The machine's memory, bytes.
std::uint64_t physical_memory_bytes();

}  // namespace smopt
