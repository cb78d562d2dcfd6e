#include "editor/check/line_checks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "editor/bake/caption_layout.h"
#include "editor/document/check_sentences.h"
#include "editor/jobs/caption_glyphs.h"
#include "editor/text/text.h"
#include "shared/core/file.h"
#include "shared/drama/lua_tokens.h"
#include "shared/drama/timeline_text.h"
#include "shared/stage/viseme_file.h"

namespace lararium::editor {
namespace {

// Captions are designed for 17 letters per second; no one can read faster than this.
constexpr double kFastestReading = 24.0;

bool Has(const std::vector<std::string>& list, std::string_view item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

struct WrittenLine {
  std::string id;
  size_t offset = 0;
  bool described = false;
};

// Finds name:say("id") and name:say "id", describe("id") and describe "id".
std::vector<WrittenLine> FindSayings(const std::string& script) {
  std::vector<WrittenLine> found;
  drama::LuaTokens tokens(script);
  bool colon = false, say = false, describe = false;
  for (drama::LuaToken token = tokens.Next();
       token.kind != drama::LuaToken::Kind::kEnd && token.kind != drama::LuaToken::Kind::kBad;
       token = tokens.Next()) {
    const std::string_view text =
        std::string_view(script).substr(token.begin, token.end - token.begin);
    if ((say || describe) && token.kind == drama::LuaToken::Kind::kText) {
      if (const std::optional<std::string> id = drama::TextOf(text)) {
        found.push_back({*id, token.begin, describe});
      }
    }
    say = (colon && text == "say") || (say && token.Is('('));
    describe = (!colon && text == "describe") || (describe && token.Is('('));
    colon = token.Is(':');
  }
  return found;
}

// The problem with a line that the script names; nullopt if there is none.
std::optional<Sentence> ProblemOf(const ProjectDocument& document,
                                  const ProjectLines& lines,
                                  const std::string& id,
                                  bool described) {
  const bake::Line* line = lines.table.Find(id);
  if (line == nullptr) {
    return Sentence("there is no line '%s'; add it to lines.csv", {id});
  }
  if (described && !ProjectLines::Describes(*line, document)) {
    return Sentence("the line '%s' is described, so its speaker must be 'description'", {id});
  }
  return std::nullopt;
}

// The longest duration of a line in the spoken languages.
std::optional<double> SecondsOf(std::span<const SpokenLine> spoken, std::string_view id) {
  std::optional<double> longest;
  for (const SpokenLine& line : spoken) {
    if (line.line->id != id) {
      continue;
    }
    const Result<std::string> text = ReadText(line.visemes);
    const auto track = text.ok() ? stage::ParseVisemes(*text, line.visemes.string())
                                 : Result<human::VisemeTrack>(text.status());
    if (track.ok()) {
      longest = std::max(longest.value_or(0.0), static_cast<double>(track->duration));
    }
  }
  return longest;
}

// Locations of lines in their file: "lines.csv:12: line 'salvete'".
class LinePlaces {
 public:
  explicit LinePlaces(const std::filesystem::path& folder) {
    for (const char* name : {"lines.csv", "lines.json"}) {
      if (const Result<std::string> text = ReadText(folder / name); text.ok()) {
        file_ = name;
        text_ = *text;
      }
    }
  }

  Sentence Of(const std::string& id) const {
    size_t row = 1;
    for (size_t begin = 0; begin < text_.size(); ++row) {
      const size_t end = std::min(text_.find('\n', begin), text_.size());
      if (IsRowOf(std::string_view(text_).substr(begin, end - begin), id)) {
        return Sentence("%s: line '%s'", {file_ + ":" + std::to_string(row), id});
      }
      begin = end + 1;
    }
    return Sentence("%s: line '%s'", {file_, id});
  }

 private:
  // Ids contain no characters that require quotes.
  bool IsRowOf(std::string_view row, const std::string& id) const {
    if (file_ == "lines.json") {
      return row.find("\"id\": \"" + id + "\"") != std::string_view::npos;
    }
    const size_t quote = row.starts_with('"') ? 1 : 0;
    const bool begins = row.substr(quote).starts_with(id);
    const size_t next = quote + id.size();
    return begins && next < row.size() &&
           std::string_view(",;\t\"").find(row[next]) != std::string_view::npos;
  }

  std::string file_ = "lines";
  std::string text_;
};

void CheckTexts(const LinePlaces& places,
                const ProjectDocument& document,
                const ProjectLines& lines,
                std::vector<Sentence>& problems) {
  std::set<std::string> cast;
  for (const CastDocument& member : document.cast) {
    cast.insert(member.name);
  }
  for (const bake::Line& line : lines.table.lines) {
    const Sentence where = places.Of(line.id);
    const bool name = ProjectLines::IsName(line, document);
    const bool describes = ProjectLines::Describes(line, document);
    if (!name && line.speaker.empty()) {
      problems.push_back(
          AtPlace(where, Sentence("it has no speaker; it is spoken in the plain voice")));
    } else if (!name && !describes && !cast.contains(line.speaker)) {
      problems.push_back(
          AtPlace(where, Sentence("no person of the cast is called '%s'", {line.speaker})));
    }
    for (const std::string& language : lines.table.languages) {
      const bool spoken = !name && !describes && Has(lines.spoken, language);
      const bool read = Has(lines.captions, language);
      if ((spoken || read) && !line.text.contains(language)) {
        problems.push_back(AtPlace(
            where, spoken ? Sentence("it has no text in '%s', which is spoken", {language})
                          : Sentence("it has no text in '%s', which is a language of captions",
                                     {language})));
      }
    }
  }
}

}  // namespace

void LineListener::Listen(double time) {
  stage_.Capture(snapshot_);
  for (const auto& [actor, state] : snapshot_.actors) {
    const auto known = std::find_if(open_.begin(), open_.end(),
                                    [id = actor](const Open& open) { return open.actor == id; });
    const stage::Utterance& now = state.utterance;
    if (known != open_.end()) {
      const stage::Utterance& before = known->utterance;
      SaidLine& said = said_[known->said];
      if (now.line == before.line && now.ticks > before.ticks && now.speaking) {
        known->utterance = now;
        said.seconds = stage::Stage::UtteredSeconds(now);
        continue;
      }
      const double whole = stage_.SpeechSeconds(before.line);
      const bool ended = now.line == before.line && now.ticks > before.ticks;
      said.seconds = ended ? whole : said.seconds;
      said.cut = !ended && said.seconds < whole - 2.0 * stage::Stage::kTickSeconds;
      open_.erase(known);
    }
    if (now.speaking) {
      const double begin = time - stage::Stage::UtteredSeconds(now);
      said_.push_back({content_.speech[static_cast<size_t>(now.line)].name,
                       stage_.Find(actor)->name, std::max(begin, 0.0)});
      open_.push_back({actor, now, said_.size() - 1});
    }
  }
}

DescriptionListener::DescriptionListener(const stage::Stage& stage,
                                         const show::ShowContent& content,
                                         std::map<std::string, double> longest)
    : stage_(stage), content_(content), longest_(std::move(longest)) {}

const std::string& DescriptionListener::NameOf(int line) const {
  return content_.speech[static_cast<size_t>(line)].name;
}

void DescriptionListener::Tell(Sentence problem, double time) {
  problems_.push_back(AtTime(std::move(problem), time));
}

void DescriptionListener::Listen(double time) {
  const stage::StageDescription& now = stage_.description();
  const bool begins = now.heard.speaking && now.heard.ticks == 0;
  if (begins) {
    const std::string& name = NameOf(now.heard.line);
    const auto longest = longest_.find(name);
    described_.insert(name);
    last_ = name;
    ends_ =
        time + (longest != longest_.end() ? longest->second : stage_.SpeechSeconds(now.heard.line));
  }
  if (waiting_ >= 0 && now.waiting != waiting_ && !(begins && now.heard.line == waiting_)) {
    Tell(Sentence("the description '%s' finds no pause in the speech", {NameOf(waiting_)}), time);
  }
  waiting_ = now.waiting;
  for (const stage::ActorId id : stage_.actors()) {
    const stage::Actor& actor = *stage_.Find(id);
    const stage::Utterance& said = actor.state.utterance;
    if (said.speaking && said.ticks == 0 && time < ends_) {
      Tell(Sentence("'%s' says '%s' over the description '%s', which lasts %s more in its longest "
                    "language",
                    {actor.name, NameOf(said.line), last_, SecondsText(ends_ - time)}),
           time);
    }
  }
}

std::map<std::string, double> LongestDescriptions(const ProjectPaths& paths,
                                                  const ProjectDocument& document,
                                                  const ProjectLines& lines) {
  std::map<std::string, double> longest;
  const auto spoken = SpokenLines(paths, document, lines);
  for (const bake::Line& line : lines.table.lines) {
    if (spoken.ok() && ProjectLines::Describes(line, document)) {
      if (const std::optional<double> seconds = SecondsOf(*spoken, line.id)) {
        longest[line.id] = *seconds;
      }
    }
  }
  return longest;
}

std::vector<Sentence> CheckScriptLines(const ProjectPaths& paths,
                                       const ProjectDocument& document,
                                       const ProjectLines& lines,
                                       std::span<const SpokenLine> spoken,
                                       const std::string& script) {
  std::vector<Sentence> problems;
  const std::string file = paths.Drama().filename().string();
  for (const WrittenLine& written : FindSayings(script)) {
    if (auto problem = ProblemOf(document, lines, written.id, written.described)) {
      const drama::LuaPosition position = drama::PositionOf(script, written.offset);
      problems.push_back(AtPlace(file + ":" + std::to_string(position.line), *std::move(problem)));
    }
  }
  const auto timeline = drama::TimelineText::Read(script, file);
  if (!timeline.ok()) {
    return problems;  // Running the script reports the error.
  }
  for (size_t l = 0; l < timeline->lanes().size(); ++l) {
    const drama::TimelineLane& lane = timeline->lanes()[l];
    const drama::LineUse use = drama::SpecOf(lane.kind).line;
    const bool described = use == drama::LineUse::kDescription;
    for (size_t i = 0; (described || use == drama::LineUse::kSpoken) && i < lane.size(); ++i) {
      const std::optional<Json> id = timeline->Field({l, i}, "line");
      if (!id || !id->is_string()) {
        continue;
      }
      const std::string where = file + ":" + std::to_string(timeline->LineOf({l, i}));
      if (auto problem = ProblemOf(document, lines, id->get<std::string>(), described)) {
        problems.push_back(AtPlace(where, *std::move(problem)));
      }
      const std::optional<double> seconds = SecondsOf(spoken, id->get<std::string>());
      if (seconds && lane.length[i] > 0.0 && *seconds > lane.length[i] + 0.01) {
        problems.push_back(AtPlace(where, Sentence("the line '%s' lasts %s, its item %s",
                                                   {id->get<std::string>(), SecondsText(*seconds),
                                                    SecondsText(lane.length[i])})));
      }
    }
  }
  return problems;
}

std::vector<Sentence> CheckTable(const ProjectPaths& paths,
                                 const ProjectDocument& document,
                                 const ProjectLines& lines,
                                 std::span<const SpokenLine> spoken) {
  std::vector<Sentence> problems;
  CheckTexts(LinePlaces(paths.folder), document, lines, problems);
  for (const std::string& language : lines.spoken) {
    const Result<stage::CaptionBook> book = MakeCaptions(document, lines, spoken, language);
    if (!book.ok()) {
      problems.push_back(book.message());
      continue;
    }
    for (const auto& [id, languages] : book->lines) {
      for (const auto& [captions, cues] : languages) {
        const double speed = bake::ReadingSpeed(cues);
        if (speed > kFastestReading) {
          problems.push_back(AtPlace(
              Sentence("%s: line '%s'", {std::string("lines"), id}),
              Sentence("its captions in '%s' leave time for %s letters a second where it is said "
                       "in '%s'; shorten them",
                       {captions, Text("%.0f", speed), language})));
        }
      }
    }
  }
  for (const std::string& language : lines.captions) {
    if (const auto book = MakeDescriptions(spoken, language); !book.ok()) {
      problems.push_back(book.message());
    }
  }
  if (!lines.captions.empty()) {
    if (const auto font = MakeCaptionFont(lines, spoken, {}, problems); !font.ok()) {
      problems.push_back(font.message());
    }
  }
  return problems;
}

std::vector<Sentence> CheckSaid(const ProjectPaths& paths,
                                const ProjectLines& lines,
                                const std::vector<SaidLine>& said,
                                std::span<const drama::TaskRecord> tasks) {
  std::vector<Sentence> problems;
  const auto where = [&](const SaidLine& line) {
    const auto told = std::find_if(tasks.begin(), tasks.end(), [&](const drama::TaskRecord& task) {
      return task.actor == line.actor && task.action == "say " + line.line &&
             std::abs(task.began - line.begin) < 2.0 * stage::Stage::kTickSeconds;
    });
    return told == tasks.end() ? paths.Drama().filename().string() : told->where;
  };
  for (const SaidLine& line : said) {
    const std::string file = where(line);
    const bake::Line* known = lines.table.Find(line.line);
    if (known != nullptr && !known->speaker.empty() && known->speaker != line.actor) {
      Sentence other = Sentence("'%s' says '%s', which has the voice of '%s'",
                                {line.actor, line.line, known->speaker});
      problems.push_back(AtPlace(file, AtTime(std::move(other), line.begin)));
    }
    if (line.cut) {
      Sentence cut = Sentence("'%s' does not finish '%s'", {line.actor, line.line});
      problems.push_back(AtPlace(file, AtTime(std::move(cut), line.begin + line.seconds)));
    }
  }
  return problems;
}

}  // namespace lararium::editor
