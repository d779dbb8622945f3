#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "experiments/datasets.h"
#include "experiments/method_cases.h"
#include "smopt/timing.h"

namespace smopt::experiments {

using Json = nlohmann::ordered_json;

/// Goes up when a key of the records changes its meaning.
inline constexpr int kRecordSchema = 1;

/// The part of a record that is known before the case runs: molecule, surface, method, version, machine. Its status is "failed" until
/// `mark_done`, so that a record is never taken for more than it is. `method` is the case's name, `registered_method` the registry's.
Json record_header(const Dataset& dataset, const MethodCase& method_case);
/// Of the case of this name.
Json record_header(const Dataset& dataset, std::string_view method);

void mark_done(Json& record);
void mark_failed(Json& record, std::string_view reason);
/// Of a case whose method needs a program that is not here: neither done nor failed.
void mark_not_installed(Json& record, std::string_view reason);

}  // namespace smopt::experiments
