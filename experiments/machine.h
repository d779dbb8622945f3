#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace smopt::experiments {

/// The machine that runs this: `cpu` (the model's name), `cores` and `memory_mb`; what the system does not tell is null.
nlohmann::ordered_json machine_json();

/// The compiler that built this: "g++ 12.2.0".
std::string compiler();

/// Lets `peak_memory_mb()` count anew from here, where the system can do that (Linux); elsewhere it goes on counting from the start.
void reset_peak_memory();

}  // namespace smopt::experiments
