#include "experiments/machine.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <thread>

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

std::optional<std::string> cpu_model() {
  constexpr std::string_view kKey = "model name";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(kKey)) continue;
    const std::size_t value = line.find_first_not_of(": \t", kKey.size());
    if (value != std::string::npos) return line.substr(value);
  }
  return std::nullopt;
}

std::optional<long> memory_mb() {
  constexpr long kBytesPerMb = 1024 * 1024;
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page_size = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_size <= 0) return std::nullopt;
  return pages / (kBytesPerMb / page_size);
}

}  // namespace

Json machine_json() {
  const auto cpu = cpu_model();
  const auto memory = memory_mb();
  return {
      {"cpu", cpu ? Json(*cpu) : Json()}, {"cores", std::thread::hardware_concurrency()}, {"memory_mb", memory ? Json(*memory) : Json()}};
}

std::string compiler() {
#if defined(__clang__)
  return fmt::format("clang++ {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";  // proc(5): resets the peak resident set size to the current one
}

}  // namespace smopt::experiments
