/// Where the value of a quantity is stored in a `Scene`: from member pointers to the functions that read and
/// write it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "settings/quantity.hpp"

namespace rubatlas::settings {

// A quantity's `choices` stand in the order of the enumeration. Words become types here and nowhere else.
inline constexpr std::array<std::string_view, 3> kContactLaws{"elastica", "elastic_ring", "beam_column"};
inline constexpr std::array<std::string_view, 4> kSweeps{"up", "down", "both", "independent"};

inline constexpr std::array<std::string_view, 7> kMethods{"hybrid", "collocation", "hybrid_54", "hybrid_32",
                                                          "paper",  "located",     "fixed"};
inline constexpr std::array<std::string_view, 2> kSettles{"newton", "never"};

constexpr std::span<const std::string_view> words(ContactLaw /*unused*/) {
  return kContactLaws;
}
constexpr std::span<const std::string_view> words(Sweep /*unused*/) {
  return kSweeps;
}
constexpr std::span<const std::string_view> words(Method /*unused*/) {
  return kMethods;
}
constexpr std::span<const std::string_view> words(Settle /*unused*/) {
  return kSettles;
}

template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

template <typename T>
Value to_value(const T& member) {
  if constexpr (std::is_enum_v<T>) {
    return std::string(words(member)[static_cast<std::size_t>(member)]);
  } else {
    return member;
  }
}

template <typename T>
void from_value(T& member, const Value& value) {
  if constexpr (std::is_enum_v<T>) {
    const auto list = words(T{});
    const auto found = std::find(list.begin(), list.end(), std::get<std::string>(value));
    member = static_cast<T>(found - list.begin());
  } else if constexpr (kIsOptional<T>) {
    member = std::get<typename T::value_type>(value);
  } else {
    member = std::get<T>(value);
  }
}

// From a pair of member pointers to the two functions of an entry: At<&Scene::rotor, &Rotor::mass> reads and
// writes scene.rotor.mass, whether section or member are optional or not, and whether the member is a number
// or a choice. With one member pointer, At<&Scene::title>, the value is the scene's own.
template <auto Section, auto... Member>
struct At;

template <auto Section>
struct At<Section> {
  static std::optional<Value> read(const Scene& scene) {
    const auto& member = scene.*Section;
    if constexpr (kIsOptional<std::remove_cvref_t<decltype(member)>>) {
      if (!member) return std::nullopt;
      return to_value(*member);
    } else {
      return to_value(member);
    }
  }
  static void write(Scene& scene, const Value& value) { from_value(scene.*Section, value); }
};

template <auto Section, auto Member>
struct At<Section, Member> {
  static std::optional<Value> read(const Scene& scene) {
    const auto& section = scene.*Section;
    if constexpr (kIsOptional<std::remove_cvref_t<decltype(section)>>) {
      if (!section) return std::nullopt;
      return to_value((*section).*Member);
    } else if constexpr (kIsOptional<std::remove_cvref_t<decltype(section.*Member)>>) {
      if (!(section.*Member)) return std::nullopt;
      return to_value(*(section.*Member));
    } else {
      return to_value(section.*Member);
    }
  }
  static void write(Scene& scene, const Value& value) {
    auto& section = scene.*Section;
    if constexpr (kIsOptional<std::remove_cvref_t<decltype(section)>>) {
      if (!section) section.emplace();
      from_value((*section).*Member, value);
    } else {
      from_value(section.*Member, value);
    }
  }
};

// A quantity that is part of a scene only under some words of a choice: the ring's stiffness, for example, is
// read under the contact law `elastic_ring` only.
template <typename Place, auto Section, auto Member, auto... kReaders>
struct Under : Place {
  static constexpr std::array<std::string_view, sizeof...(kReaders)> kWords{
      words(kReaders)[static_cast<std::size_t>(kReaders)]...};
  static std::optional<Value> read(const Scene& scene) {
    const auto chosen = (scene.*Section).*Member;
    if (!((chosen == kReaders) || ...)) return std::nullopt;
    return Place::read(scene);
  }
};
template <typename Place>
constexpr Quantity in(Quantity entry, Place /*unused*/) {
  entry.read = &Place::read;
  entry.write = &Place::write;
  if constexpr (requires { Place::kWords; }) entry.readers = Place::kWords;
  return entry;
}

}  // namespace rubatlas::settings
