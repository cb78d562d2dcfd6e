#include "editor/document/cast_edits.h"

#include <algorithm>
#include <utility>

#include "editor/document/named_entries.h"
#include "shared/drama/lua_tokens.h"

namespace lararium::editor {
namespace {

Result<ClipDocument*> FindClip(const std::string& name, CastDocument& member) {
  return FindNamed(member.clips, name, member.name, "has no recorded motion");
}

}  // namespace

Status CheckClipName(const CastDocument& member, const std::string& name) {
  LARARIUM_RETURN_IF_ERROR(CheckPlainName("the motion", name));
  const bool taken = std::any_of(member.clips.begin(), member.clips.end(),
                                 [&](const ClipDocument& clip) { return clip.name == name; });
  return taken ? Status::Error(member.name, "has a motion \"" + name + "\" already",
                               "choose another name")
               : Status();
}

Status AddClip(ClipDocument clip, CastDocument& member) {
  LARARIUM_RETURN_IF_ERROR(CheckPlainName("the motion", clip.name));
  std::erase_if(member.clips, [&](const ClipDocument& other) { return other.name == clip.name; });
  member.clips.push_back(std::move(clip));
  return Status();
}

Status RenameClip(const std::string& name, const std::string& to, CastDocument& member) {
  LARARIUM_ASSIGN_OR_RETURN(ClipDocument * clip, FindClip(name, member));
  if (name != to) {
    LARARIUM_RETURN_IF_ERROR(CheckClipName(member, to));
    clip->name = to;
  }
  return Status();
}

Status RemoveClip(const std::string& name, CastDocument& member) {
  LARARIUM_ASSIGN_OR_RETURN(const ClipDocument* clip, FindClip(name, member));
  member.clips.erase(member.clips.begin() + (clip - member.clips.data()));
  return Status();
}

std::vector<size_t> LinesThatSay(std::string_view script, std::string_view word) {
  using Kind = drama::LuaToken::Kind;
  std::vector<size_t> lines;
  drama::LuaTokens tokens(script);
  for (drama::LuaToken token = tokens.Next(); token.kind != Kind::kEnd && token.kind != Kind::kBad;
       token = tokens.Next()) {
    if (token.kind != Kind::kText ||
        drama::TextOf(script.substr(token.begin, token.end - token.begin)) != word) {
      continue;
    }
    const size_t line = drama::PositionOf(script, token.begin).line;
    if (lines.empty() || lines.back() != line) {
      lines.push_back(line);
    }
  }
  return lines;
}

}  // namespace lararium::editor
