#include "tests/experiments/records_alike.h"

#include <algorithm>
#include <array>

namespace smopt::testing {

using experiments::Json;

Json without_times(const Json& record) {
  constexpr std::array kTimes = {"repeats", "seconds", "cpu_seconds", "peak_memory_mb"};
  if (!record.is_object() && !record.is_array()) return record;
  Json rest = record.is_array() ? Json::array() : Json::object();
  if (record.is_array())
    for (const Json& item : record) rest.push_back(without_times(item));
  else
    for (const auto& [key, value] : record.items())
      if (std::ranges::find(kTimes, key) == kTimes.end()) rest[key] = without_times(value);
  // How many threads solved is no more a result than how long they took; of the methods it is an option.
  if (rest.contains("relative_residual")) rest.erase("threads");
  return rest;
}

}  // namespace smopt::testing
