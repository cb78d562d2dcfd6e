#include "shared/stage/caption_file.h"

#include <algorithm>
#include <cmath>

#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::stage {
namespace {

constexpr double kMaxSeconds = 3600.0;
constexpr size_t kMaxCues = 1000;  // Per line.
constexpr size_t kMaxText = 1000;  // Bytes.
constexpr size_t kMaxName = 200;
constexpr size_t kMaxIds = 100'000;
constexpr size_t kMaxBytes = size_t{64} << 20;

void DescribeCue(Fields& fields, CaptionCue& cue) {
  fields.Number("begin", cue.begin, 0.0, kMaxSeconds);
  fields.Number("end", cue.end, 0.0, kMaxSeconds);
  fields.Text("text", cue.text, kMaxText);
}

// Describes {"id": {"language": value}}, where describe(key, value) describes a value.
template <typename T, typename Describe>
void DescribeByLanguage(Fields& fields,
                        std::string_view name,
                        CaptionBook::ById<CaptionBook::ByLanguage<T>>& ids,
                        Describe describe) {
  constexpr std::string_view kNoObject = "must be an object";
  fields.Entries(
      name, ids, kMaxIds, kNoObject,
      [&](const FieldKey& id, CaptionBook::ByLanguage<T>& languages) {
        fields.Entries(id, languages, kMaxIds, kNoObject, [&](const FieldKey& language, T& value) {
          fields.Require(IsLanguageTag(language.name),
                         "\"" + std::string(language.name) + "\" is not a valid language tag",
                         "use one such as \"it\" or \"en-GB\"");
          describe(language, value);
        });
      });
}

void DescribeBook(Fields& fields, CaptionBook& book) {
  fields.Schema(1);
  DescribeByLanguage(fields, "names", book.names, [&](const FieldKey& key, std::string& name) {
    fields.Text(key, name, kMaxName);
  });
  DescribeByLanguage(fields, "lines", book.lines,
                     [&](const FieldKey& key, std::vector<CaptionCue>& cues) {
                       fields.List(key, cues, kMaxCues, DescribeCue);
                       fields.Check(CheckCues(cues, fields.where(key)));
                     });
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
  return ParseFields<CaptionBook>(text, where, DescribeBook, UnknownFields::kIgnore);
}

std::string FormatCaptions(const CaptionBook& book) {
  const Json json = FormatFields(book, DescribeBook);
  return DumpJson(json, 1) + "\n";
}

}  // namespace lararium::stage
