#include "editor/import/model/gltf_materials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <cmath>
#include <cstring>
#include <map>
#include <utility>

namespace lararium::import {
namespace {

constexpr size_t kRepeat = 10497, kNearest = 9728;
constexpr char kEmissiveStrength[] = "KHR_materials_emissive_strength";

const Json& At(const GltfDocument& document, const char* list, size_t index) {
  return document.json[list][index];
}

// The colours of a material are those of metallic-roughness, or of the older
// KHR_materials_pbrSpecularGlossiness if it has only these.
struct Colours {
  const Json* texture = nullptr;  // A textureInfo.
  std::array<float, 4> factor = {1.0f, 1.0f, 1.0f, 1.0f};
};

Colours ColoursOf(const Json& material) {
  Colours colours;
  const Json* metallic = Find(material, "pbrMetallicRoughness");
  const Json* glossy = FindExtension(material, "KHR_materials_pbrSpecularGlossiness");
  if (metallic != nullptr) {
    colours.texture = Find(*metallic, "baseColorTexture");
    ReadNumbers(*metallic, "baseColorFactor", colours.factor);
  } else if (glossy != nullptr) {
    colours.texture = Find(*glossy, "diffuseTexture");
    ReadNumbers(*glossy, "diffuseFactor", colours.factor);
  }
  return colours;
}

// The texture of a textureInfo; null if there is none.
const Json* TextureOf(const GltfDocument& document, const Json* info) {
  const Json* textures = Find(document.json, "textures");
  const size_t index = info == nullptr ? SIZE_MAX : WholeOr(*info, "index", SIZE_MAX);
  return textures != nullptr && index < textures->size() ? &(*textures)[index] : nullptr;
}

GltfUvs UvsOf(const GltfDocument& document, const Json* info) {
  GltfUvs uvs;
  if (info == nullptr) {
    return uvs;
  }
  uvs.set = WholeOr(*info, "texCoord", 0);
  if (const Json* transform = FindExtension(*info, "KHR_texture_transform")) {
    std::array<float, 2> offset = {0.0f, 0.0f}, scale = {1.0f, 1.0f};
    ReadNumbers(*transform, "offset", offset);
    ReadNumbers(*transform, "scale", scale);
    const float angle = NumberOr(*transform, "rotation", 0.0f);
    const float c = std::cos(angle), s = std::sin(angle);
    uvs.transform = glm::mat3(1, 0, 0, 0, 1, 0, offset[0], offset[1], 1) *
                    glm::mat3(c, -s, 0, s, c, 0, 0, 0, 1) *
                    glm::mat3(scale[0], 0, 0, 0, scale[1], 0, 0, 0, 1);
    uvs.set = WholeOr(*transform, "texCoord", uvs.set);
  }
  const Json* texture = TextureOf(document, info);
  const Json* samplers = Find(document.json, "samplers");
  const size_t sampler = texture == nullptr ? SIZE_MAX : WholeOr(*texture, "sampler", SIZE_MAX);
  if (samplers != nullptr && sampler < samplers->size()) {
    uvs.repeats = WholeOr((*samplers)[sampler], "wrapS", kRepeat) == kRepeat &&
                  WholeOr((*samplers)[sampler], "wrapT", kRepeat) == kRepeat;
  }
  return uvs;
}

class MaterialReader {
 public:
  MaterialReader(const GltfDocument& document,
                 const GltfAccessors& accessors,
                 std::set<std::string>& left_out,
                 std::vector<std::string>& notes)
      : document_(document), accessors_(accessors), left_out_(left_out), notes_(notes) {}

  void Read(aiScene& scene) {
    const Json* list = Find(document_.json, "materials");
    const size_t count = list == nullptr ? 0 : list->size();
    scene.mMaterials = new aiMaterial*[count + 1];
    for (size_t i = 0; i < count; ++i) {
      scene.mMaterials[scene.mNumMaterials++] = MakeMaterial((*list)[i]).release();
    }
    scene.mMaterials[scene.mNumMaterials++] = MakeMaterial(Json::object()).release();
    scene.mTextures = new aiTexture*[textures_.size()];
    for (std::unique_ptr<aiTexture>& texture : textures_) {
      scene.mTextures[scene.mNumTextures++] = texture.release();
    }
  }

 private:
  std::unique_ptr<aiMaterial> MakeMaterial(const Json& source) {
    auto material = std::make_unique<aiMaterial>();
    const aiString name(TextOr(source, "name", ""));
    material->AddProperty(&name, AI_MATKEY_NAME);
    const Colours colours = ColoursOf(source);
    const aiColor4D colour(colours.factor[0], colours.factor[1], colours.factor[2],
                           colours.factor[3]);
    material->AddProperty(&colour, 1, AI_MATKEY_BASE_COLOR);
    AddTexture(colours.texture, aiTextureType_BASE_COLOR, *material);
    const Json* normals = Find(source, "normalTexture");
    const GltfUvs uvs = UvsOf(document_, normals);
    if (normals != nullptr && uvs != UvsOf(document_, colours.texture)) {
      left_out_.insert("normal maps with texture coordinates of their own");
    } else {
      AddTexture(normals, aiTextureType_NORMALS, *material);
      if (normals != nullptr && NumberOr(*normals, "scale", 1.0f) != 1.0f) {
        left_out_.insert("scales of normal maps");
      }
    }
    AddReflection(source, *material);
    AddAlpha(source, colours.texture != nullptr, *material);
    AddEmission(source, *material);
    ListWhatIsLeftOut(source);
    return material;
  }

  void AddReflection(const Json& source, aiMaterial& material) {
    const Json* reflection = Find(source, "pbrMetallicRoughness");
    if (reflection == nullptr) {
      return;
    }
    const float metallic = NumberOr(*reflection, "metallicFactor", 1.0f);
    const float roughness = NumberOr(*reflection, "roughnessFactor", 1.0f);
    material.AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
    material.AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
    if (Find(*reflection, "metallicRoughnessTexture") != nullptr) {
      const aiString unused("*");  // The property only says that the factor is not constant.
      material.AddProperty(&unused, AI_MATKEY_TEXTURE(aiTextureType_METALNESS, 0));
      left_out_.insert("textures of metal and roughness");
    }
  }

  void AddAlpha(const Json& source, bool textured, aiMaterial& material) {
    const aiString mode(TextOr(source, "alphaMode", "OPAQUE"));
    float cutoff = NumberOr(source, "alphaCutoff", 0.5f);
    if (mode == aiString("MASK")) {  // The texture's alpha times the factor is compared with it.
      cutoff /= std::max(ColoursOf(source).factor[3], 1e-6f);
    }
    const Json* sides = Find(source, "doubleSided");
    const int two_sided = sides != nullptr && sides->is_boolean() && sides->get<bool>() ? 1 : 0;
    material.AddProperty(&mode, AI_MATKEY_GLTF_ALPHAMODE);
    material.AddProperty(&cutoff, 1, AI_MATKEY_GLTF_ALPHACUTOFF);
    material.AddProperty(&two_sided, 1, AI_MATKEY_TWOSIDED);
    if (mode == aiString("BLEND")) {
      left_out_.insert(textured ? "half transparency (what is less than half opaque is cut out)"
                                : "half transparency");
    }
  }

  void AddEmission(const Json& source, aiMaterial& material) {
    std::array<float, 3> factor = {0.0f, 0.0f, 0.0f};
    if (!ReadNumbers(source, "emissiveFactor", factor)) {
      return;
    }
    const Json* extension = FindExtension(source, kEmissiveStrength);
    const float strength =
        extension == nullptr ? 1.0f : NumberOr(*extension, "emissiveStrength", 1.0f);
    if (Find(source, "emissiveTexture") != nullptr) {
      left_out_.insert("textures of emission");
      return;
    }
    const aiColor3D emission(strength * factor[0], strength * factor[1], strength * factor[2]);
    material.AddProperty(&emission, 1, AI_MATKEY_COLOR_EMISSIVE);
  }

  void ListWhatIsLeftOut(const Json& source) {
    if (Find(source, "occlusionTexture") != nullptr) {
      left_out_.insert("occlusion textures");
    }
    const Json* extensions = Find(source, "extensions");
    if (extensions == nullptr || !extensions->is_object()) {
      return;
    }
    for (const auto& [name, value] : extensions->items()) {
      if (name != kEmissiveStrength) {
        left_out_.insert(name == "KHR_materials_unlit" ? "being unlit (it is lit like all people)"
                                                       : name.substr(0, 64));
      }
    }
  }

  // Adds the texture of a textureInfo, if its image can be used.
  void AddTexture(const Json* info, aiTextureType type, aiMaterial& material) {
    const Json* texture = TextureOf(document_, info);
    if (texture == nullptr) {
      return;
    }
    const Json* samplers = Find(document_.json, "samplers");
    const size_t sampler = WholeOr(*texture, "sampler", SIZE_MAX);
    if (samplers != nullptr && sampler < samplers->size() &&
        WholeOr((*samplers)[sampler], "magFilter", 0) == kNearest) {
      left_out_.insert("pixels with hard edges (textures are smoothed)");
    }
    size_t image = WholeOr(*texture, "source", SIZE_MAX);
    for (const char* name : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu"}) {
      const Json* other = FindExtension(*texture, name);
      if (image == SIZE_MAX && other != nullptr) {
        image = WholeOr(*other, "source", SIZE_MAX);
      }
    }
    const Json* images = Find(document_.json, "images");
    if (images == nullptr || image >= images->size()) {
      const Json* extensions = Find(*texture, "extensions");
      const bool has_other =
          extensions != nullptr && extensions->is_object() && !extensions->empty();
      left_out_.insert(has_other ? "textures in " + extensions->begin().key().substr(0, 64)
                                 : "textures without an image");
      return;
    }
    const auto [path, is_new] = path_of_image_.try_emplace(image);
    if (is_new) {
      path->second = PathOf((*images)[image], image);
    }
    if (!path->second.empty()) {
      const aiString text(path->second);
      material.AddProperty(&text, AI_MATKEY_TEXTURE(type, 0));
    }
  }

  // The name of an embedded image, or the path of one in a file; empty if it cannot be used.
  std::string PathOf(const Json& image, size_t index) {
    const std::string uri = TextOr(image, "uri", "");
    const std::string name = TextOr(image, "name", "image " + std::to_string(index));
    if (!uri.empty() && !uri.starts_with("data:")) {
      return uri;
    }
    Result<std::vector<std::byte>> decoded = std::vector<std::byte>();
    if (!uri.empty()) {
      decoded = DecodeDataUri(uri, "texture '" + name + "'");
    } else if (const Json* view = Find(image, "bufferView")) {
      const auto bytes = accessors_.View(view->get<size_t>());
      decoded = bytes.ok() ? std::vector<std::byte>(bytes->begin(), bytes->end())
                           : Result<std::vector<std::byte>>(bytes.status());
    }
    if (!decoded.ok()) {
      notes_.push_back(decoded.message());
      return {};
    }
    auto texture = std::make_unique<aiTexture>();
    texture->mFilename = name;
    texture->mWidth = static_cast<unsigned>(decoded->size());
    texture->pcData = new aiTexel[decoded->size() / sizeof(aiTexel) + 1];
    std::memcpy(static_cast<void*>(texture->pcData), decoded->data(), decoded->size());
    textures_.push_back(std::move(texture));
    return "*" + std::to_string(textures_.size() - 1);
  }

  const GltfDocument& document_;
  const GltfAccessors& accessors_;
  std::set<std::string>& left_out_;
  std::vector<std::string>& notes_;
  std::vector<std::unique_ptr<aiTexture>> textures_;
  std::map<size_t, std::string> path_of_image_;
};

}  // namespace

GltfUvs ColourUvs(const GltfDocument& document, std::optional<size_t> material) {
  return material ? UvsOf(document, ColoursOf(At(document, "materials", *material)).texture)
                  : GltfUvs();
}

void AddGltfMaterials(const GltfDocument& document,
                      const GltfAccessors& accessors,
                      aiScene& scene,
                      std::set<std::string>& left_out,
                      std::vector<std::string>& notes) {
  MaterialReader(document, accessors, left_out, notes).Read(scene);
}

}  // namespace lararium::import
