#include "smopt/io/pqr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "smopt/error.h"
#include "smopt/io/line_reader.h"
#include "smopt/io/text_reader.h"

namespace smopt {
namespace {

/// Serial number, atom name, residue name, residue number and the five numbers; a chain identifier makes ten.
constexpr std::size_t kFewestFields = 9;

/// Columns 31–38, 39–46 and 47–54 of the PDB format (wwPDB, version 3.3, section 9).
constexpr std::size_t kFirstCoordinateColumn = 30;
constexpr std::size_t kCoordinateWidth = 8;
constexpr std::size_t kBehindCoordinates = kFirstCoordinateColumn + 3 * kCoordinateWidth;

/// x, y, z, charge, radius.
using Numbers = std::array<double, 5>;
constexpr std::array<std::string_view, 5> kNames = {"coordinate x", "coordinate y", "coordinate z", "charge", "radius"};

using Fields = std::vector<std::string_view>;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Appends what stands between blanks.
void append_fields(std::string_view text, Fields& fields) {
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at != end;) {
    while (at != end && is_blank(*at)) ++at;
    const char* const begin = at;
    while (at != end && !is_blank(*at)) ++at;
    if (at != begin) fields.emplace_back(begin, static_cast<std::size_t>(at - begin));
  }
}

/// The line behind its record name, which may run into the serial number; nothing when it is not an atom's.
std::optional<std::string_view> atom_fields(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with("HETATM")) return line.substr(6);
  if (line.starts_with("ATOM") && (line.size() == 4 || is_blank(line[4]) || is_digit(line[4]))) return line.substr(4);
  return std::nullopt;
}

/// The last five fields, when they are numbers behind a residue number: without one in front of them, a number is missing at the end.
std::optional<Numbers> last_numbers(const Fields& fields) {
  if (fields.size() < kFewestFields) return std::nullopt;
  const std::size_t first = fields.size() - std::tuple_size_v<Numbers>;
  if (std::ranges::none_of(fields[first - 1], is_digit)) return std::nullopt;
  Numbers numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!parse_number(fields[first + i], numbers[i])) return std::nullopt;
  return numbers;
}

/// Appends the three coordinates' columns; false when the line is too short, or when their decimal points are not below one another as the
/// format has them (8.3): then the line is not in columns, and numbers would be cut in the wrong place.
bool append_coordinate_columns(std::string_view line, Fields& fields) {
  if (line.size() <= kBehindCoordinates) return false;
  const std::size_t point = line.substr(kFirstCoordinateColumn, kCoordinateWidth).find('.');
  for (std::size_t at = kFirstCoordinateColumn; at < kBehindCoordinates; at += kCoordinateWidth) {
    const std::string_view column = line.substr(at, kCoordinateWidth);
    if (column.find('.') != point) return false;
    fields.push_back(trimmed(column));
  }
  return true;
}

/// Coordinates from their columns, charge and radius from what follows. \param scratch  emptied first.
std::optional<Numbers> by_fixed_columns(std::string_view line, Fields& scratch) {
  scratch.clear();
  if (!append_coordinate_columns(line, scratch)) return std::nullopt;
  append_fields(line.substr(kBehindCoordinates), scratch);
  Numbers numbers{};
  if (scratch.size() != numbers.size()) return std::nullopt;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!parse_number(scratch[i], numbers[i])) return std::nullopt;
  return numbers;
}

/// Cuts a field before each minus sign that follows a digit or a point, when every piece is a number; otherwise leaves it whole.
void append_pieces(std::string_view field, Fields& pieces) {
  const std::size_t before = pieces.size();
  std::size_t begin = 0;
  double ignored = 0;
  for (std::size_t end = field.find('-', 1); begin < field.size(); end = field.find('-', end + 1)) {
    if (end < field.size() && std::string_view("0123456789.").find(field[end - 1]) == std::string_view::npos) continue;
    pieces.push_back(field.substr(begin, end - begin));
    if (!parse_number(pieces.back(), ignored)) {
      pieces.resize(before);
      pieces.push_back(field);
      return;
    }
    begin = std::min(end, field.size());
  }
}

/// \param scratch  emptied first.
std::optional<Numbers> by_inner_minus(const Fields& fields, Fields& scratch) {
  scratch.clear();
  for (const std::string_view field : fields) append_pieces(field, scratch);
  return last_numbers(scratch);
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : name_(name), lines_(text, name) {}

  Molecule parse() {
    while (lines_.next()) read_line(lines_.line());
    if (molecule_.centers.empty()) throw InvalidInput(fmt::format("{}: the file has no atoms (no line ATOM or HETATM)", name_));
    return std::move(molecule_);
  }

 private:
  void read_line(std::string_view line) {
    const std::optional<std::string_view> behind_record = atom_fields(line);
    if (!behind_record) return;
    fields_.clear();
    append_fields(*behind_record, fields_);
    std::optional<Numbers> numbers = last_numbers(fields_);
    if (!numbers) numbers = by_fixed_columns(line, scratch_);
    if (!numbers) numbers = by_inner_minus(fields_, scratch_);
    if (!numbers) fail_unread();
    add_atom(*numbers);
  }

  void add_atom(const Numbers& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (!std::isfinite(numbers[i])) fail(fmt::format("{} is {}, expected a finite number", kNames[i], numbers[i]));
    const auto [x, y, z, charge, radius] = numbers;
    if (radius < 0) fail(fmt::format("radius is {}, expected one that is not negative", radius));
    molecule_.centers.emplace_back(x, y, z);
    molecule_.charges.push_back(charge);
    molecule_.radii.push_back(radius);
  }

  /// Says which number it is that could not be read, as far as that can be told.
  [[noreturn]] void fail_unread() const {
    if (fields_.size() >= kFewestFields) {
      for (std::size_t i = 0; i < kNames.size(); ++i) {
        const std::string_view field = fields_[fields_.size() - kNames.size() + i];
        double value = 0;
        if (!parse_number(field, value)) fail(fmt::format("{} is {}, expected a number", kNames[i], quoted(field)));
      }
    }
    fail("the atom's line does not end in x, y, z, charge and radius");
  }

  [[noreturn]] void fail(std::string_view message) const { lines_.fail(message); }

  const std::string& name_;
  LineReader lines_;
  Fields fields_;   ///< of the current line; kept, so that lines cost no allocation
  Fields scratch_;  ///< likewise
  Molecule molecule_;
};

}  // namespace

Molecule parse_pqr(std::string_view text, const std::string& name) {
  return Parser(text, name).parse();
}

}  // namespace smopt
