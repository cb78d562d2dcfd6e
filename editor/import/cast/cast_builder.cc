#include "editor/import/cast/cast_builder.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "editor/import/cast/cast_capsules.h"
#include "editor/import/cast/cast_complexion.h"
#include "editor/import/cast/cast_face.h"
#include "editor/import/cast/cast_hair.h"
#include "editor/import/cast/cast_hang.h"
#include "editor/import/cast/cast_mouth.h"
#include "editor/import/cast/cast_paint.h"
#include "editor/import/cast/cast_parts.h"
#include "editor/import/cast/cast_rig.h"
#include "editor/import/cast/cast_shape.h"
#include "editor/import/cast/cast_subdivide.h"
#include "editor/import/model/levels_of_detail.h"
#include "editor/import/wardrobe/garment.h"
#include "shared/core/file.h"

namespace lararium::import {
namespace {

// A shaved beard shows in the regions of these parts.
constexpr const char* kBeards[] = {"Full_beard", "Moustache"};
constexpr float kHeadShare = 0.16f;  // Share of the height: head and upper neck.

// Material properties of each kind of part.
struct Look {
  human::Surface surface;
  float roughness;
  float alpha_cutoff;
  bool two_sided;
  int texture_size;
};

Look LookOf(CastPart part) {
  switch (part) {
    case CastPart::kEyes:
      return {human::Surface::kEye, 0.15f, 0.5f, false, 512};
    case CastPart::kTeeth:
      return {human::Surface::kPlain, 0.35f, 0.0f, false, 256};
    case CastPart::kTongue:
      return {human::Surface::kPlain, 0.6f, 0.0f, false, 128};
    case CastPart::kEyebrows:
    case CastPart::kEyelashes:
      return {human::Surface::kHair, 0.7f, 0.25f, true, 512};
    case CastPart::kHair:
      return {human::Surface::kHair, 0.6f, 0.4f, true, 512};
  }
  return {human::Surface::kPlain, 0.8f, 0.0f, false, 512};
}

// Eyes and teeth are rigid: each vertex follows only its strongest joint.
void MakeRigid(human::SkinnedMesh& mesh) {
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.joints[v].fill(mesh.joints[v][0]);
    mesh.weights[v] = {1.0f, 0.0f, 0.0f, 0.0f};
  }
}

BaseShape ShapeOf(const CastLibrary& library,
                  std::vector<glm::vec3> positions,
                  const human::Skeleton& skeleton) {
  BaseShape shape;
  shape.positions = std::move(positions);
  CastWeights weights = WeightsOf(library, skeleton);
  shape.joints = std::move(weights.joints);
  shape.weights = std::move(weights.weights);
  const CastMesh& mesh = library.base().mesh;
  for (const CastMaterial& material : mesh.materials) {
    shape.groups.push_back({material.name, {}});
  }
  for (const CastFace& face : mesh.faces) {
    shape.groups[face.material].quads.push_back(face.vertices);
  }
  return shape;
}

// Raises a person whose soles are below the floor, because shoes are made around bare feet.
void StandOnSoles(human::Human& human) {
  std::vector<bool> of_foot(human.skeleton.size(), false);
  for (const char* joint : {"l_ankle", "r_ankle", "l_midtarsal", "r_midtarsal"}) {
    if (const auto index = human.skeleton.Find(joint)) {
      of_foot[static_cast<size_t>(*index)] = true;
    }
  }
  float lowest = 0.0f;
  for (const human::SkinnedMesh& mesh : human.meshes) {
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
      if (of_foot[mesh.joints[v][0]]) {
        lowest = std::min(lowest, mesh.positions[v].y);
      }
    }
  }
  const glm::vec3 lift(0.0f, -lowest, 0.0f);
  for (human::SkinnedMesh& mesh : human.meshes) {
    for (glm::vec3& p : mesh.positions) {
      p += lift;
    }
  }
  for (human::Cloth& cloth : human.cloths) {
    for (glm::vec3& p : cloth.positions) {
      p += lift;
    }
  }
  for (size_t joint = 0; joint < human.skeleton.size(); ++joint) {
    if (human.skeleton.parents[joint] == human::Skeleton::kNoParent) {
      human.skeleton.rest[joint].translation += lift;
    }
    glm::mat4& joint_from_actor = human.skeleton.joint_from_actor[joint];
    joint_from_actor = glm::translate(joint_from_actor, -lift);
  }
}

// Builds one person.
class CastBuilder {
 public:
  CastBuilder(const CastLibrary& library, const CastRecipe& recipe, const Progress& progress)
      : library_(library), recipe_(recipe), progress_(progress) {}

  Result<human::Human> Build() {
    LARARIUM_ASSIGN_OR_RETURN(body_, FitBody(library_, recipe_));
    human_.name = recipe_.name;
    human_.skeleton = body_.skeleton;
    human_.credits = "base mesh, rig, targets and skins: MakeHuman Team; AGPL3\n";
    LARARIUM_RETURN_IF_ERROR(Continue());
    LARARIUM_ASSIGN_OR_RETURN(std::vector<Garment> garments, Dress());
    LARARIUM_RETURN_IF_ERROR(AddSkin(garments));
    LARARIUM_RETURN_IF_ERROR(AddPart(CastPart::kEyes, {"HighPolyEyes", recipe_.eyes.colour}));
    LARARIUM_RETURN_IF_ERROR(AddPart(CastPart::kTeeth, {recipe_.teeth, {}}));
    LARARIUM_RETURN_IF_ERROR(AddPart(CastPart::kTongue, {recipe_.tongue, {}}));
    LARARIUM_RETURN_IF_ERROR(AddPart(CastPart::kEyelashes, {recipe_.eyelashes, {}}));
    LARARIUM_RETURN_IF_ERROR(AddPart(CastPart::kEyebrows, recipe_.eyebrows));
    if (recipe_.hair) {
      LARARIUM_RETURN_IF_ERROR(AddPart(CastPart::kHair, *recipe_.hair));
    }
    for (const CastDyed& beard : recipe_.beard) {
      LARARIUM_RETURN_IF_ERROR(AddPart(CastPart::kHair, beard));
    }
    ShadeMouth(pieces_, recipe_.teeth, recipe_.tongue);
    AddFace(library_, recipe_, body_.base, pieces_, human_);
    for (CastPiece& piece : pieces_) {
      LARARIUM_RETURN_IF_ERROR(Continue());
      AddLevelsOfDetail(piece.mesh, piece.covered);
      human_.meshes.push_back(std::move(piece.mesh));
    }
    for (Garment& garment : garments) {
      LARARIUM_RETURN_IF_ERROR(Continue());
      AddGarment(std::move(garment));
    }
    human_.capsules = body_.capsules;
    StandOnSoles(human_);
    OrderVertices(human_);
    LARARIUM_RETURN_IF_ERROR(human_.Validate(recipe_.name));
    return std::move(human_);
  }

 private:
  Status Continue() const {
    return progress_.Cancelled() ? Status::Error(recipe_.name, "cancelled before it was built")
                                 : Status();
  }

  std::string SkinName() const {
    if (!recipe_.skin.empty()) {
      return recipe_.skin;
    }
    const char* age = recipe_.age < 38.0f ? "young" : recipe_.age < 60.0f ? "middleage" : "old";
    const glm::vec3& e = recipe_.ethnicity;
    const char* ethnicity = e.x >= e.y && e.x >= e.z ? "caucasian"
                            : e.y >= e.z             ? "african"
                                                     : "asian";
    return std::string(age) + "_" + ethnicity + (recipe_.sex >= 0.5f ? "_male" : "_female");
  }

  int16_t AddTexture(human::Texture texture) {
    human_.textures.push_back(std::make_shared<const human::Texture>(std::move(texture)));
    return static_cast<int16_t>(human_.textures.size() - 1);
  }

  Result<std::vector<Garment>> Dress() const {
    std::vector<GarmentPattern> patterns;
    for (size_t i = 0; i < recipe_.garments.size(); ++i) {
      const JsonView view(recipe_.garments[i],
                          recipe_.name + ": garments[" + std::to_string(i) + "]");
      LARARIUM_ASSIGN_OR_RETURN(const GarmentPattern pattern, ParseFields<GarmentPattern>(view));
      patterns.push_back(pattern);
    }
    return CutGarments(patterns, body_, progress_);
  }

  void AddGarment(Garment garment) {
    for (human::SpringChain& chain : HangTails(garment, human_.skeleton)) {
      human_.springs.push_back(std::move(chain));
    }
    OrderTriangles(garment.mesh);
    AddLevelsOfDetail(garment.mesh);
    if (garment.colour) {
      garment.material.colour_texture = AddTexture(*std::move(garment.colour));
    }
    if (garment.normal) {
      garment.material.normal_texture = AddTexture(*std::move(garment.normal));
    }
    garment.mesh.material = static_cast<int16_t>(human_.materials.size());
    human_.materials.push_back(std::move(garment.material));
    if (garment.cloth) {
      garment.cloth->mesh = static_cast<uint32_t>(human_.meshes.size());
      human_.cloths.push_back(*std::move(garment.cloth));
    }
    human_.meshes.push_back(std::move(garment.mesh));
    if (!garment.credits.empty()) {
      human_.credits += garment.credits + "\n";
    }
  }

  Status AddSkin(std::span<const Garment> garments) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> picture, library_.LoadSkin(SkinName()));
    CastPiece piece = SkinPiece(library_, body_.base);
    LARARIUM_ASSIGN_OR_RETURN(const SkinPaint paint, PaintOf(piece));
    LARARIUM_ASSIGN_OR_RETURN(human::Texture texture, SkinTexture("skin", picture, paint));
    human::Material material;
    material.name = "skin";
    material.surface = human::Surface::kSkin;
    material.roughness = 0.55f;
    material.colour_texture = AddTexture(std::move(texture));
    std::vector<bool> hidden(piece.mesh.positions.size(), false);
    piece.covered = hidden;
    for (const Garment& garment : garments) {
      for (size_t v = 0; v < hidden.size(); ++v) {
        hidden[v] = hidden[v] || garment.hidden[v];
        piece.covered[v] = piece.covered[v] || garment.covered[v];
      }
    }
    RemoveHidden(piece, hidden);
    AddPiece(std::move(piece), std::move(material));
    return Status();
  }

  Result<SkinPaint> PaintOf(const CastPiece& skin) const {
    SkinPaint paint;
    paint.uvs = skin.mesh.uvs;
    paint.indices = skin.mesh.indices;
    paint.tint = recipe_.skin_tint;
    paint.stubble = recipe_.stubble;
    paint.weathering = recipe_.weathering;
    paint.seed = recipe_.seed;
    paint.lids = WhereLidsAre(body_, skin);
    paint.cheeks = WhereCheeksAre(body_, skin);
    if (recipe_.freckles > 0.0f) {
      paint.freckles = WhereFrecklesAre(body_, skin, recipe_.freckles);
    }
    if (recipe_.sunburn > 0.0f) {
      paint.sunburn = WhereTheSunBurns(body_, skin, recipe_.sunburn);
    }
    if (recipe_.hair) {
      LARARIUM_ASSIGN_OR_RETURN(paint.scalp, CoverBy({*recipe_.hair}, skin));
      paint.scalp_colour = paint.beard_colour = HairColour(*recipe_.hair);
    }
    if (recipe_.stubble > 0.0f) {
      LARARIUM_ASSIGN_OR_RETURN(paint.beard, CoverBy({{kBeards[0], {}}, {kBeards[1], {}}}, skin));
      if (!recipe_.beard.empty()) {
        paint.beard_colour = HairColour(recipe_.beard[0]);
      }
    }
    return paint;
  }

  static glm::vec3 HairColour(const CastDyed& hair) {
    return hair.colour.value_or(glm::vec3(0.12f, 0.09f, 0.07f));
  }

  // The share 0..1 of each vertex of the head's skin that these parts cover.
  Result<std::vector<float>> CoverBy(const std::vector<CastDyed>& parts,
                                     const CastPiece& skin) const {
    const float lowest = body_.height - kHeadShare * body_.height;
    std::vector<float> cover(skin.mesh.positions.size(), 0.0f);
    for (const CastDyed& part : parts) {
      LARARIUM_ASSIGN_OR_RETURN(const CastProxy proxy,
                                library_.LoadPart(CastPart::kHair, part.name));
      LARARIUM_ASSIGN_OR_RETURN(const std::string file, TextureFile(CastPart::kHair, proxy));
      Coverage picture;
      if (!file.empty()) {
        LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes,
                                  ReadBytes(proxy.folder / file));
        LARARIUM_ASSIGN_OR_RETURN(picture, CoverageOf(part.name, bytes));
      }
      const CastPiece piece = Fit(CastPart::kHair, part, proxy);
      for (size_t v = 0; v < cover.size(); ++v) {
        if (skin.mesh.positions[v].y > lowest && cover[v] < 1.0f) {
          cover[v] = std::max(cover[v], CoverOver(skin.mesh.positions[v], skin.mesh.normals[v],
                                                  piece.mesh, picture));
        }
      }
    }
    return cover;
  }

  Status AddPart(CastPart part, const CastDyed& chosen) {
    LARARIUM_RETURN_IF_ERROR(Continue());
    if (chosen.name.empty()) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const CastProxy proxy, library_.LoadPart(part, chosen.name));
    const Look look = LookOf(part);
    human::Material material;
    material.name = chosen.name;
    material.surface = look.surface;
    material.roughness = look.roughness;
    material.alpha_cutoff = look.alpha_cutoff;
    material.two_sided = look.two_sided;
    LARARIUM_ASSIGN_OR_RETURN(const std::string file, TextureFile(part, proxy));
    if (!file.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> picture,
                                ReadBytes(proxy.folder / file));
      auto texture = DrawnTexture(part, chosen, picture);
      LARARIUM_RETURN_IF_ERROR(texture.status());
      material.colour_texture = AddTexture(*std::move(texture));
    }
    human_.credits += proxy.credits + "\n";
    CastPiece piece = Fit(part, chosen, proxy);
    if (part == CastPart::kHair) {
      for (human::SpringChain& chain : HangHair(piece, body_, human_.skeleton)) {
        human_.springs.push_back(std::move(chain));
      }
    }
    AddPiece(std::move(piece), std::move(material));
    return Status();
  }

  CastPiece Fit(CastPart part, const CastDyed& chosen, const CastProxy& proxy) const {
    CastPiece piece = FitPart(library_, proxy, body_.base);
    if (part == CastPart::kHair) {
      SmoothSurfaces(piece, {});
      LayHair(piece, body_, {.volume = chosen.volume, .tilt = chosen.tilt});
    } else if (part == CastPart::kEyes || part == CastPart::kTeeth) {
      MakeRigid(piece.mesh);
    }
    return piece;
  }

  static Result<human::Texture> DrawnTexture(CastPart part,
                                             const CastDyed& chosen,
                                             std::span<const std::byte> picture) {
    const Look look = LookOf(part);
    if (part == CastPart::kEyes) {
      return EyeTexture(chosen.name, picture, chosen.colour, look.texture_size);
    }
    return look.alpha_cutoff > 0.0f
               ? DyedTexture(chosen.name, picture, chosen.colour, look.texture_size)
               : OpaqueTexture(chosen.name, picture, look.texture_size);
  }

  // Eyes have several colours to choose from.
  Result<std::string> TextureFile(CastPart part, const CastProxy& proxy) const {
    if (part != CastPart::kEyes) {
      return proxy.mesh.materials.empty() ? std::string() : proxy.mesh.materials[0].colour_texture;
    }
    std::string known;
    for (const CastMaterial& material : proxy.mesh.materials) {
      if (material.name == recipe_.eyes.name) {
        return material.colour_texture;
      }
      known += (known.empty() ? "" : ", ") + material.name;
    }
    return Status::Error(recipe_.name + ": eyes", "there is no colour '" + recipe_.eyes.name + "'",
                         "choose one of: " + known);
  }

  // Orders the triangles for drawing before other arrays depend on the vertex order.
  void AddPiece(CastPiece piece, human::Material material) {
    OrderTriangles(piece.mesh);
    RemoveHidden(piece, std::vector<bool>(piece.mesh.positions.size(), false));
    piece.mesh.material = static_cast<int16_t>(human_.materials.size());
    human_.materials.push_back(std::move(material));
    pieces_.push_back(std::move(piece));
  }

  const CastLibrary& library_;
  const CastRecipe& recipe_;
  const Progress& progress_;
  FittedBody body_;
  human::Human human_;
  std::vector<CastPiece> pieces_;
};

}  // namespace

const BaseGroup* BaseShape::FindGroup(std::string_view name) const {
  const auto found = std::find_if(groups.begin(), groups.end(),
                                  [name](const BaseGroup& group) { return group.name == name; });
  return found == groups.end() ? nullptr : &*found;
}

Result<FittedBody> FitBody(const CastLibrary& library, const CastRecipe& recipe) {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<glm::vec3> positions, ShapeBase(library, recipe));
  FittedBody body;
  LARARIUM_ASSIGN_OR_RETURN(body.skeleton, CastSkeleton(library, positions));
  body.base = ShapeOf(library, std::move(positions), body.skeleton);
  CastPiece skin = SkinPiece(library, body.base);
  body.skin = std::move(skin.mesh);
  body.base_of_skin = std::move(skin.source);
  for (const glm::vec3& p : body.skin.positions) {
    body.height = std::max(body.height, p.y);
  }
  body.capsules = MeasureCapsules(body.skeleton, body.skin);
  return body;
}

Result<human::Human> BuildCast(const CastLibrary& library,
                               const CastRecipe& recipe,
                               const Progress& progress) {
  return CastBuilder(library, recipe, progress).Build();
}

}  // namespace lararium::import
