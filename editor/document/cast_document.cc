#include "editor/document/cast_document.h"

#include <set>
#include <utility>

#include "editor/document/document_fields.h"
#include "editor/import/cast/cast_presets.h"

namespace lararium::editor {
namespace {

constexpr size_t kMaxClips = 1000;

void DescribeClip(Fields& fields, ClipDocument& clip) {
  DescribePlainName(fields, "name", clip.name);
  fields.Text("file", clip.file);
  fields.Flag(Optional("loops", clip.loops), clip.loops);
}

}  // namespace

void DescribeVoice(Fields& fields, bake::VoiceSettings& voice) {
  fields.Text(Optional("variant", !voice.variant.empty()), voice.variant, 32);
  fields.Integer(Optional("pitch"), voice.pitch, 0, 1000);
  fields.Integer(Optional("range"), voice.range, 0, 1000);
  fields.Integer(Optional("rate"), voice.rate, 0, 1000);
  fields.Check(voice.Validate(fields.where()));
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

void DescribeFields(Fields& fields, CastDocument& member) {
  DescribePlainName(fields, "name", member.name);
  DescribeTitle(fields, member.title);
  const bool has_preset = fields.Has("preset", !member.preset.empty());
  const bool has_recipe = fields.Has("recipe", member.recipe && !has_preset);
  const bool has_model = fields.Has("model", !member.model.empty() && !has_preset && !has_recipe);
  fields.Require(int{has_preset} + int{has_recipe} + int{has_model} <= 1,
                 "has more than one of preset, recipe and model", "keep one of them");
  fields.Text(Optional("preset", has_preset), member.preset);
  if (has_recipe) {
    fields.Object("recipe", member.recipe);
  }
  fields.Text(Optional("model", has_model), member.model);
  fields.Text(Optional("bone_map", !member.bone_map.empty()), member.bone_map);
  import::DescribeBoneNames(fields, Optional("bones", !member.bones.empty()), member.bones);
  std::set<std::string> names;
  fields.List(Optional("clips", !member.clips.empty()), member.clips, kMaxClips,
              [&](Fields& entry, ClipDocument& clip) {
                DescribeClip(entry, clip);
                entry.Require(names.insert(clip.name).second,
                              "the name \"" + clip.name + "\" is used twice", "rename one");
              });
  const bool plain = !has_preset && !has_recipe && !has_model;
  fields.Number(Optional("height", plain), member.height, kMinHeight, kMaxHeight);
  fields.Numbers(Optional("tunic", plain), std::span(member.tunic.data(), 3));
  fields.Require(member.tunic.minCoeff() >= 0.0 && member.tunic.maxCoeff() <= 1.0,
                 "\"tunic\" must hold albedos from 0 to 1");
  fields.Object(Optional("voice", member.voice != bake::VoiceSettings()), member.voice,
                DescribeVoice);
}

}  // namespace lararium::editor
