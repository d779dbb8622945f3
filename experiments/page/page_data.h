#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/record_set.h"
#include "experiments/tables/table.h"

namespace smopt::experiments {

/// A table as JSON: name, caption, columns [{id, title}], rows [[cell, …], …], notes. A cell is null, a text, a count, or [number, decimals].
nlohmann::ordered_json table_json(const Table& table);

/// What the page tells of a run but for its meshes: name; provenance {version, compiler, machine, threads, each a list of the different
/// ones}; tables; molecules [{name, title, role, about, atoms, paper_row}]; methods [{name, title, in_paper}], in the order of the tables;
/// cases {<molecule>: {<method>: the numbers of its record that the page shows}}. A number that is not finite is null.
nlohmann::ordered_json page_data(const RecordSet& records, const std::string& run_name);

}  // namespace smopt::experiments
