#pragma once

#include <fstream>
#include <string>

namespace smopt {

/// Largest resident memory, MB (2²⁰ bytes), of a process by its number or "self", since it became the program that it is; 0 when it has ended, or
/// where the system does not say (other than Linux). Not getrusage's figure: that survives exec, so that it counts the memory of whoever started
/// the program.
inline double peak_memory_mb_of(const std::string& process) {
  const std::string key = "VmHWM:";
  std::ifstream status("/proc/" + process + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(key)) return std::stod(line.substr(key.size())) / 1024;
  return 0;
}

/// The same of this process.
inline double peak_memory_mb() {
  return peak_memory_mb_of("self");
}

}  // namespace smopt
