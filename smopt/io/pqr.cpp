#include "smopt/io/pqr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "smopt/error.h"
#include "smopt/io/text_reader.h"

namespace smopt {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

/// Serial number, atom name, residue name, residue number and the five numbers; a chain identifier makes ten.
constexpr std::size_t kFewestFields = 9;

/// Columns 31–38, 39–46 and 47–54 of the PDB format (wwPDB, version 3.3, section 9).
constexpr std::size_t kFirstCoordinateColumn = 30;
constexpr std::size_t kCoordinateWidth = 8;
constexpr std::size_t kBehindCoordinates = kFirstCoordinateColumn + 3 * kCoordinateWidth;

/// x, y, z, charge, radius.
using Numbers = std::array<double, 5>;
constexpr std::array<std::string_view, 5> kNames = {"coordinate x", "coordinate y", "coordinate z", "charge", "radius"};

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::vector<std::string_view> fields_of(std::string_view text) {
  std::vector<std::string_view> fields;
  for (std::size_t at = text.find_first_not_of(kBlanks); at < text.size(); at = text.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    fields.push_back(text.substr(at, end - at));
    at = end;
  }
  return fields;
}

/// The line behind its record name, which may run into the serial number; nothing when it is not an atom's.
std::optional<std::string_view> atom_fields(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with("HETATM")) return line.substr(6);
  if (line.starts_with("ATOM") &&
      (line.size() == 4 || kBlanks.find(line[4]) != std::string_view::npos || std::isdigit(static_cast<unsigned char>(line[4]))))
    return line.substr(4);
  return std::nullopt;
}

/// The last five fields, when they are numbers behind a residue number: without one in front of them, a number is missing at the end.
std::optional<Numbers> last_numbers(const std::vector<std::string_view>& fields) {
  if (fields.size() < kFewestFields) return std::nullopt;
  const std::size_t first = fields.size() - std::tuple_size_v<Numbers>;
  if (fields[first - 1].find_first_of("0123456789") == std::string_view::npos) return std::nullopt;
  Numbers numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!parse_number(fields[first + i], numbers[i])) return std::nullopt;
  return numbers;
}

/// The three coordinates' columns; empty when the line is too short, or when their decimal points are not below one another as the format
/// has them (8.3): then the line is not in columns, and numbers would be cut in the wrong place.
std::vector<std::string_view> coordinate_columns(std::string_view line) {
  std::vector<std::string_view> columns;
  if (line.size() <= kBehindCoordinates) return columns;
  for (std::size_t at = kFirstCoordinateColumn; at < kBehindCoordinates; at += kCoordinateWidth)
    columns.push_back(line.substr(at, kCoordinateWidth));
  const std::size_t point = columns[0].find('.');
  if (columns[1].find('.') != point || columns[2].find('.') != point) columns.clear();
  return columns;
}

/// Coordinates from their columns, charge and radius from what follows.
std::optional<Numbers> by_fixed_columns(std::string_view line) {
  std::vector<std::string_view> texts = coordinate_columns(line);
  if (texts.empty()) return std::nullopt;
  const std::vector<std::string_view> rest = fields_of(line.substr(kBehindCoordinates));
  texts.insert(texts.end(), rest.begin(), rest.end());
  Numbers numbers{};
  if (texts.size() != numbers.size()) return std::nullopt;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!parse_number(trimmed(texts[i]), numbers[i])) return std::nullopt;
  return numbers;
}

/// Cuts a field before each minus sign that follows a digit or a point, when every piece is a number; otherwise leaves it whole.
void append_pieces(std::string_view field, std::vector<std::string_view>& pieces) {
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

std::optional<Numbers> by_inner_minus(const std::vector<std::string_view>& fields) {
  std::vector<std::string_view> pieces;
  for (const std::string_view field : fields) append_pieces(field, pieces);
  return last_numbers(pieces);
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : text_(text), name_(name) {
    if (text.empty()) throw InvalidInput(name + ": the file is empty");
  }

  Molecule parse() {
    for (std::size_t at = 0; at < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      ++line_number_;
      read_line(text_.substr(at, end - at));
      at = end + 1;
    }
    if (molecule_.centers.empty()) throw InvalidInput(fmt::format("{}: the file has no atoms (no line ATOM or HETATM)", name_));
    return std::move(molecule_);
  }

 private:
  void read_line(std::string_view line) {
    const std::optional<std::string_view> behind_record = atom_fields(line);
    if (!behind_record) return;
    const std::vector<std::string_view> fields = fields_of(*behind_record);
    std::optional<Numbers> numbers = last_numbers(fields);
    if (!numbers) numbers = by_fixed_columns(line);
    if (!numbers) numbers = by_inner_minus(fields);
    if (!numbers) fail_unread(fields);
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
  [[noreturn]] void fail_unread(const std::vector<std::string_view>& fields) const {
    if (fields.size() >= kFewestFields) {
      for (std::size_t i = 0; i < kNames.size(); ++i) {
        const std::string_view field = fields[fields.size() - kNames.size() + i];
        double value = 0;
        if (!parse_number(field, value)) fail(fmt::format("{} is \"{}\", expected a number", kNames[i], field.substr(0, 40)));
      }
    }
    fail("the atom's line does not end in x, y, z, charge and radius");
  }

  [[noreturn]] void fail(std::string_view message) const { throw InvalidInput(fmt::format("{}:{}: {}", name_, line_number_, message)); }

  std::string_view text_;
  const std::string& name_;
  std::size_t line_number_ = 0;
  Molecule molecule_;
};

}  // namespace

Molecule parse_pqr(std::string_view text, const std::string& name) {
  return Parser(text, name).parse();
}

}  // namespace smopt
