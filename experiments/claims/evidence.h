#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/record_set.h"
#include "experiments/tables/molecule_table.h"

namespace smopt::experiments {

/// What records say of a claim.
enum class ClaimVerdict { holds, in_part, does_not_hold, cannot_be_told };

/// "holds", "in part", "does not hold", "cannot be told".
std::string_view to_string(ClaimVerdict verdict);
/// \throws InvalidInput for a word that is none of them.
ClaimVerdict parse_claim_verdict(std::string_view text);

/// Our figure beside the paper's, and what follows from it.
struct Evidence {
  ClaimVerdict verdict = ClaimVerdict::cannot_be_told;
  std::string ours;
};

/// What a molecule's records say.
struct Finding {
  double value = 0;
  std::string text;  ///< as it is shown where the molecule is named
};

using FindInRow = std::function<std::optional<Finding>(const MoleculeRow&)>;

/// Looks at every molecule of which the case `method` is done, and judges what is found. A molecule of which nothing is found is left out; a case
/// that failed counts against the claim. Molecules of the paper's rows (and their stand-ins) are named one by one, others by their range.
/// holds: `passes` for all of them; does not hold: for none; cannot be told: there is none.
Evidence judge_each(const RecordSet& records, std::string_view method, const FindInRow& find, const std::function<bool(double)>& passes);

/// Evidence of a claim that has two parts, each under its name. What cannot be told of one leaves the other's verdict.
Evidence combined(const std::string& first_name, const Evidence& first, const std::string& second_name, const Evidence& second);

/// The share (in per cent in the text), and the value, with so many decimals.
Finding percent_finding(double share, int decimals);
Finding number_finding(double value, int decimals, std::string_view unit);

/// The number of a molecule's case at a JSON pointer, where the case is done.
std::optional<double> number_of(const MoleculeRow& row, std::string_view method, const std::string& pointer);

}  // namespace smopt::experiments
