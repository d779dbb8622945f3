#include "experiments/run/case_line.h"

#include <fmt/format.h>

#include "experiments/method_cases.h"
#include "experiments/record_set.h"

namespace smopt::experiments {
namespace {

std::string pairs_text(const Json& record) {
  const auto pairs = number_at(&record, "/metrics/after/intersecting_pairs");
  return pairs ? fmt::format("{:.0f} intersecting pairs", *pairs) : "intersecting pairs not counted";
}

/// "; TetGen p success, pY failed", nothing where it was not run.
std::string tetgen_text(const Json& record) {
  std::string text;
  if (!record.contains("tetgen")) return text;
  for (const auto& [switches, outcome] : record.at("tetgen").items())
    text += fmt::format("{} {} {}", text.empty() ? "; TetGen" : ",", switches, outcome.at("status").get<std::string>());
  return text;
}

/// "; solvation -512.3 kcal/mol", or how it ended; nothing where it is not computed.
std::string solvation_text(const Json& record) {
  const std::string status = text_at(&record, "/solvation/status").value_or("not computed");
  if (status == "not computed") return "";
  const auto energy = number_at(&record, "/solvation/total_kcal_per_mol");
  return status == "success" && energy ? fmt::format("; solvation {:.1f} kcal/mol", *energy) : fmt::format("; solvation {}", status);
}

std::string time_text(const Json& record) {
  const char* stage = text_at(&record, "/method") == kInitial ? "/cpu_seconds/generate" : "/cpu_seconds/total";
  const auto seconds = number_at(&record, stage);
  return seconds ? fmt::format("; {:.2f} s CPU", *seconds) : "";
}

std::string divergence_text(const Json& record) {
  const auto step = number_at(&record, "/diverged_at_step");
  return step ? fmt::format("; diverged at step {:.0f}", *step) : "";
}

}  // namespace

std::string case_line(const Json& record) {
  if (!is_done(&record)) return fmt::format("{}: {}", record.at("status").get<std::string>(), text_at(&record, "/reason").value_or(""));
  return fmt::format("{:.0f} vertices, {}{}{}{}{}", number_at(&record, "/output/vertices").value_or(0), pairs_text(record),
                     tetgen_text(record), solvation_text(record), time_text(record), divergence_text(record));
}

}  // namespace smopt::experiments
