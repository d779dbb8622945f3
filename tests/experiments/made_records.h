#pragma once

#include <string>
#include <vector>

#include "experiments/datasets.h"
#include "experiments/record.h"
#include "experiments/record_set.h"

/// Records as a run writes them, made by hand.
namespace smopt::testing {

/// A dataset that names no file.
experiments::Dataset made_dataset(const std::string& name, experiments::Role role = experiments::Role::extra);

/// The AChE monomer, with its row in the paper.
experiments::Dataset ache_monomer();

/// A case that ended well: 1000 atoms, 500 vertices before and 400 after, 7 intersecting pairs, histograms with counts 1, 2, 3 …, TetGen
/// failed with -p ("too sharp") and succeeded with -pY, solvation not computed ("not asked for").
experiments::Json made_record(const experiments::Dataset& dataset, const std::string& method);

/// A case that failed of `reason`.
experiments::Json failed_record(const experiments::Dataset& dataset, const std::string& method, const std::string& reason);

/// A solvation energy that was found, 300 kcal/mol of it nonpolar, in place of the record's.
void set_solvation(experiments::Json& record, double total, int iterations, int degenerate_vertices);

/// One repeat's processor seconds in the stages that Table 2 tells.
struct CpuSeconds {
  double validity = 0;
  double cavities = 0;
  double redundant = 0;
  double smoothing = 0;
};

/// The stages' times of every repeat, in place of those of the record.
void set_cpu_seconds(experiments::Json& record, const std::vector<CpuSeconds>& repeats);

}  // namespace smopt::testing
