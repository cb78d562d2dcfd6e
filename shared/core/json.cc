#include "shared/core/json.h"

#include <algorithm>
#include <cmath>

#include "shared/core/file.h"
#include "shared/core/plain_text.h"
#include "shared/core/utf8.h"

template class nlohmann::basic_json<>;

namespace lararium {
namespace {

// The bytes 0x80 to 0xff of a string stand as U+EF80 to U+EFFF: EE BE 80 to EE BF BF in UTF-8. A
// string that holds such a character has its bytes replaced too, so that both ways are unique.
constexpr std::string_view kEscapes = "\xee\xbe";
constexpr std::string_view kMoreEscapes = "\xee\xbf";

bool MayHoldEscapes(std::string_view text) {
  return text.find(kEscapes) != std::string_view::npos ||
         text.find(kMoreEscapes) != std::string_view::npos ||
         text.find("\\uef") != std::string_view::npos ||  // Some programs write ASCII only.
         text.find("\\uEF") != std::string_view::npos;
}

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (size_t at = 0; at < text.size();) {
    size_t next = at;
    NextCharacter(text, next);
    const std::string_view character = text.substr(at, next - at);
    if (IsUtf8(character) && !MayHoldEscapes(character)) {
      escaped += character;
    } else {
      for (const char byte : character) {
        const auto value = static_cast<unsigned char>(byte);
        escaped += {'\xee', static_cast<char>(0xbc + (value >> 6)),
                    static_cast<char>(0x80 + (value & 0x3f))};
      }
    }
    at = next;
  }
  return escaped;
}

std::string Unescaped(std::string_view text) {
  std::string bytes;
  for (size_t at = 0; at < text.size(); ++at) {
    const std::string_view next = text.substr(at, 2);
    if ((next == kEscapes || next == kMoreEscapes) && at + 2 < text.size()) {
      const auto high = static_cast<unsigned char>(text[at + 1]);
      const auto low = static_cast<unsigned char>(text[at + 2]);
      bytes += static_cast<char>((high - 0xbc) << 6 | (low & 0x3f));
      at += 2;
    } else {
      bytes += text[at];
    }
  }
  return bytes;
}

// Changes all strings, the names of fields included. Foreign JSON may be nested deeper than the
// stack is.
void ChangeStrings(Json& json, std::string (*change)(std::string_view)) {
  std::vector<Json*> left = {&json};
  while (!left.empty()) {
    Json& value = *left.back();
    left.pop_back();
    if (value.is_string()) {
      value = change(value.get_ref<const std::string&>());
    } else if (value.is_array()) {
      for (Json& item : value) {
        left.push_back(&item);
      }
    } else if (value.is_object()) {
      Json::object_t changed;
      for (auto& [key, field] : value.get_ref<Json::object_t&>()) {
        changed[change(key)] = std::move(field);
      }
      value.get_ref<Json::object_t&>() = std::move(changed);
      for (Json& field : value) {
        left.push_back(&field);
      }
    }
  }
}

}  // namespace

Result<Json> ParseJson(std::string_view text, std::string_view where) {
  try {
    Json json = LooksLikeUtf16(text) ? Json::parse(PlainText(std::string(text)))
                                     : Json::parse(WithoutByteOrderMark(text));
    if (MayHoldEscapes(text)) {
      ChangeStrings(json, Unescaped);
    }
    return json;
  } catch (const Json::exception& error) {
    // The library's text starts with an identifier in brackets, which is removed.
    std::string_view what = error.what();
    if (const size_t end = what.find("] "); end != std::string_view::npos) {
      what.remove_prefix(end + 2);
    }
    return Status::Error(where, "not valid JSON: " + std::string(what));
  }
}

Result<Json> LoadJson(const std::filesystem::path& path) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(path, 256 << 20));
  return ParseJson(text, path.string());
}

std::string DumpJson(const Json& json, int indent) {
  try {
    std::string text = json.dump(indent);
    if (!MayHoldEscapes(text)) {
      return text;
    }
  } catch (const Json::exception&) {
    // A string is no UTF-8.
  }
  Json escaped = json;
  ChangeStrings(escaped, Escaped);
  return escaped.dump(indent);
}

Status SaveJson(const std::filesystem::path& path, const Json& json) {
  return WriteFileAtomically(path, DumpJson(json, 1) + "\n");
}

Status JsonView::CheckFields(std::span<const std::string_view> known) const {
  if (!json_->is_object()) {
    return Problem("must be an object");
  }
  for (const auto& [key, value] : json_->items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      std::string names;
      for (const std::string_view name : known) {
        names += (names.empty() ? "" : ", ") + std::string(name);
      }
      return Problem(
          "the field \"" + key + "\" is not known",
          "correct its spelling (known are " + names + "), or use a newer version of Lararium");
    }
  }
  return Status();
}

bool JsonView::Has(std::string_view key) const {
  return json_->is_object() && json_->contains(key);
}

Result<JsonView> JsonView::Field(std::string_view key) const {
  if (!json_->is_object()) {
    return Problem("must be an object");
  }
  const auto found = json_->find(key);
  if (found == json_->end()) {
    return Problem("the field \"" + std::string(key) + "\" is missing");
  }
  return JsonView(*found, file_, (path_.empty() ? "" : path_ + ".") + std::string(key));
}

Result<std::vector<JsonView>> JsonView::Array(size_t max_count) const {
  if (!json_->is_array()) {
    return Problem("must be a list");
  }
  if (json_->size() > max_count) {
    return Problem("has more than the " + std::to_string(max_count) + " entries that are allowed");
  }
  std::vector<JsonView> views;
  views.reserve(json_->size());
  for (size_t i = 0; i < json_->size(); ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    views.push_back(path_.empty() ? JsonView((*json_)[i], file_ + index)
                                  : JsonView((*json_)[i], file_, path_ + index));
  }
  return views;
}

Result<double> JsonView::Number(double min, double max) const {
  if (!json_->is_number() || !std::isfinite(json_->get<double>())) {
    return Problem("must be a finite number");
  }
  const double value = json_->get<double>();
  if (value < min || value > max) {
    return Problem("must lie between " + std::to_string(min) + " and " + std::to_string(max));
  }
  return value;
}

Result<int64_t> JsonView::Integer(int64_t min, int64_t max) const {
  const bool fits = json_->is_number_integer() &&
                    !(json_->is_number_unsigned() &&
                      json_->get<uint64_t>() > uint64_t{std::numeric_limits<int64_t>::max()});
  if (!fits || json_->get<int64_t>() < min || json_->get<int64_t>() > max) {
    return Problem("must be a whole number from " + std::to_string(min) + " to " +
                   std::to_string(max));
  }
  return json_->get<int64_t>();
}

Result<bool> JsonView::Boolean() const {
  if (!json_->is_boolean()) {
    return Problem("must be true or false");
  }
  return json_->get<bool>();
}

Result<std::string> JsonView::Text(size_t max_bytes) const {
  if (!json_->is_string()) {
    return Problem("must be a text");
  }
  auto text = json_->get<std::string>();
  if (text.size() > max_bytes) {
    return Problem("is longer than the " + std::to_string(max_bytes) + " bytes that are allowed");
  }
  return text;
}

Result<std::vector<double>> JsonView::Numbers(size_t count) const {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> items, Array());
  if (items.size() != count) {
    return Problem("must be a list of " + std::to_string(count) + " numbers");
  }
  std::vector<double> numbers;
  for (const JsonView& item : items) {
    LARARIUM_ASSIGN_OR_RETURN(const double number, item.Number());
    numbers.push_back(number);
  }
  return numbers;
}

Result<double> JsonView::Number(std::string_view key, double min, double max) const {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, Field(key));
  return field.Number(min, max);
}

Result<int64_t> JsonView::Integer(std::string_view key, int64_t min, int64_t max) const {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, Field(key));
  return field.Integer(min, max);
}

Result<std::string> JsonView::Text(std::string_view key, size_t max_bytes) const {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, Field(key));
  return field.Text(max_bytes);
}

Result<std::vector<double>> JsonView::Numbers(std::string_view key, size_t count) const {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, Field(key));
  return field.Numbers(count);
}

}  // namespace lararium
