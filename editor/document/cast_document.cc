#include "editor/document/cast_document.h"

#include <set>
#include <utility>

#include "editor/document/document_fields.h"
#include "editor/import/cast/cast_presets.h"

namespace lararium::editor {
namespace {

constexpr size_t kMaxClips = 1000;

Result<ClipDocument> ParseClip(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"name", "file", "loops"}));
  ClipDocument clip;
  LARARIUM_ASSIGN_OR_RETURN(clip.name, ParsePlainName(view, "name"));
  LARARIUM_ASSIGN_OR_RETURN(clip.file, view.Text("file"));
  if (view.Has("loops")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView loops, view.Field("loops"));
    LARARIUM_ASSIGN_OR_RETURN(clip.loops, loops.Boolean());
  }
  return clip;
}

Status ParseClips(const JsonView& view, std::vector<ClipDocument>& clips) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("clips"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, field.Array(kMaxClips));
  std::set<std::string> names;
  for (const JsonView& entry : list) {
    LARARIUM_ASSIGN_OR_RETURN(ClipDocument clip, ParseClip(entry));
    if (!names.insert(clip.name).second) {
      return entry.Problem("the name \"" + clip.name + "\" is used twice", "rename one");
    }
    clips.push_back(std::move(clip));
  }
  return Status();
}

Status ParsePlainFigure(const JsonView& view, CastDocument& member) {
  if (view.Has("height")) {
    LARARIUM_ASSIGN_OR_RETURN(member.height, view.Number("height", kMinHeight, kMaxHeight));
  }
  if (view.Has("tunic")) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> tunic, view.Numbers("tunic", 3));
    member.tunic = {tunic[0], tunic[1], tunic[2]};
    if (member.tunic.minCoeff() < 0.0 || member.tunic.maxCoeff() > 1.0) {
      return view.Problem("\"tunic\" must hold albedos from 0 to 1");
    }
  }
  return Status();
}

Result<int> ParseSetting(const JsonView& view, std::string_view key, int otherwise) {
  if (!view.Has(key)) {
    return otherwise;
  }
  LARARIUM_ASSIGN_OR_RETURN(const int64_t value, view.Integer(key, 0, 1000));
  return static_cast<int>(value);
}

}  // namespace

Result<bake::VoiceSettings> ParseVoice(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"variant", "pitch", "range", "rate"}));
  bake::VoiceSettings voice;
  if (view.Has("variant")) {
    LARARIUM_ASSIGN_OR_RETURN(voice.variant, view.Text("variant", 32));
  }
  LARARIUM_ASSIGN_OR_RETURN(voice.pitch, ParseSetting(view, "pitch", voice.pitch));
  LARARIUM_ASSIGN_OR_RETURN(voice.range, ParseSetting(view, "range", voice.range));
  LARARIUM_ASSIGN_OR_RETURN(voice.rate, ParseSetting(view, "rate", voice.rate));
  LARARIUM_RETURN_IF_ERROR(voice.Validate(view.place()));
  return voice;
}

Json FormatVoice(const bake::VoiceSettings& voice) {
  Json json = {{"pitch", voice.pitch}, {"range", voice.range}, {"rate", voice.rate}};
  if (!voice.variant.empty()) {
    json["variant"] = voice.variant;
  }
  return json;
}

Result<std::optional<import::CastRecipe>> RecipeOf(const CastDocument& member) {
  if (member.preset.empty()) {
    return member.recipe;
  }
  LARARIUM_ASSIGN_OR_RETURN(import::CastRecipe recipe, import::LoadCastPreset(member.preset));
  return std::optional(std::move(recipe));
}

Result<import::BoneNames> GivenBoneNames(const std::filesystem::path& bone_map,
                                         const import::BoneNames& bones) {
  import::BoneNames given;
  if (!bone_map.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(given, import::LoadBoneNames(bone_map));
  }
  for (const auto& [joint, bone] : bones) {
    std::erase_if(given, [&bone = bone](const auto& other) {
      return !bone.empty() && other.second == bone;  // One bone cannot be two joints.
    });
    given[joint] = bone;
  }
  return given;
}

Result<CastDocument> ParseCastMember(const JsonView& view) {
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"name", "preset", "recipe", "model", "bone_map",
                                             "bones", "clips", "height", "tunic", "voice"}));
  CastDocument member;
  LARARIUM_ASSIGN_OR_RETURN(member.name, ParsePlainName(view, "name"));
  if (view.Has("preset") + view.Has("recipe") + view.Has("model") > 1) {
    return view.Problem("has more than one of preset, recipe and model", "keep one of them");
  }
  if (view.Has("preset")) {
    LARARIUM_ASSIGN_OR_RETURN(member.preset, view.Text("preset"));
  }
  if (view.Has("recipe")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView recipe, view.Field("recipe"));
    LARARIUM_ASSIGN_OR_RETURN(member.recipe, import::ParseCastRecipe(recipe));
  }
  if (view.Has("model")) {
    LARARIUM_ASSIGN_OR_RETURN(member.model, view.Text("model"));
  }
  if (view.Has("bone_map")) {
    LARARIUM_ASSIGN_OR_RETURN(member.bone_map, view.Text("bone_map"));
  }
  if (view.Has("bones")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView bones, view.Field("bones"));
    LARARIUM_ASSIGN_OR_RETURN(member.bones, import::ParseBoneNames(bones));
  }
  if (view.Has("clips")) {
    LARARIUM_RETURN_IF_ERROR(ParseClips(view, member.clips));
  }
  if (view.Has("voice")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView voice, view.Field("voice"));
    LARARIUM_ASSIGN_OR_RETURN(member.voice, ParseVoice(voice));
  }
  LARARIUM_RETURN_IF_ERROR(ParsePlainFigure(view, member));
  return member;
}

Json FormatCastMember(const CastDocument& member) {
  Json json = {{"name", member.name}};
  if (!member.preset.empty()) {
    json["preset"] = member.preset;
  } else if (member.recipe) {
    json["recipe"] = import::ToJson(*member.recipe);
  } else if (!member.model.empty()) {
    json["model"] = member.model;
  } else {
    json["height"] = member.height;
    json["tunic"] = FormatVector(member.tunic);
  }
  if (!member.bone_map.empty()) {
    json["bone_map"] = member.bone_map;
  }
  if (!member.bones.empty()) {
    json["bones"] = member.bones;
  }
  for (const ClipDocument& clip : member.clips) {
    Json entry = {{"name", clip.name}, {"file", clip.file}};
    if (clip.loops) {
      entry["loops"] = true;
    }
    json["clips"].push_back(std::move(entry));
  }
  if (member.voice != bake::VoiceSettings()) {
    json["voice"] = FormatVoice(member.voice);
  }
  return json;
}

}  // namespace lararium::editor
