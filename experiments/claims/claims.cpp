#include "experiments/claims/claims.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "experiments/claims/predicates.h"
#include "experiments/datasets.h"
#include "experiments/embedded.h"
#include "experiments/tables/molecule_table.h"
#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::experiments {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPaperRows = 6;  // of each of its tables

constexpr std::array kVerdicts = {ClaimVerdict::holds, ClaimVerdict::in_part, ClaimVerdict::does_not_hold, ClaimVerdict::cannot_be_told};

Claim parse_claim(const Json& entry) {
  Claim claim;
  claim.id = entry.at("id").get<std::string>();
  claim.group = entry.at("group").get<std::string>();
  claim.section = entry.at("section").get<std::string>();
  claim.text = entry.at("claim").get<std::string>();
  claim.paper = entry.at("paper").get<std::string>();
  claim.is_argued = entry.contains("argued");
  if (claim.is_argued) claim.argued = parse_claim_verdict(entry.at("argued").get<std::string>());
  for (const auto& [verdict, why] : entry.at("why").items()) claim.why[parse_claim_verdict(verdict)] = why.get<std::string>();
  return claim;
}

Evidence evidence_of(const Claim& claim, const std::vector<Predicate>& predicates, const RecordSet& records) {
  if (claim.is_argued) return {claim.argued, ""};
  const auto found = std::find_if(predicates.begin(), predicates.end(), [&](const Predicate& p) { return p.id == claim.id; });
  return found == predicates.end() ? Evidence{} : found->evaluate(records);
}

/// A bar would end the cell, a line break the row.
std::string cell(std::string text) {
  if (text.empty()) return "—";
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string why_of(const JudgedClaim& judged) {
  const auto why = judged.claim->why.find(judged.evidence.verdict);
  if (why != judged.claim->why.end()) return why->second;
  return judged.evidence.verdict == ClaimVerdict::cannot_be_told ? "no case of these records shows it" : "";
}

bool is_of_paper(const JudgedClaim& judged) {
  return !judged.claim->section.empty();
}

std::string row_of(const JudgedClaim& judged) {
  const Claim& claim = *judged.claim;
  const std::string text = is_of_paper(judged) ? fmt::format("{} ({})", claim.text, claim.section) : claim.text;
  const std::string ours = claim.is_argued ? "by argument, not from records" : judged.evidence.ours;
  return fmt::format("| {} | {} | {} | **{}** | {} |\n", cell(text), cell(claim.paper), cell(ours), to_string(judged.evidence.verdict),
                     cell(why_of(judged)));
}

/// A heading and a table for every group, in the order of the claims.
std::string tables_of(const std::vector<JudgedClaim>& judged) {
  std::string text, group;
  for (const JudgedClaim& row : judged) {
    if (row.claim->group != group) {
      group = row.claim->group;
      text += fmt::format("\n## {}\n\n| Claim | {} | Here | Holds? | Why |\n| --- | --- | --- | --- | --- |\n", group,
                          is_of_paper(row) ? "The paper" : "Aim");
    }
    text += row_of(row);
  }
  return text;
}

/// Of the paper's claims.
std::string counts_of(std::vector<JudgedClaim> judged) {
  std::erase_if(judged, [](const JudgedClaim& j) { return !is_of_paper(j); });
  std::vector<std::string> counts;
  for (const ClaimVerdict verdict : kVerdicts) {
    const auto count =
        std::count_if(judged.begin(), judged.end(), [verdict](const JudgedClaim& j) { return j.evidence.verdict == verdict; });
    counts.push_back(fmt::format("{}: {}", to_string(verdict), count));
  }
  return fmt::format("{} claims of the paper: {}.", judged.size(), fmt::join(counts, ", "));
}

/// "1 of the paper's 6 rows (AChE monomer) and 2 of other molecules".
std::string molecules_text(const RecordSet& records) {
  std::vector<std::string> of_paper;
  std::size_t others = 0;
  for (const MoleculeRow& row : molecule_rows(records)) {
    if (row.paper_row)
      of_paper.push_back(row.title);
    else
      ++others;
  }
  std::string text = fmt::format("{} of the paper's {} rows", of_paper.size(), kPaperRows);
  if (!of_paper.empty()) text += fmt::format(" ({})", fmt::join(of_paper, ", "));
  if (others > 0) text += fmt::format(" and {} of other molecules", others);
  return text;
}

constexpr const char* kIntroduction =
    "# The paper's claims, one by one\n"
    "\n"
    "Every claim of Liu et al., PLoS ONE 12(9): e0184206, 2017, that can be tested, the paper's figure, and ours, written by\n"
    "`smopt report DIR --claims FILE` from the records of a run. Figures and verdicts are those of the records; what the words of a claim "
    "are\n"
    "taken to mean where the paper gives no number is in `experiments/claims/`. *Holds*: for every molecule; *in part*: for some; *cannot "
    "be\n"
    "told*: these records have no case that shows it. A case that failed counts against the claim.\n";

}  // namespace

std::vector<Claim> parse_claims(std::string_view text) {
  std::vector<Claim> claims;
  try {
    const Json json = Json::parse(text);
    for (const Json& entry : json.at("claims")) claims.push_back(parse_claim(entry));
  } catch (const std::exception& error) {
    throw InvalidInput(fmt::format("claims: entry {}: {}", claims.size() + 1, error.what()));
  }
  return claims;
}

const std::vector<Claim>& all_claims() {
  static const std::vector<Claim> claims = parse_claims(embedded::claims_json());
  return claims;
}

std::vector<JudgedClaim> judge_claims(const RecordSet& records) {
  const std::vector<Predicate> predicates = all_predicates();
  std::vector<JudgedClaim> judged;
  for (const Claim& claim : all_claims()) judged.push_back({&claim, evidence_of(claim, predicates, records)});
  return judged;
}

std::string claims_markdown(const RecordSet& records) {
  const std::vector<JudgedClaim> judged = judge_claims(records);
  return fmt::format("{}\nThese records: {}. A stand-in is another molecule of about the same size.\n\n{}\n{}", kIntroduction,
                     molecules_text(records), counts_of(judged), tables_of(judged));
}

void write_claims(const RecordSet& records, const std::filesystem::path& path) {
  write_file(path, claims_markdown(records));
}

}  // namespace smopt::experiments
