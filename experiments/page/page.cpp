#include "experiments/page/page.h"

#include <fmt/format.h>

#include "experiments/page/page_data.h"
#include "experiments/page/page_template.h"
#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::experiments {
namespace {

/// Indentation of `dump`: none.
constexpr int kCompact = -1;

/// JSON that can stand in a script element: "<", which is found in its texts only, is escaped there. Bytes that are not UTF-8 (of a
/// program's message) become "�".
std::string json_for_script(const nlohmann::ordered_json& data) {
  const std::string json = data.dump(kCompact, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string escaped;
  escaped.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      escaped += "\\u003c";
    else
      escaped += c;
  }
  return escaped;
}

std::string mesh_scripts(const RunViews& views) {
  std::string scripts;
  for (std::size_t i = 0; i < views.blobs.size(); ++i)
    fmt::format_to(std::back_inserter(scripts), "<script type=\"text/plain\" id=\"blob-{}\">{}</script>\n", i, views.blobs[i]);
  return scripts;
}

/// The text up to the mark; what follows it is left in `rest`.
std::string_view take_until(std::string_view& rest, std::string_view mark) {
  const std::size_t place = rest.find(mark);
  if (place == std::string_view::npos) throw InvalidOption(fmt::format("the page's template has no {}", mark));
  const std::string_view before = rest.substr(0, place);
  rest.remove_prefix(place + mark.size());
  return before;
}

/// "run" of "results/run/".
std::string run_name(const std::filesystem::path& directory) {
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::weakly_canonical(directory, ignored);
  return (path.has_filename() ? path.filename() : path.parent_path().filename()).string();
}

}  // namespace

std::string fill_template(std::string_view page_template, nlohmann::ordered_json data, const RunViews& views) {
  std::string_view rest = page_template;
  const std::string_view head = take_until(rest, kDataMark);
  const std::string_view program = take_until(rest, kMeshesMark);
  data["views"] = views.molecules;
  return fmt::format("{}<script type=\"application/json\" id=\"report-data\">{}</script>{}{}{}", head, json_for_script(data), program,
                     mesh_scripts(views), rest);
}

std::optional<std::string> write_page(const RecordSet& records, const std::filesystem::path& directory, const ProgressCallback& progress) {
  if (page_template().empty()) return std::string(why_no_page_template());
  const RunViews views = run_views(records, directory, {}, progress);
  write_file(directory / "report.html", fill_template(page_template(), page_data(records, run_name(directory)), views));
  return std::nullopt;
}

}  // namespace smopt::experiments
