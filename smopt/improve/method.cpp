#include "smopt/improve/method.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "smopt/error.h"

namespace smopt {
namespace {

template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

template <class Number>
Number parse_option(const std::string& name, const std::string& text, Number at_least, std::string_view kind) {
  Number value{};
  if (!parse_whole(text, value) || !std::isfinite(static_cast<double>(value)))
    throw InvalidOption(fmt::format("--{}: expected {}, got '{}'", name, kind, text));
  if (!(value >= at_least)) throw InvalidOption(fmt::format("--{}: expected {} of at least {}, got '{}'", name, kind, at_least, text));
  return value;
}

/// Whether the text is a value of the option's kind, whatever its range. \throws InvalidOption naming the option when it is not.
void require_kind(const MethodOption& option, const std::string& text) {
  switch (option.kind) {
    case MethodOption::Kind::integer:
      parse_option(option.name, text, std::numeric_limits<int>::lowest(), "a whole number");
      break;
    case MethodOption::Kind::number:
      parse_option(option.name, text, std::numeric_limits<double>::lowest(), "a number");
      break;
    case MethodOption::Kind::choice:
      if (std::find(option.choices.begin(), option.choices.end(), text) == option.choices.end())
        throw InvalidOption(fmt::format("--{}: '{}' is none of {}", option.name, text, fmt::join(option.choices, ", ")));
      break;
    case MethodOption::Kind::text:
      break;
  }
}

constexpr std::array<std::pair<std::string_view, CavityPolicy>, 3> kCavityPolicies = {
    {{"delete", CavityPolicy::delete_cavities}, {"keep", CavityPolicy::keep}, {"main", CavityPolicy::main}}};

}  // namespace

OptionValues::OptionValues(const std::vector<MethodOption>& options, const std::map<std::string, std::string>& given) {
  for (const MethodOption& option : options) values_[option.name] = option.default_value;
  for (const auto& [name, value] : given) {
    const auto option = std::find_if(options.begin(), options.end(), [&](const MethodOption& o) { return o.name == name; });
    if (option == options.end()) throw InvalidOption(fmt::format("--{} is not an option of this method", name));
    require_kind(*option, value);
    values_[name] = value;
  }
}

int OptionValues::integer(const std::string& name, int at_least) const {
  return parse_option(name, text(name), at_least, "a whole number");
}

double OptionValues::number(const std::string& name, double at_least) const {
  return parse_option(name, text(name), at_least, "a number");
}

const std::string& OptionValues::text(const std::string& name) const {
  const auto it = values_.find(name);
  if (it == values_.end()) throw InvalidOption(fmt::format("--{} is not an option of this method", name));
  return it->second;
}

const Method& MethodRegistry::find(std::string_view name) const {
  for (const Method& method : methods_)
    if (method.name == name) return method;
  std::vector<std::string> names;
  for (const Method& method : methods_) names.push_back(method.name);
  throw InvalidOption(fmt::format("no method '{}'; there are {}", name, fmt::join(names, ", ")));
}

CavityPolicy parse_cavity_policy(std::string_view text) {
  for (const auto& [name, policy] : kCavityPolicies)
    if (name == text) return policy;
  throw InvalidOption(fmt::format("--cavities: '{}' is none of delete, keep, main", text));
}

std::string_view to_string(CavityPolicy policy) {
  return std::find_if(kCavityPolicies.begin(), kCavityPolicies.end(), [&](const auto& entry) { return entry.second == policy; })->first;
}

}  // namespace smopt
