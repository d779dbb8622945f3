#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/claims/evidence.h"
#include "experiments/record_set.h"

namespace smopt::experiments {

/// A claim of Liu et al. 2017, or one of this project's own of smopt2. One entry of claims.json.
struct Claim {
  std::string id;
  std::string group;       ///< the heading it stands under
  std::string section;     ///< of the paper: "0.3", "Results, Table 3"
  std::string text;        ///< a short quotation, or what it says
  std::string paper;       ///< the paper's figure; of smopt2: what it aims at
  bool is_argued = false;  ///< no record can answer it: `argued` does
  ClaimVerdict argued = ClaimVerdict::cannot_be_told;
  std::map<ClaimVerdict, std::string> why;  ///< for each verdict that it may get
};

/// Reads a text of the form of claims.json. \throws InvalidInput naming the entry.
std::vector<Claim> parse_claims(std::string_view json);

/// Those of claims.json.
const std::vector<Claim>& all_claims();

struct JudgedClaim {
  const Claim* claim = nullptr;
  Evidence evidence;
};

/// What the records say of every claim of claims.json, in its order. Times, numbers and verdicts are those of the records; nothing is run.
std::vector<JudgedClaim> judge_claims(const RecordSet& records);

/// The page: which records it is from, how many claims hold, and every claim as a row: claim, the paper's figure, ours, verdict, why.
std::string claims_markdown(const RecordSet& records);

/// Writes the page. \throws InvalidInput when it cannot be written.
void write_claims(const RecordSet& records, const std::filesystem::path& path);

}  // namespace smopt::experiments
