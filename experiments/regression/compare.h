#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/record_set.h"
#include "experiments/regression/record_value.h"
#include "experiments/regression/tolerance.h"

namespace smopt::experiments {

struct CaseName {
  std::string molecule;
  std::string method;
  bool operator==(const CaseName&) const = default;
};

/// A quantity that is not what it was.
struct Difference {
  CaseName of;
  std::string quantity;
  std::string unit;
  RecordValue reference;
  RecordValue now;
  double slack = 0;    ///< by how much it might have got worse, in the quantity's unit
  std::string reason;  ///< what the record says of it: why a case failed
  std::string why;     ///< the tolerance's reason
};

/// Something about a case that is told and never red.
struct CaseRemark {
  CaseName of;
  std::string text;
};

/// How a run stands against a reference.
struct Comparison {
  std::vector<Difference> worse;
  std::vector<Difference> better;
  std::vector<Difference> shown;         ///< worse or better by more than the tolerance, of quantities that never gate
  std::vector<CaseRemark> changed;       ///< what the two were given is not the same: molecule, surface, input, options
  std::vector<CaseRemark> not_compared;  ///< what one of them was not asked for
  std::vector<CaseName> only_in_run;
  std::vector<CaseName> only_in_reference;
  std::vector<CaseName> compared;
  std::size_t values = 0;  ///< how many quantities were held against each other
};

/// Holds every case that both have against each other. Pure: the order is that of the reference's molecules and methods.
Comparison compare(const RecordSet& run, const RecordSet& reference, const std::vector<Tolerance>& tolerances);

/// Whether the gate is red: something is worse or, where the run has to be `complete`, a case of the reference is not there.
bool is_red(const Comparison& comparison, bool complete);

}  // namespace smopt::experiments
