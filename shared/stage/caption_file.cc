#include "shared/stage/caption_file.h"

#include <algorithm>
#include <cmath>

#include "shared/core/json.h"

namespace lararium::stage {
namespace {

constexpr double kMaxSeconds = 3600.0;
constexpr size_t kMaxCues = 1000;  // Per line.
constexpr size_t kMaxText = 1000;  // Bytes.
constexpr size_t kMaxName = 200;
constexpr size_t kMaxIds = 100'000;
constexpr size_t kMaxBytes = size_t{64} << 20;

Result<CaptionCue> ReadCue(const JsonView& view) {
  CaptionCue cue;
  LARARIUM_ASSIGN_OR_RETURN(cue.begin, view.Number("begin", 0.0, kMaxSeconds));
  LARARIUM_ASSIGN_OR_RETURN(cue.end, view.Number("end", 0.0, kMaxSeconds));
  LARARIUM_ASSIGN_OR_RETURN(cue.text, view.Text("text", kMaxText));
  return cue;
}

Result<std::vector<CaptionCue>> ReadCues(const JsonView& view) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, view.Array(kMaxCues));
  std::vector<CaptionCue> cues;
  for (const JsonView& item : list) {
    LARARIUM_ASSIGN_OR_RETURN(cues.emplace_back(), ReadCue(item));
  }
  LARARIUM_RETURN_IF_ERROR(CheckCues(cues, view.place()));
  return cues;
}

Result<std::string> ReadName(const JsonView& view) { return view.Text(kMaxName); }

// Reads {"id": {"language": value}} from the field `key`.
template <typename T>
Result<CaptionBook::ById<CaptionBook::ByLanguage<T>>> ReadByLanguage(
    const JsonView& root, std::string_view key, Result<T> (*read)(const JsonView&)) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, root.Field(key));
  if (!field.json().is_object() || field.json().size() > kMaxIds) {
    return field.Problem("must be an object");
  }
  CaptionBook::ById<CaptionBook::ByLanguage<T>> ids;
  for (const auto& [id, ignored] : field.json().items()) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView languages, field.Field(id));
    if (!languages.json().is_object()) {
      return languages.Problem("must be an object");
    }
    for (const auto& [language, ignored_too] : languages.json().items()) {
      if (!IsLanguageTag(language)) {
        return languages.Problem("\"" + language + "\" is not a valid language tag",
                                 "use one such as \"it\" or \"en-GB\"");
      }
      LARARIUM_ASSIGN_OR_RETURN(const JsonView value, languages.Field(language));
      LARARIUM_ASSIGN_OR_RETURN(ids[id][language], read(value));
    }
  }
  return ids;
}

}  // namespace

bool IsLanguageTag(std::string_view tag) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return tag.size() >= 2 && tag.size() <= 16 && is_letter(tag[0]) && is_letter(tag[1]) &&
         tag.back() != '-' && std::all_of(tag.begin(), tag.end(), [&](char c) {
           return is_letter(c) || (c >= '0' && c <= '9') || c == '-';
         });
}

Status CheckCues(const std::vector<CaptionCue>& cues, const std::string& place) {
  double before = 0.0;
  for (size_t i = 0; i < cues.size(); ++i) {
    const CaptionCue& cue = cues[i];
    const std::string where = place + "[" + std::to_string(i) + "]";
    if (!(cue.begin >= before) || !(cue.end > cue.begin) || !std::isfinite(cue.end)) {
      return Status::Error(where, "its time is empty or overlaps the caption before it");
    }
    if (cue.text.empty() || std::count(cue.text.begin(), cue.text.end(), '\n') > 1) {
      return Status::Error(where, "it must have one or two lines of text");
    }
    before = cue.end;
  }
  return Status();
}

Result<CaptionBook> ParseCaptions(std::string_view text, const std::string& where) {
  if (text.size() > kMaxBytes) {
    return Status::Error(where, "is longer than 64 MiB");
  }
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, where));
  const JsonView root(json, where);
  LARARIUM_RETURN_IF_ERROR(root.Integer("schema", 1, 1).status());
  CaptionBook book;
  LARARIUM_ASSIGN_OR_RETURN(book.names, ReadByLanguage(root, "names", ReadName));
  LARARIUM_ASSIGN_OR_RETURN(book.lines, ReadByLanguage(root, "lines", ReadCues));
  return book;
}

std::string FormatCaptions(const CaptionBook& book) {
  Json json = {{"schema", 1}, {"names", Json::object()}, {"lines", Json::object()}};
  for (const auto& [id, languages] : book.names) {
    for (const auto& [language, name] : languages) {
      json["names"][id][language] = name;
    }
  }
  for (const auto& [id, languages] : book.lines) {
    for (const auto& [language, cues] : languages) {
      Json& list = json["lines"][id][language] = Json::array();
      for (const CaptionCue& cue : cues) {
        list.push_back({{"begin", cue.begin}, {"end", cue.end}, {"text", cue.text}});
      }
    }
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lararium::stage
