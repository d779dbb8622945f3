#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>

#include "smopt/error.h"
#include "smopt/io/file.h"

namespace smopt::experiments {

/// The main function of a study's program: parses the command line, runs the study, and turns what either throws into one line on standard
/// error. \return the exit code, as the program's own: 0 done, 2 wrong usage, 3 bad input, 4 internal error.
inline int run_study_program(CLI::App& app, int argc, char** argv, const std::function<void()>& study) {
  constexpr int kDone = 0, kWrongUsage = 2, kBadInput = 3, kInternalError = 4;
  const auto report = [&](const std::exception& error, int code) {
    fmt::print(stderr, "{}: {}\n", app.get_name(), error.what());
    return code;
  };
  try {
    app.parse(argc, argv);
    study();
    return kDone;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  } catch (const InvalidOption& error) {
    return report(error, kWrongUsage);
  } catch (const InvalidInput& error) {
    return report(error, kBadInput);
  } catch (const std::exception& error) {
    return report(error, kInternalError);
  }
}

/// Writes NAME.md, and NAME.json if there is one, into a folder that is made for them; without a folder, the page to standard output.
inline void write_study(const std::filesystem::path& folder, const std::string& name, const std::string& page,
                        const std::string& json = {}) {
  if (folder.empty()) {
    fmt::print("{}", page);
    return;
  }
  std::filesystem::create_directories(folder);
  write_file(folder / (name + ".md"), page);
  if (!json.empty()) write_file(folder / (name + ".json"), json);
}

}  // namespace smopt::experiments
