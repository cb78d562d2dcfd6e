#include "editor/import/model/model_import.h"

#include <functional>

#include "editor/import/model/model_builder.h"
#include "editor/import/model/model_isolation.h"
#include "editor/import/model/model_scene.h"
#include "editor/import/model/model_textures.h"
#include "editor/import/model/root_motion.h"
#include "shared/core/release.h"
#include "shared/image/picture_notes.h"

namespace lararium::import {
namespace {

using Bytes = std::vector<std::byte>;
using Work = std::function<Result<Bytes>()>;

Result<BuiltModel> Build(const std::filesystem::path& file,
                         const ImportOptions& options,
                         Content content) {
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<ModelScene> model, ReadModelScene(file));
  return BuildModel(*model, options, content);
}

Result<BuiltModel> BuildInChild(const std::filesystem::path& file,
                                const ImportOptions& options,
                                Content content) {
  const Work work = [&]() -> Result<Bytes> {
    LARARIUM_ASSIGN_OR_RETURN(const BuiltModel model, Build(file, options, content));
    return PackModel(model);
  };
  LARARIUM_ASSIGN_OR_RETURN(const Bytes bytes, RunInChild(file.string(), work));
  return UnpackModel(bytes, file.string());
}

// A texture that cannot be used adds a note, and its material gets none.
void AddTextures(const std::string& where, BuiltModel& model, ImportedHuman& imported) {
  std::vector<int16_t> texture_of(model.images.size(), human::Material::kNone);
  for (size_t i = 0; i < model.images.size(); ++i) {
    auto texture = PrepareTexture(model.images[i].encoded, model.images[i].name, where);
    if (texture.ok()) {
      for (const std::string& note : image::PictureNotes(model.images[i].encoded)) {
        imported.notes.push_back("texture '" + model.images[i].name + "' " + note);
      }
      texture_of[i] = static_cast<int16_t>(imported.human.textures.size());
      imported.human.textures.push_back(
          std::make_shared<const human::Texture>(*std::move(texture)));
    } else {
      imported.notes.push_back(texture.message());
    }
    Release(model.images[i].encoded);
  }
  const auto texture = [&](int image) {
    return image < 0 ? human::Material::kNone : texture_of[static_cast<size_t>(image)];
  };
  for (size_t m = 0; m < model.uses.size(); ++m) {
    imported.human.materials[m].colour_texture = texture(model.uses[m].colour);
    imported.human.materials[m].normal_texture = texture(model.uses[m].normal);
  }
}

Result<ImportedHuman> Import(const std::filesystem::path& file,
                             const ImportOptions& options,
                             Content content) {
  if ((options.metres_per_unit && !(*options.metres_per_unit > 0.0f)) ||
      !(options.keys_per_second > 0.0f) || options.keys_per_second > 1000.0f) {
    return Status::Error(file.string(), "the import's scale and key rate must be above 0");
  }
  LARARIUM_ASSIGN_OR_RETURN(BuiltModel model, options.in_child_process
                                                  ? BuildInChild(file, options, content)
                                                  : Build(file, options, content));
  ImportedHuman imported;
  imported.human = std::move(model.human);
  imported.emissions = std::move(model.emissions);
  imported.bones = std::move(model.bones);
  imported.is_human = model.is_human;
  imported.bone_table = std::move(model.bone_table);
  imported.joints = std::move(model.joints);
  imported.bone_names = std::move(model.bone_names);
  imported.notes = std::move(model.notes);
  AddTextures(file.string(), model, imported);
  LARARIUM_RETURN_IF_ERROR(imported.human.Validate(file.string()));
  return imported;
}

}  // namespace

Result<ImportedHuman> ImportPerson(const std::filesystem::path& file,
                                   const ImportOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(ImportedHuman imported, Import(file, options, Content::kFigure));
  for (human::Clip& clip : imported.human.clips) {
    TakeRootMotion(imported.human.skeleton, clip);
  }
  return imported;
}

Result<human::Human> ImportHuman(const std::filesystem::path& file, const ImportOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(ImportedHuman imported, ImportPerson(file, options));
  return std::move(imported.human);
}

Result<ImportedHuman> ImportThing(const std::filesystem::path& file,
                                  bool has_parts,
                                  const ImportOptions& options) {
  return Import(file, options, has_parts ? Content::kObject : Content::kScenery);
}

Result<ImportedHuman> ImportMotion(const std::filesystem::path& file,
                                   const ImportOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(ImportedHuman imported, Import(file, options, Content::kMotion));
  if (imported.human.clips.empty()) {
    return Status::Error(file.string(), "there is no animation in it", "export it with one");
  }
  return imported;
}

}  // namespace lararium::import
