/// From JSON text to a tree, stricter than the JSON standard: duplicate keys, NUL bytes, nesting deeper than
/// that of any scene, and numbers too large for a double are refused. Also numbers, keys and pointers as
/// texts for messages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace rubatlas::settings {

/// Throws SceneError: "NAME:LINE:COLUMN: what is wrong" for broken JSON, "/pointer: ..." for a duplicate key.
nlohmann::json parse_document(std::string_view text, std::string_view name);

/// `pointer` with one more reference token, escaped as RFC 6901 asks.
std::string child(std::string_view pointer, std::string_view key);

/// The last reference token of a pointer.
std::string_view last_key(std::string_view pointer);

/// Throws SceneError: what is wrong at a pointer.
[[noreturn]] void fail(std::string_view pointer, std::string_view text);

/// A value as short JSON text, for messages: cut after some 60 characters.
std::string shown(const nlohmann::json& value);

/// A sentence in which words longer than a line, such as numbers of thousands of digits, are cut after some
/// 60 characters.
std::string in_short(std::string_view text);

/// Shortest decimal text that reads back as the same double.
std::string shortest(double value);

}  // namespace rubatlas::settings
