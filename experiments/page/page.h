#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "experiments/page/run_views.h"
#include "experiments/record_set.h"
#include "smopt/progress.h"

namespace smopt::experiments {

/// Where the template takes the data: once before its program, and the packed meshes after it, so that the page shows before they are read.
inline constexpr std::string_view kDataMark = "<!--smopt:data-->";
inline constexpr std::string_view kMeshesMark = "<!--smopt:meshes-->";

/// Writes `directory`/report.html: the run's tables, figures and meshes in one file that needs no other and no network.
/// \return why it was not written (this build has no template, see `page_template`); nothing when it was.
/// \throws InvalidInput when the file cannot be written. Cancelled. Cost: see `run_views`.
std::optional<std::string> write_page(const RecordSet& records, const std::filesystem::path& directory,
                                      const ProgressCallback& progress = {});

/// The template with the data in its places, as `<script type="application/json" id="report-data">` and, for each blob,
/// `<script type="text/plain" id="blob-N">`. What the data say cannot end the element they stand in.
/// \throws InvalidOption when the template lacks a mark.
std::string fill_template(std::string_view page_template, nlohmann::ordered_json data, const RunViews& views);

}  // namespace smopt::experiments
