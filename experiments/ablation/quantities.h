#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/record_set.h"

namespace smopt::experiments {

/// How a quantity is spread over an axis, and in which form effects on it are worked out.
enum class QuantityScale {
  linear,       ///< effects are differences
  symmetric,    ///< linear near 0, logarithmic beyond; effects are differences
  logarithmic,  ///< positive; effects are factors, worked out on logarithms
};

std::string_view to_string(QuantityScale scale);

/// A number that the study is about.
struct Quantity {
  std::string id;     ///< in file formats, with the unit
  std::string title;  ///< as in tables and figures, with the unit
  std::string words;  ///< as in a sentence
  std::string unit;   ///< after a number in a sentence, with the space before it where there is one
  int decimals = 0;
  QuantityScale scale = QuantityScale::linear;
  double linear_to = 1;  ///< of a symmetric scale: where it stops being linear
  /// A change that is worth a word: a difference, or on a logarithmic scale a factor above or below 1 (times differ by a tenth from run to
  /// run, and more where they are milliseconds).
  double noticeable = 0;
  /// Of a case's record; `given` are the metrics of the mesh that changes are held against, null where they are not known.
  std::function<std::optional<double>(const RecordSet::Json& record, const RecordSet::Json* given)> of_case;
  /// Of the mesh as it was given to the method; nothing where it makes no sense.
  std::function<std::optional<double>(const RecordSet::Json& given)> of_given;
};

/// Intersecting pairs, smallest angle, shares below 10° and 20°, changes of volume and area, processor time, moves.
const std::vector<Quantity>& ablation_quantities();

const Quantity& find_quantity(std::string_view id);

/// How far apart two values are, in units of what is noticeable; on logarithms where factors count.
double change_size(const Quantity& quantity, double value, double reference);
bool is_noticeable(const Quantity& quantity, double value, double reference);

/// Decimals of a mean over cases: of a count, too, one.
int mean_decimals(const Quantity& quantity);

/// The value to so many decimals; never a negative zero.
double rounded(double value, int decimals);

/// "12.50 %", "3"; "none" where there is no number.
std::string in_words(const Quantity& quantity, const std::optional<double>& value);
/// The same of a mean over cases.
std::string mean_in_words(const Quantity& quantity, double mean);

}  // namespace smopt::experiments
