#include "experiments/claims/evidence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "smopt/error.h"

namespace smopt::experiments {
namespace {

constexpr std::array<std::pair<ClaimVerdict, std::string_view>, 4> kVerdicts = {{{ClaimVerdict::holds, "holds"},
                                                                                 {ClaimVerdict::in_part, "in part"},
                                                                                 {ClaimVerdict::does_not_hold, "does not hold"},
                                                                                 {ClaimVerdict::cannot_be_told, "cannot be told"}}};

struct Observed {
  const MoleculeRow* row = nullptr;
  Finding finding;
};

/// What was found, and which cases failed.
struct Observations {
  std::vector<Observed> of_paper;
  std::vector<Observed> others;
  std::vector<std::string> failures;
};

Observations observe(const std::vector<MoleculeRow>& rows, std::string_view method, const FindInRow& find) {
  Observations result;
  for (const MoleculeRow& row : rows) {
    const RecordSet::Json* const record = row.record(method);
    if (text_at(record, "/status") == "failed") {
      result.failures.push_back(fmt::format("{} failed ({})", row.title, text_at(record, "/reason").value_or("no reason given")));
    } else if (const auto finding = is_done(record) ? find(row) : std::nullopt) {
      (row.paper_row ? result.of_paper : result.others).push_back({&row, *finding});
    }
  }
  return result;
}

/// "2 others 0 to 3".
std::string range_text(const std::vector<Observed>& others, bool is_alone) {
  const auto [least, most] =
      std::minmax_element(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.finding.value < b.finding.value; });
  const std::string range =
      least->finding.text == most->finding.text ? least->finding.text : fmt::format("{} to {}", least->finding.text, most->finding.text);
  const bool is_one = others.size() == 1;
  const char* const noun = is_alone ? (is_one ? "molecule that the paper does not have" : "molecules that the paper does not have")
                           : is_one ? "other"
                                    : "others";
  return fmt::format("{} {}: {}", others.size(), noun, range);
}

std::string text_of(const Observations& observations) {
  std::vector<std::string> parts;
  for (const Observed& observed : observations.of_paper) parts.push_back(fmt::format("{}: {}", observed.row->title, observed.finding.text));
  if (!observations.others.empty()) parts.push_back(range_text(observations.others, parts.empty()));
  parts.insert(parts.end(), observations.failures.begin(), observations.failures.end());
  return fmt::format("{}", fmt::join(parts, "; "));
}

ClaimVerdict verdict_of(std::size_t passed, std::size_t all) {
  if (all == 0) return ClaimVerdict::cannot_be_told;
  if (passed == all) return ClaimVerdict::holds;
  return passed == 0 ? ClaimVerdict::does_not_hold : ClaimVerdict::in_part;
}

}  // namespace

std::string_view to_string(ClaimVerdict verdict) {
  return std::find_if(kVerdicts.begin(), kVerdicts.end(), [verdict](const auto& entry) { return entry.first == verdict; })->second;
}

ClaimVerdict parse_claim_verdict(std::string_view text) {
  const auto found = std::find_if(kVerdicts.begin(), kVerdicts.end(), [text](const auto& entry) { return entry.second == text; });
  if (found == kVerdicts.end()) throw InvalidInput(fmt::format("'{}' is no verdict", text));
  return found->first;
}

Evidence judge_each(const RecordSet& records, std::string_view method, const FindInRow& find, const std::function<bool(double)>& passes) {
  const std::vector<MoleculeRow> rows = molecule_rows(records);
  const Observations observations = observe(rows, method, find);
  std::size_t passed = 0;
  for (const auto* list : {&observations.of_paper, &observations.others})
    for (const Observed& observed : *list) passed += passes(observed.finding.value) ? 1 : 0;
  const std::size_t all = observations.of_paper.size() + observations.others.size() + observations.failures.size();
  return {verdict_of(passed, all), text_of(observations)};
}

Evidence combined(const std::string& first_name, const Evidence& first, const std::string& second_name, const Evidence& second) {
  const bool is_first_told = first.verdict != ClaimVerdict::cannot_be_told, is_second_told = second.verdict != ClaimVerdict::cannot_be_told;
  if (!is_second_told) return {first.verdict, is_first_told ? fmt::format("{}: {}", first_name, first.ours) : ""};
  const std::string second_text = fmt::format("{}: {}", second_name, second.ours);
  if (!is_first_told) return {second.verdict, second_text};
  return {first.verdict == second.verdict ? first.verdict : ClaimVerdict::in_part,
          fmt::format("{}: {}. {}", first_name, first.ours, second_text)};
}

Finding percent_finding(double share, int decimals) {
  constexpr double kPerCent = 100;
  return {share, number_finding(kPerCent * share, decimals, " %").text};
}

Finding number_finding(double value, int decimals, std::string_view unit) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos) text = fmt::format("{:.{}f}", 0.0, decimals);  // not "-0.00"
  return {value, fmt::format("{}{}", text, unit)};
}

std::optional<double> number_of(const MoleculeRow& row, std::string_view method, const std::string& pointer) {
  const RecordSet::Json* const record = row.record(method);
  return is_done(record) ? number_at(record, pointer) : std::nullopt;
}

}  // namespace smopt::experiments
