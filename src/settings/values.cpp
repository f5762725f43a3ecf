#include "settings/values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "settings/document.hpp"
#include "settings/nearest.hpp"

namespace rubatlas::settings {

std::string quoted(std::span<const std::string_view> words) {
  return fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

std::string with_unit(const Quantity& entry) {
  const bool bare = entry.unit.empty() || entry.unit == "1";
  return bare ? entry.range.text() : fmt::format("{} {}", entry.range.text(), entry.unit);
}

double checked_number(const nlohmann::json& value, std::string_view pointer, const Quantity& entry) {
  if (!value.is_number()) {
    fail(pointer, fmt::format("{} is not a number in {}; {}", shown(value), with_unit(entry), entry.meaning));
  }
  const double number = value.get<double>();
  if (!entry.range.contains(number)) {
    fail(pointer, fmt::format("{} is outside {}; {}", shown(value), with_unit(entry), entry.meaning));
  }
  return number + 0.0;  // makes −0 zero, so that equal scenes have equal canonical texts
}

namespace {

std::vector<double> checked_numbers(const nlohmann::json& value, std::string_view pointer,
                                    const Quantity& entry) {
  if (!value.is_array()) {
    fail(pointer,
         fmt::format("{} is not a list of numbers in {}; {}", shown(value), with_unit(entry), entry.meaning));
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < value.size(); ++i) {
    numbers.push_back(checked_number(value[i], child(pointer, std::to_string(i)), entry));
  }
  return numbers;
}

}  // namespace

Value checked_value(const nlohmann::json& value, std::string_view pointer, const Quantity& entry) {
  switch (entry.kind) {
    case Kind::number:
      return checked_number(value, pointer, entry);
    case Kind::whole_number:
      if (!value.is_number() || value.get<double>() != std::trunc(value.get<double>())) {
        fail(pointer, fmt::format("{} is not a whole number in {}; {}", shown(value), with_unit(entry),
                                  entry.meaning));
      }
      return static_cast<int>(checked_number(value, pointer, entry));
    case Kind::flag:
      if (!value.is_boolean()) {
        fail(pointer, fmt::format("{} is not true or false; {}", shown(value), entry.meaning));
      }
      return value.get<bool>();
    case Kind::text:
      if (!value.is_string()) fail(pointer, fmt::format("{} is not a text; {}", shown(value), entry.meaning));
      // Texts of HDF5 end there: the file would keep the beginning only.
      if (value.get_ref<const std::string&>().find('\0') != std::string::npos) {
        fail(pointer,
             fmt::format("{} has a character U+0000; any other is allowed; {}", shown(value), entry.meaning));
      }
      return value.get<std::string>();
    case Kind::numbers:
      return checked_numbers(value, pointer, entry);
    case Kind::choice:
      break;
  }
  if (!value.is_string()) {
    fail(pointer, fmt::format("{} is not one of {}; {}", shown(value), quoted(entry.choices), entry.meaning));
  }
  auto word = value.get<std::string>();
  if (std::find(entry.choices.begin(), entry.choices.end(), word) == entry.choices.end()) {
    fail(pointer, fmt::format("{} is not one of {}; {}; nearest: \"{}\"", shown(value), quoted(entry.choices),
                              entry.meaning, nearest(word, entry.choices)));
  }
  return word;
}

}  // namespace rubatlas::settings
