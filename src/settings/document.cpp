#include "settings/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "settings/reader.hpp"

namespace rubatlas::settings {
namespace {

using nlohmann::json;

// A scene is three levels deep. The limit keeps a hostile file from exhausting the stack where trees are
// printed.
constexpr std::size_t kDeepest = 16;

std::string place(std::string_view text, std::string_view name, std::size_t position) {
  const auto before = text.substr(0, std::min(position, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const auto line_start = before.rfind('\n');
  const auto column = before.size() - (line_start == std::string_view::npos ? 0 : line_start + 1);
  return fmt::format("{}:{}:{}", name, line, std::max<std::size_t>(column, 1));
}

// Builds the tree and refuses duplicate keys and deep nesting, which a plain parse would accept.
class TreeBuilder final : public nlohmann::json_sax<json> {
 public:
  TreeBuilder(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& /*value*/) override { return false; }  // not part of JSON text

  bool start_object(std::size_t /*size*/) override { return open(json::object()); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t /*size*/) override { return open(json::array()); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    key_ = value;
    if (open_.back()->contains(value)) {
      throw SceneError(fmt::format("{}: the key stands twice in its section; once is allowed",
                                   in_short(child(pointer(), value))));
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token, const json::exception& error) override {
    constexpr int kNumberOverflow = 406;  // number of this error in the library
    if (error.id == kNumberOverflow) {
      throw SceneError(fmt::format("{}: {} is more than a number of double precision can be; up to {:.2g}",
                                   here().empty() ? "/" : here(), in_short(token),
                                   std::numeric_limits<double>::max()));
    }
    // The library's text is "[json.exception...] parse error at line 1, column 2: what is wrong".
    std::string_view what = error.what();
    if (const auto tag = what.find("] "); tag != std::string_view::npos) what.remove_prefix(tag + 2);
    if (const auto column = what.find("column ");
        what.starts_with("parse error at ") && column != std::string_view::npos) {
      if (const auto end = what.find(": ", column); end != std::string_view::npos)
        what.remove_prefix(end + 2);
    }
    throw SceneError(fmt::format("{}: not JSON: {}", place(text_, name_, position), in_short(what)));
  }

 private:
  [[nodiscard]] std::string pointer() const {
    std::string result;
    for (const auto& part : path_) result += part;
    return result;
  }

  /// Pointer of the value that comes next.
  [[nodiscard]] std::string here() const {
    if (open_.empty()) return {};
    return pointer() +
           (open_.back()->is_array() ? fmt::format("/{}", open_.back()->size()) : child("", key_));
  }

  json* insert(json&& value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    json& parent = *open_.back();
    if (parent.is_array()) return &parent.emplace_back(std::move(value));
    return &(parent[key_] = std::move(value));
  }

  bool add(json&& value) {
    insert(std::move(value));
    return true;
  }

  bool open(json&& value) {
    if (open_.size() == kDeepest) {
      throw SceneError(
          fmt::format("{}: nested {} levels deep; a scene has at most 3", in_short(pointer()), kDeepest + 1));
    }
    std::string part;
    if (!open_.empty()) {
      part = open_.back()->is_array() ? fmt::format("/{}", open_.back()->size()) : child("", key_);
    }
    open_.push_back(insert(std::move(value)));
    path_.push_back(std::move(part));
    return true;
  }

  bool close() {
    open_.pop_back();
    path_.pop_back();
    return true;
  }

  std::string_view text_;
  std::string_view name_;
  json root_;
  std::vector<json*> open_;        // containers from the root to the one being filled
  std::vector<std::string> path_;  // reference tokens of these containers
  std::string key_;
};

constexpr std::size_t kLongestShown = 60;  // [bytes]

std::string cut(std::string_view text) {
  if (text.size() <= kLongestShown) return std::string(text);
  std::size_t end = kLongestShown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
    --end;  // do not cut inside a UTF-8 character
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace

json parse_document(std::string_view text, std::string_view name) {
  // The parser takes a NUL byte for the end of the text, and would silently ignore what follows it.
  if (const auto nul = text.find('\0'); nul != std::string_view::npos) {
    throw SceneError(fmt::format("{}: not JSON: a NUL byte", place(text, name, nul + 1)));
  }
  // The library's versions place this error differently.
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw SceneError(fmt::format("{}: not JSON: the text is empty", place(text, name, 1)));
  }
  TreeBuilder builder(text, name);
  json::sax_parse(text, &builder);
  return builder.take();
}

std::string child(std::string_view pointer, std::string_view key) {
  std::string written;
  for (const char letter : key) {
    const auto code = static_cast<unsigned char>(letter);
    written += code < 0x20 || code == 0x7F ? fmt::format("\\u{:04x}", code) : std::string(1, letter);
  }
  return (json::json_pointer(std::string(pointer)) / written).to_string();
}

std::string shortest(double value) {
  return fmt::format("{}", value);
}

std::string shown(const json& value) {
  return cut(value.is_number_float() ? shortest(value.get<double>()) : value.dump());
}

std::string_view last_key(std::string_view pointer) {
  return pointer.substr(pointer.rfind('/') + 1);
}

void fail(std::string_view pointer, std::string_view text) {
  throw SceneError(in_short(fmt::format("{}: {}", pointer.empty() ? "/" : pointer, text)));
}

std::string in_short(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto end = std::min(text.find(' '), text.size() - 1) + 1;  // a word and the blank that follows it
    const auto word = text.substr(0, end);
    result += word.size() <= 2 * kLongestShown ? std::string(word) : cut(word);
    if (word.size() > 2 * kLongestShown && word.back() == ' ') result += ' ';
    text.remove_prefix(end);
  }
  return result;
}

}  // namespace rubatlas::settings
