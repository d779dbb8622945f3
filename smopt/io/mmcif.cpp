#include "smopt/io/mmcif.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "smopt/error.h"
#include "smopt/io/atom_site.h"
#include "smopt/io/cif_reader.h"
#include "smopt/io/text_reader.h"

namespace smopt {
namespace {

constexpr std::string_view kCategory = "_atom_site.";
/// The same category in CIFs of small molecules, which have no dots; their coordinates are fractions of a unit cell.
constexpr std::string_view kSmallMoleculeCategory = "_atom_site_";

/// What is read of an atom.
enum class Item { x, y, z, element, occupancy, alternate, model, insertion, atom, residue, chain, residue_number, count };
constexpr auto kItems = static_cast<std::size_t>(Item::count);

/// The columns that hold an item, the best first; empty where there is only one.
constexpr std::array<std::array<std::string_view, 2>, kItems> kColumns = {{{"cartn_x"},
                                                                           {"cartn_y"},
                                                                           {"cartn_z"},
                                                                           {"type_symbol"},
                                                                           {"occupancy"},
                                                                           {"label_alt_id"},
                                                                           {"pdbx_pdb_model_num"},
                                                                           {"pdbx_pdb_ins_code"},
                                                                           {"auth_atom_id", "label_atom_id"},
                                                                           {"auth_comp_id", "label_comp_id"},
                                                                           {"auth_asym_id", "label_asym_id"},
                                                                           {"auth_seq_id", "label_seq_id"}}};

/// As the dictionary spells them, for messages.
constexpr std::array<std::string_view, 4> kRequired = {"Cartn_x", "Cartn_y", "Cartn_z", "type_symbol"};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// Where the items stand in a row.
class Layout {
 public:
  /// \param columns  of the category, its name left out, in lower case.
  explicit Layout(const std::vector<std::string>& columns) {
    for (std::size_t item = 0; item < kItems; ++item) {
      for (const std::string_view name : kColumns[item]) {
        const auto column = std::ranges::find(columns, name);
        if (name.empty() || column == columns.end()) continue;
        at_[item] = static_cast<std::size_t>(column - columns.begin());
        break;
      }
    }
  }

  /// The required column that is missing; empty when all are there.
  [[nodiscard]] std::string_view missing() const {
    for (std::size_t i = 0; i < kRequired.size(); ++i)
      if (!at_[i]) return kRequired[i];
    return {};
  }

  /// The item in a row; nothing where it has no column or no value.
  [[nodiscard]] const CifToken* find(const std::vector<CifToken>& row, Item item) const {
    const std::optional<std::size_t>& at = at_[static_cast<std::size_t>(item)];
    return at && !row[*at].is_null() ? &row[*at] : nullptr;
  }
  [[nodiscard]] std::string_view text(const std::vector<CifToken>& row, Item item) const {
    const CifToken* token = find(row, item);
    return token ? token->text : std::string_view();
  }
  /// A required item, given or not.
  [[nodiscard]] const CifToken& required(const std::vector<CifToken>& row, Item item) const {
    return row[at_[static_cast<std::size_t>(item)].value()];
  }

 private:
  std::array<std::optional<std::size_t>, kItems> at_;
};

/// Without the standard uncertainty that may follow in parentheses, `1.234(5)`.
std::string_view without_uncertainty(std::string_view number) {
  return number.ends_with(')') ? number.substr(0, number.find('(')) : number;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : name_(name), reader_(text, name) {}

  Molecule parse(const MoleculeReadOptions& options, MoleculeReadReport& report) {
    read_block();
    if (sites_.empty()) fail_without_atoms();
    if (other_models_ > 0) report.notes.push_back(fmt::format("only the first model is read: {} atoms of others left out", other_models_));
    return molecule_of(std::move(sites_), name_, options, report);
  }

 private:
  void read_block() {
    advance();
    if (token_.kind != CifKind::data)
      reader_.fail(token_.line, fmt::format("{} where a data block (data_…) was expected", quoted(token_.text)));
    advance();
    while (token_.kind != CifKind::end && token_.kind != CifKind::data) read_statement();
    if (!item_tags_.empty()) read_rows_of_items();
  }

  void read_statement() {
    switch (token_.kind) {
      case CifKind::loop:
        return read_loop();
      case CifKind::tag:
        return read_item();
      case CifKind::frame:
        return advance();
      default:
        reader_.fail(token_.line, fmt::format("the value {} has no name", quoted(token_.text)));
    }
  }

  void read_item() {
    const CifToken tag = token_;
    advance();
    if (token_.kind != CifKind::value) reader_.fail(tag.line, fmt::format("{} has no value", quoted(tag.text)));
    if (is_of_atoms(tag)) {
      item_tags_.push_back(tag);
      item_row_.push_back(token_);
    }
    advance();
  }

  void read_loop() {
    const std::size_t line = token_.line;
    std::vector<CifToken> tags;
    for (advance(); token_.kind == CifKind::tag; advance()) tags.push_back(token_);
    if (tags.empty()) reader_.fail(line, "the loop has no columns");
    if (std::ranges::any_of(tags, [this](const CifToken& tag) { return is_of_atoms(tag); }))
      read_atoms(tags);
    else
      skip_values();
  }

  void skip_values() {
    while (token_.kind == CifKind::value) advance();
  }

  void read_atoms(const std::vector<CifToken>& tags) {
    const Layout layout = layout_of(tags);
    std::vector<CifToken> row;
    for (; token_.kind == CifKind::value; advance()) {
      row.push_back(token_);
      if (row.size() < tags.size()) continue;
      add_atom(layout, row);
      row.clear();
    }
    if (!row.empty())
      reader_.fail(row.back().line, fmt::format("the last row of the atoms has {} values, expected {}", row.size(), tags.size()));
  }

  void read_rows_of_items() { add_atom(layout_of(item_tags_), item_row_); }

  Layout layout_of(const std::vector<CifToken>& tags) const {
    std::vector<std::string> columns;
    for (const CifToken& tag : tags) {
      std::string column = lower_case(tag.text);
      column.erase(0, std::min(kCategory.size(), column.size()));
      if (std::ranges::find(columns, column) != columns.end()) reader_.fail(tag.line, fmt::format("{} is there twice", quoted(tag.text)));
      columns.push_back(std::move(column));
    }
    Layout layout(columns);
    if (!layout.missing().empty())
      reader_.fail(tags.front().line, fmt::format("the atoms have no column {}{}", kCategory, layout.missing()));
    return layout;
  }

  void add_atom(const Layout& layout, const std::vector<CifToken>& row) {
    if (!is_first_model(layout.text(row, Item::model))) {
      ++other_models_;
      return;
    }
    AtomSite site;
    site.center = {number(layout.required(row, Item::x), "Cartn_x"), number(layout.required(row, Item::y), "Cartn_y"),
                   number(layout.required(row, Item::z), "Cartn_z")};
    if (const CifToken* occupancy = layout.find(row, Item::occupancy)) site.occupancy = number(*occupancy, "occupancy");
    site.line = layout.required(row, Item::element).line;
    site.element = layout.text(row, Item::element);
    site.atom = layout.text(row, Item::atom);
    site.residue = layout.text(row, Item::residue);
    site.alternate = layout.text(row, Item::alternate);
    site.chain = layout.text(row, Item::chain);
    site.residue_number = layout.text(row, Item::residue_number);
    site.insertion = layout.text(row, Item::insertion);
    sites_.push_back(site);
  }

  bool is_first_model(std::string_view model) {
    if (sites_.empty()) first_model_ = model;
    return model == first_model_;
  }

  double number(const CifToken& token, std::string_view what) const {
    double value = 0;
    if (!parse_number(without_uncertainty(token.text), value))
      reader_.fail(token.line, fmt::format("{} is {}, expected a number", what, quoted(token.text)));
    if (!std::isfinite(value)) reader_.fail(token.line, fmt::format("{} is {}, expected a finite number", what, value));
    return value;
  }

  bool is_of_atoms(const CifToken& tag) {
    const std::string name = lower_case(tag.text.substr(0, kCategory.size()));
    is_small_molecule_ = is_small_molecule_ || name == kSmallMoleculeCategory;
    return name == kCategory;
  }

  [[noreturn]] void fail_without_atoms() const {
    if (is_small_molecule_)
      throw InvalidInput(fmt::format("{}: a CIF of a small molecule ({}…), whose coordinates are fractions of a cell; mmCIF is read", name_,
                                     kSmallMoleculeCategory));
    throw InvalidInput(fmt::format("{}: the first data block has no atoms ({}…)", name_, kCategory));
  }

  void advance() { token_ = reader_.next(); }

  const std::string& name_;
  CifReader reader_;
  CifToken token_;
  std::vector<CifToken> item_tags_;  ///< of the category's items outside loops
  std::vector<CifToken> item_row_;
  std::vector<AtomSite> sites_;
  std::string_view first_model_;
  std::size_t other_models_ = 0;
  bool is_small_molecule_ = false;
};

}  // namespace

Molecule parse_mmcif(std::string_view text, const std::string& name, const MoleculeReadOptions& options, MoleculeReadReport& report) {
  return Parser(text, name).parse(options, report);
}

}  // namespace smopt
