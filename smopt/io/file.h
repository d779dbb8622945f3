#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace smopt {

/// The whole content of a file, unpacked when it is gzip (told by its first bytes, not by its name); `-` is standard input.
/// \throws InvalidInput when it does not exist, cannot be read, or is a truncated gzip file.
std::string read_file(const std::filesystem::path& path);

/// Writes beside `path` and renames, so that `path` holds the old content or the new one and never a part; packed when the name ends in
/// `.gz`;
/// `-` is standard output.
/// \throws InvalidInput when it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

/// One of several files that belong together.
struct FileContent {
  std::filesystem::path path;
  std::string_view content;
};

/// `write_file` for files that belong together: all are written beside their places before the first is renamed.
/// \throws InvalidInput when one cannot be written; then none is replaced.
void write_files(std::span<const FileContent> files);

/// Whether the name ends in `.gz`, in whatever case.
bool is_gzip_name(const std::filesystem::path& path);

/// How messages name a file: "standard input" for `-`.
std::string display_name(const std::filesystem::path& path);

/// The lower-case ending that tells the format, `.gz` left out: "off" for `a.OFF.gz`; "off" for `-`.
std::string format_ending(const std::filesystem::path& path);

}  // namespace smopt
