#include "editor/import/model/model_surfaces.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "shared/core/file.h"
#include "shared/core/lower_case.h"
#include "shared/core/srgb.h"

namespace lararium::import {
namespace {

constexpr size_t kMaxMaterials = 1000;
constexpr size_t kMaxImageBytes = size_t{256} << 20;
constexpr float kMaxEmission = 1e3f;  // A thousand times white.

// Guesses the kind of surface from the name of the material. The head of a thing is not of skin.
human::Surface SurfaceOf(const std::string& name, bool of_person) {
  struct Word {
    const char* text;
    human::Surface surface;
  };
  constexpr Word kWords[] = {{"hair", human::Surface::kHair},     {"brow", human::Surface::kHair},
                             {"lash", human::Surface::kHair},     {"beard", human::Surface::kHair},
                             {"eye", human::Surface::kEye},       {"iris", human::Surface::kEye},
                             {"skin", human::Surface::kSkin},     {"body", human::Surface::kSkin},
                             {"face", human::Surface::kSkin},     {"head", human::Surface::kSkin},
                             {"cloth", human::Surface::kCloth},   {"shirt", human::Surface::kCloth},
                             {"dress", human::Surface::kCloth},   {"tunic", human::Surface::kCloth},
                             {"trouser", human::Surface::kCloth}, {"pants", human::Surface::kCloth},
                             {"toga", human::Surface::kCloth}};
  const std::string lower = LowerCase(name);
  for (const Word& word : kWords) {
    if ((of_person || word.surface == human::Surface::kCloth) &&
        lower.find(word.text) != std::string::npos) {
      return word.surface;
    }
  }
  return human::Surface::kPlain;
}

// Uses the metallic factor of glTF and ignores metallic textures.
bool IsMetal(const aiMaterial& material) {
  float metallic = 0.0f;
  return material.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == AI_SUCCESS && metallic >= 0.5f &&
         material.GetTextureCount(aiTextureType_METALNESS) == 0;
}

// Gives a linear colour. `is_linear` says whether the colours of the file are linear.
glm::vec3 ColourOf(const aiMaterial& material, bool is_linear) {
  aiColor4D colour;
  if (material.Get(AI_MATKEY_BASE_COLOR, colour) != AI_SUCCESS &&
      material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != AI_SUCCESS) {
    return glm::vec3(1.0f);
  }
  glm::vec3 result(colour.r, colour.g, colour.b);
  for (int c = 0; c < 3; ++c) {
    result[c] = std::isfinite(result[c]) ? std::clamp(result[c], 0.0f, 1.0f) : 1.0f;
    result[c] = is_linear ? result[c] : LinearFromSrgb(result[c]);
  }
  return result;
}

// Emission that a texture varies over the surface is not read.
glm::vec3 EmissionOf(const aiMaterial& material, bool is_linear) {
  aiColor3D colour;
  if (material.Get(AI_MATKEY_COLOR_EMISSIVE, colour) != AI_SUCCESS ||
      material.GetTextureCount(aiTextureType_EMISSIVE) > 0) {
    return glm::vec3(0.0f);
  }
  glm::vec3 result(colour.r, colour.g, colour.b);
  for (int c = 0; c < 3; ++c) {
    result[c] = std::isfinite(result[c]) ? std::clamp(result[c], 0.0f, kMaxEmission) : 0.0f;
    result[c] = is_linear ? result[c] : LinearFromSrgb(result[c]);
  }
  return result;
}

void SetAlpha(const aiMaterial& source, bool textured, human::Material& material) {
  aiString mode;
  float cutoff = 0.5f;
  if (source.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == AI_SUCCESS) {
    source.Get(AI_MATKEY_GLTF_ALPHACUTOFF, cutoff);
    const bool blends = mode == aiString("BLEND");
    if (mode == aiString("MASK") || (blends && textured)) {
      material.alpha_cutoff = std::isfinite(cutoff) ? std::clamp(cutoff, 0.01f, 1.0f) : 0.5f;
    }
  } else if (textured && source.GetTextureCount(aiTextureType_OPACITY) > 0) {
    material.alpha_cutoff = 0.5f;
  }
}

class SurfaceReader {
 public:
  SurfaceReader(const ModelScene& model, bool of_person, std::vector<std::string>& notes)
      : model_(model), of_person_(of_person), notes_(notes) {}

  ModelSurfaces Read(std::span<const Part> parts) {
    const aiScene& scene = *model_.scene;
    std::set<unsigned> used;
    for (const Part& part : parts) {
      used.insert(part.mesh->mMaterialIndex);
    }
    read_.material_of.assign(scene.mNumMaterials, human::Material::kNone);
    for (const unsigned index : used) {
      if (index < scene.mNumMaterials && read_.materials.size() < kMaxMaterials) {
        read_.material_of[index] = static_cast<int16_t>(read_.materials.size());
        AddMaterial(*scene.mMaterials[index]);
      }
    }
    if (used.size() > kMaxMaterials) {
      notes_.push_back("it has " + std::to_string(used.size()) + " materials; those after the " +
                       std::to_string(kMaxMaterials) + "th are left out");
    }
    return std::move(read_);
  }

 private:
  void AddMaterial(const aiMaterial& source) {
    human::Material material;
    material.name = source.GetName().C_Str();
    material.surface = SurfaceOf(material.name, of_person_);
    int two_sided = 0;
    material.two_sided = source.Get(AI_MATKEY_TWOSIDED, two_sided) == AI_SUCCESS && two_sided != 0;
    float roughness = material.roughness;
    if (source.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == AI_SUCCESS && roughness >= 0.0f) {
      material.roughness = std::min(roughness, 1.0f);
    }
    if (IsMetal(source) && material.surface == human::Surface::kPlain) {
      material.surface = human::Surface::kMetal;
    }
    TextureUse use;
    use.colour = FindImage(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    use.normal = FindImage(source, {aiTextureType_NORMALS});
    const bool textured = use.colour >= 0;
    SetAlpha(source, textured, material);
    if (!model_.gltf) {  // The reader of glTF tells this itself.
      TellOtherTextures(source, material.name);
    }
    const glm::vec3 colour = ColourOf(source, model_.gltf.has_value());
    material.colour = textured ? colour : glm::vec3(1.0f);
    read_.vertex_colours.push_back(textured ? glm::vec3(1.0f) : colour);
    read_.emissions.push_back(EmissionOf(source, model_.gltf.has_value()));
    read_.materials.push_back(material);
    read_.uses.push_back(use);
  }

  void TellOtherTextures(const aiMaterial& source, const std::string& name) {
    std::string list;
    for (const auto& [type, what] : {std::pair{aiTextureType_EMISSIVE, "emission"},
                                     {aiTextureType_SPECULAR, "specular colour"},
                                     {aiTextureType_OPACITY, "opacity"},
                                     {aiTextureType_HEIGHT, "bumps"},
                                     {aiTextureType_DISPLACEMENT, "displacement"},
                                     {aiTextureType_METALNESS, "metal"},
                                     {aiTextureType_AMBIENT_OCCLUSION, "occlusion"}}) {
      if (source.GetTextureCount(type) > 0) {
        list += (list.empty() ? "" : ", ") + std::string(what);
      }
    }
    if (!list.empty()) {
      notes_.push_back("material '" + name + "': its textures of " + list + " are not taken over");
    }
  }

  // The index of an image, which is added if it is new; -1 if there is no usable one.
  int FindImage(const aiMaterial& material, std::initializer_list<aiTextureType> types) {
    aiString path;
    for (const aiTextureType type : types) {
      if (material.GetTexture(type, 0, &path) == AI_SUCCESS && path.length > 0) {
        const auto [found, is_new] = image_of_uri_.try_emplace(path.C_Str(), -1);
        if (is_new) {
          found->second = AddImage(found->first);
        }
        return found->second;
      }
    }
    return -1;
  }

  int AddImage(const std::string& uri) {
    const aiTexture* embedded = model_.scene->GetEmbeddedTexture(uri.c_str());
    std::optional<ModelImage> image =
        embedded != nullptr ? TakeEmbedded(*embedded, uri) : ReadBeside(uri);
    if (!image) {
      return -1;
    }
    read_.images.push_back(std::move(*image));
    return static_cast<int>(read_.images.size()) - 1;
  }

  std::optional<ModelImage> TakeEmbedded(const aiTexture& texture, const std::string& uri) {
    const std::string name = uri.substr(0, 256);
    if (texture.mHeight != 0) {
      notes_.push_back("texture '" + name + "' is embedded as bare pixels, which is not supported");
      return std::nullopt;
    }
    const auto* begin = reinterpret_cast<const std::byte*>(texture.pcData);
    return ModelImage{texture.mFilename.length > 0 ? texture.mFilename.C_Str() : name,
                      {begin, begin + texture.mWidth}};
  }

  std::optional<ModelImage> ReadBeside(const std::string& uri) {
    const std::filesystem::path file = FindReferenced(model_.file, uri);
    auto bytes = file.empty() ? Result<std::vector<std::byte>>(Status::Error(
                                    uri.substr(0, 256), "is not in the model's folder"))
                              : ReadBytes(file, kMaxImageBytes);
    if (!bytes.ok()) {
      notes_.push_back("texture " + bytes.message());
      return std::nullopt;
    }
    return ModelImage{file.filename().string(), std::move(*bytes)};
  }

  const ModelScene& model_;
  bool of_person_;
  std::vector<std::string>& notes_;
  std::map<std::string, int> image_of_uri_;
  ModelSurfaces read_;
};

}  // namespace

ModelSurfaces ReadSurfaces(const ModelScene& model,
                           std::span<const Part> parts,
                           bool of_person,
                           std::vector<std::string>& notes) {
  return SurfaceReader(model, of_person, notes).Read(parts);
}

}  // namespace lararium::import
