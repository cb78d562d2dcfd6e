#include "editor/jobs/credits.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "editor/bake/caption_font.h"
#include "editor/bake/speech_synthesis.h"
#include "editor/document/named_entries.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/paradata.h"

namespace lararium::editor {
namespace {

// Groups equal texts and collects the names that share them, in the order in which the texts were
// added.
class Grouped {
 public:
  void Add(const std::string& said, const std::string& of) {
    const auto found = std::find_if(groups_.begin(), groups_.end(),
                                    [&](const Group& group) { return group.said == said; });
    Group& group = found == groups_.end() ? groups_.emplace_back(Group{said, {}}) : *found;
    if (std::find(group.of.begin(), group.of.end(), of) == group.of.end()) {
      group.of.push_back(of);
    }
  }

  struct Group {
    std::string said;
    std::vector<std::string> of;
  };
  const std::vector<Group>& groups() const { return groups_; }

 private:
  std::vector<Group> groups_;
};

// Adds each line of the credits of a person or an object.
void AddRows(const std::string& credits, const std::string& of, Grouped& grouped) {
  for (size_t begin = 0; begin < credits.size();) {
    const size_t end = std::min(credits.find('\n', begin), credits.size());
    if (end > begin) {
      grouped.Add(credits.substr(begin, end - begin), of);
    }
    begin = end + 1;
  }
}

// Splits a line of the cast library's parts: "what: author; licence".
Json FormatAsset(const Grouped::Group& group) {
  Json json = {{"credit", group.said}, {"of", group.of}};
  const size_t colon = group.said.find(": ");
  const size_t semicolon = group.said.rfind("; ");
  if (colon != std::string::npos && semicolon != std::string::npos && colon < semicolon) {
    json["what"] = group.said.substr(0, colon);
    json["author"] = group.said.substr(colon + 2, semicolon - colon - 2);
    json["licence"] = group.said.substr(semicolon + 2);
  }
  return json;
}

class CreditsMaker {
 public:
  CreditsMaker(const ProjectPaths& paths, const ProjectDocument& document)
      : paths_(paths), document_(document) {
    credits_.text = document.title + "\n";
    credits_.json = {{"title", document.title}, {"credits", document.credits}};
    if (!document.credits.empty()) {
      credits_.text += document.credits + (document.credits.ends_with('\n') ? "" : "\n");
    }
  }

  Status AddAssets() {
    Grouped people;
    for (const CastDocument& member : document_.cast) {
      LARARIUM_ASSIGN_OR_RETURN(const human::Human human, LoadBakedHuman(paths_, member));
      AddRows(human.credits, member.name, people);
    }
    WriteAssets("People", "people", people);
    Grouped objects;
    for (const ObjectDocument& object : document_.objects) {
      LARARIUM_ASSIGN_OR_RETURN(const stage::Prop prop, LoadBakedProp(paths_, object));
      AddRows(prop.credits, object.name, objects);
    }
    WriteAssets("Objects", "objects", objects);
    return Status();
  }

  // Mentions only fonts that are drawn and voices that are heard.
  Status AddSpeech(const stage::Paradata& paradata) {
    LARARIUM_ASSIGN_OR_RETURN(const ProjectLines lines, LoadProjectLines(paths_, document_));
    LARARIUM_ASSIGN_OR_RETURN(const auto spoken, SpokenLines(paths_, document_, lines));
    Grouped voices;
    for (const SpokenLine& line : spoken) {
      const std::string& speaker = line.line->speaker;
      const std::string of =
          (speaker.empty() ? line.line->id : speaker) + " (" + line.language + ")";
      voices.Add(line.source.recording.empty() ? bake::SynthesizerCredits()
                                               : "recorded: " + AuthorOf(paradata, *line.line),
                 of);
    }
    WriteGroups("Voices", "voices", voices);
    if (!lines.captions.empty() || !paradata.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(const bake::FontCredits font,
                                bake::ReadFontCredits(bake::CaptionFontFile()));
      credits_.text +=
          "\nLetters\n  " + font.name + ": " + font.copyright + "; " + font.licence + "\n";
      credits_.json["fonts"] = Json::array(
          {{{"name", font.name}, {"copyright", font.copyright}, {"licence", font.licence}}});
    }
    return Status();
  }

  void AddClaims(const stage::Paradata& paradata) {
    Grouped authors;
    Json counts = Json::object();
    std::map<std::string, std::vector<std::string>> named;  // Keyed by source.
    for (size_t kind = 0; kind < stage::kSubjectCount; ++kind) {
      const std::string subject(NameOf(static_cast<stage::Subject>(kind)));
      for (const auto& [name, claim] : paradata.claims[kind]) {
        const std::string of = subject + " " + name;
        const std::string& author = claim.author.empty() ? paradata.author : claim.author;
        const std::string& licence = claim.licence.empty() ? paradata.licence : claim.licence;
        if (!author.empty() || !licence.empty()) {
          authors.Add(author + (author.empty() || licence.empty() ? "" : "; ") + licence, of);
        }
        for (const std::string& source : claim.sources) {
          named[source].push_back(of);
        }
        if (claim.certainty != stage::Certainty::kUnsaid) {
          Json& count = counts[std::string(NameOf(claim.certainty))];
          count = count.is_null() ? 1 : count.get<int>() + 1;
        }
      }
    }
    WriteGroups("Reconstruction", "claims", authors);
    credits_.json["certainty"] = counts;
    credits_.json["sources"] = Json::array();
    credits_.text += named.empty() ? "" : "\nSources\n";
    for (const auto& [key, of] : named) {
      const std::string& reference = paradata.sources.find(key)->second;
      credits_.text += "  " + reference + " (" + JoinNames(of) + ")\n";
      credits_.json["sources"].push_back({{"key", key}, {"reference", reference}, {"of", of}});
    }
  }

  Credits Take() { return std::move(credits_); }

 private:
  static std::string AuthorOf(const stage::Paradata& paradata, const bake::Line& line) {
    const stage::Claim* claim = paradata.Find(stage::Subject::kLine, line.id);
    const std::string& author =
        claim != nullptr && !claim->author.empty() ? claim->author : paradata.author;
    return author.empty() ? "nobody is named" : author;
  }

  void WriteText(const std::string& title, const Grouped& grouped) {
    if (!grouped.groups().empty()) {
      credits_.text += "\n" + title + "\n";
    }
    for (const Grouped::Group& group : grouped.groups()) {
      credits_.text += "  " + group.said + " (" + JoinNames(group.of) + ")\n";
    }
  }

  void WriteAssets(const std::string& title, const std::string& key, const Grouped& grouped) {
    WriteText(title, grouped);
    credits_.json[key] = Json::array();
    for (const Grouped::Group& group : grouped.groups()) {
      credits_.json[key].push_back(FormatAsset(group));
    }
  }

  void WriteGroups(const std::string& title, const std::string& key, const Grouped& grouped) {
    WriteText(title, grouped);
    credits_.json[key] = Json::array();
    for (const Grouped::Group& group : grouped.groups()) {
      credits_.json[key].push_back({{"credit", group.said}, {"of", group.of}});
    }
  }

  const ProjectPaths& paths_;
  const ProjectDocument& document_;
  Credits credits_;
};

}  // namespace

Result<Credits> MakeCredits(const ProjectPaths& paths, const ProjectDocument& document) {
  LARARIUM_ASSIGN_OR_RETURN(const stage::Paradata paradata, LoadParadata(paths));
  CreditsMaker maker(paths, document);
  LARARIUM_RETURN_IF_ERROR(maker.AddAssets());
  LARARIUM_RETURN_IF_ERROR(maker.AddSpeech(paradata));
  maker.AddClaims(paradata);
  return maker.Take();
}

}  // namespace lararium::editor
