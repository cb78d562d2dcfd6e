#include "editor/export/web_content.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>

#include "editor/export/opus_sound.h"
#include "shared/human/human.h"
#include "shared/image/decode.h"
#include "shared/image/encode.h"
#include "shared/stage/prop.h"
#include "shared/vision/scene_database.h"

namespace lararium::exporter {
namespace {

// Coefficients of light transfer are multiples of these, which lets them be packed. Those of degree
// 2 say least about the light on a surface.
constexpr int kCoefficientStep = 8;
constexpr int kDegree2Step = 16;
constexpr size_t kToDegree1 = 4;
constexpr size_t kCoefficients = 9;  // Up to degree 2.
// Where a texel of a texture is finer than half of this on the surface, the texture is halved. A
// pixel of a page's picture shows as much from the distance of a metre.
constexpr double kTexelMetres = 0.001;
// Things are drawn at this detail or coarser, metres: viewers look less closely at them.
constexpr float kDetailOfThings = 0.003f;
// Side of textures with transparency, such as hair.
constexpr int kMostTransparentTexels = 256;
constexpr int kFewestTexels = 32;   // Side of a texture that is not halved any more.
constexpr int kColourQuality = 70;  // JPEG's quality of opaque textures, 1 to 100.
constexpr int kNormalsQuality = 85;

// Numbers of vertices and joints are multiples of these, which are powers of two: their last bits
// are zero, and pack well.
constexpr float kMetres = 1.0f / 4096.0f;  // A quarter of a millimetre.
constexpr float kMorphMetres = 1.0f / 16384.0f;
constexpr float kDirection = 1.0f / 256.0f;  // Part of a unit vector.
constexpr float kTexel = 1.0f / 2048.0f;     // Sides of a texture.
constexpr int kAlbedoBits = 6;               // Binary digits behind the first one.
constexpr int kScaleBits = 4;

// The map's parts that tolerate it, too: a descriptor's numbers are known to a tenth or worse, and
// the pixel of an observation only tells which points are neighbours in the image.
constexpr int kDescriptorStep = 16;
constexpr float kObservedPixels = 0.25f;
constexpr int kObservedScaleBits = 3;
constexpr int kNormalBits = 11;
constexpr int kKeyframeQuality = 60;  // JPEG's quality, 1 to 100.
constexpr int kColourBits = 6;

float Rounded(float value, float step) { return std::round(value / step) * step; }

// Rounds to a number of binary digits behind the first one.
float RoundedTo(int bits, float value) {
  int exponent = 0;
  const float fraction = std::frexp(value, &exponent);
  return std::ldexp(std::round(std::ldexp(fraction, bits + 1)), exponent - bits - 1);
}

template <typename Vector>
void RoundAll(std::vector<Vector>& vectors, float step) {
  for (Vector& vector : vectors) {
    for (int i = 0; i < Vector::length(); ++i) {
      vector[i] = Rounded(vector[i], step);
    }
  }
}

void RoundAlbedo(std::vector<glm::vec3>& albedo) {
  for (glm::vec3& colour : albedo) {
    for (int i = 0; i < 3; ++i) {
      colour[i] = std::min(RoundedTo(kAlbedoBits, colour[i]), 1.0f);
    }
  }
}

// Leaves out vertices that a morph moves by less than a step.
void RoundMorph(human::MorphTarget::Part& part) {
  RoundAll(part.position_deltas, kMorphMetres);
  RoundAll(part.normal_deltas, kDirection);
  size_t kept = 0;
  for (size_t i = 0; i < part.vertices.size(); ++i) {
    if (part.position_deltas[i] != glm::vec3(0.0f)) {
      part.vertices[kept] = part.vertices[i];
      part.position_deltas[kept] = part.position_deltas[i];
      part.normal_deltas[kept++] = part.normal_deltas[i];
    }
  }
  part.vertices.resize(kept);
  part.position_deltas.resize(kept);
  part.normal_deltas.resize(kept);
}

// Clips, skin weights and cloth stay as they are: all that moves is then as in a player.
void RoundPerson(human::Human& human) {
  for (human::SkinnedMesh& mesh : human.meshes) {
    RoundAll(mesh.positions, kMetres);
    RoundAll(mesh.normals, kDirection);
    RoundAll(mesh.uvs, kTexel);
    RoundAlbedo(mesh.albedo);
  }
  for (human::MorphTarget& morph : human.morphs) {
    for (human::MorphTarget::Part& part : morph.parts) {
      RoundMorph(part);
    }
    std::erase_if(morph.parts, [](const auto& part) { return part.vertices.empty(); });
  }
}

int8_t Round(int8_t value, int step) {
  const int most = 127 / step * step;
  const int up = value < 0 ? -step / 2 : step / 2;
  return static_cast<int8_t>(std::clamp((value + up) / step * step, -most, most));
}

void ReduceLight(human::LightTransfer& light) {
  const size_t before = static_cast<size_t>(light.count);
  const size_t after = std::min(before, kCoefficients);
  light.count = static_cast<int>(after);
  for (human::LightTransfer::Mesh& mesh : light.meshes) {
    std::vector<int8_t> kept;
    for (size_t i = 0; i < mesh.coefficients.size(); ++i) {
      if (i % before < after) {
        kept.push_back(
            Round(mesh.coefficients[i], i % before < kToDegree1 ? kCoefficientStep : kDegree2Step));
      }
    }
    mesh.coefficients = std::move(kept);
    for (float& scale : mesh.scale) {
      scale = RoundedTo(kScaleBits, scale);
    }
  }
}

// How a texture lies on surfaces.
struct Mapping {
  double square_metres = 0.0;
  double textures = 0.0;  // Area in the texture, which has the area 1.
  bool is_direction = false;
};

void AddTriangles(std::span<const glm::vec3> positions,
                  std::span<const glm::vec2> uvs,
                  std::span<const uint32_t> indices,
                  Mapping& mapping) {
  for (size_t i = 0; i + 2 < indices.size() && !uvs.empty(); i += 3) {
    const auto [a, b, c] = std::tuple(indices[i], indices[i + 1], indices[i + 2]);
    const glm::vec2 u = uvs[b] - uvs[a];
    const glm::vec2 v = uvs[c] - uvs[a];
    mapping.square_metres +=
        0.5 * glm::length(glm::cross(positions[b] - positions[a], positions[c] - positions[a]));
    mapping.textures += 0.5 * std::abs(u.x * v.y - u.y * v.x);
  }
}

// Adds a mesh of a person or prop to the mappings of the textures of its material.
template <typename Mesh>
void AddMesh(const Mesh& mesh,
             std::span<const human::Material> materials,
             std::vector<Mapping>& mappings) {
  if (mesh.material == human::Material::kNone) {
    return;
  }
  const human::Material& material = materials[static_cast<size_t>(mesh.material)];
  for (const int16_t texture : {material.colour_texture, material.normal_texture}) {
    if (texture != human::Material::kNone) {
      AddTriangles(mesh.positions, mesh.uvs, mesh.indices, mappings[static_cast<size_t>(texture)]);
    }
  }
  if (material.normal_texture != human::Material::kNone) {
    mappings[static_cast<size_t>(material.normal_texture)].is_direction = true;
  }
}

int CountHalvings(const Mapping& mapping, const cv::Size& size) {
  int halvings = 0;
  double texel = mapping.textures > 0.0 && mapping.square_metres > 0.0
                     ? std::sqrt(mapping.square_metres / (mapping.textures * size.area()))
                     : kTexelMetres;
  while (2.0 * texel <= kTexelMetres &&
         std::min(size.width, size.height) >> (halvings + 1) >= kFewestTexels) {
    texel *= 2.0;
    ++halvings;
  }
  return halvings;
}

Status ReduceTexture(const Mapping& mapping,
                     const std::string& where,
                     std::shared_ptr<const human::Texture>& texture) {
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image,
                            image::DecodeImage(texture->encoded, image::Channels::kBgra, where));
  cv::Mat alpha;
  cv::extractChannel(image, alpha, 3);
  const bool is_transparent = cv::countNonZero(alpha < 255) > 0;
  double share = 1.0 / (1 << CountHalvings(mapping, image.size()));
  if (is_transparent) {
    share = std::min(
        share, static_cast<double>(kMostTransparentTexels) / std::max(image.cols, image.rows));
  }
  if (share < 1.0) {
    cv::resize(image, image, cv::Size(), share, share, cv::INTER_AREA);
  }
  human::Texture smaller{texture->name, {}};
  if (is_transparent) {
    LARARIUM_ASSIGN_OR_RETURN(smaller.encoded, image::EncodePng(image, 9));
  } else {
    cv::cvtColor(image, image, cv::COLOR_BGRA2BGR);
    LARARIUM_ASSIGN_OR_RETURN(
        smaller.encoded,
        image::EncodeJpeg(image, mapping.is_direction ? kNormalsQuality : kColourQuality));
  }
  if (smaller.encoded.size() < texture->encoded.size()) {
    texture = std::make_shared<const human::Texture>(std::move(smaller));
  }
  return Status();
}

Status ReduceTextures(std::span<const Mapping> mappings,
                      const std::string& where,
                      std::vector<std::shared_ptr<const human::Texture>>& textures) {
  for (size_t i = 0; i < textures.size(); ++i) {
    LARARIUM_RETURN_IF_ERROR(ReduceTexture(mappings[i], where, textures[i]));
  }
  return Status();
}

// What the drama needs of a person: skeleton and clips, and the names of the face's parts.
human::Human MotionOf(const human::Human& human) {
  human::Human motion;
  motion.name = human.name;
  motion.skeleton = human.skeleton;
  motion.skinning = human.skinning;
  for (const human::MorphTarget& morph : human.morphs) {
    motion.morphs.push_back({morph.name, {}});
  }
  motion.face = human.face;
  motion.clips = human.clips;
  return motion;
}

Status ReducePerson(CastContent& cast) {
  LARARIUM_ASSIGN_OR_RETURN(human::Human human,
                            human::ParseHuman(cast.human, "cast '" + cast.name + "'", kWebDetail));
  std::vector<Mapping> mappings(human.textures.size());
  for (const human::SkinnedMesh& mesh : human.meshes) {
    AddMesh(mesh, human.materials, mappings);
  }
  LARARIUM_RETURN_IF_ERROR(ReduceTextures(mappings, "cast '" + cast.name + "'", human.textures));
  ReduceLight(human.light);
  RoundPerson(human);
  cast.motion = human::SerializeHuman(MotionOf(human));
  human.clips.clear();
  cast.human = human::SerializeHuman(human);
  return Status();
}

// For each part, the positions of the vertices that are outermost: along the axes of the part and
// of the object, and from the object's origin. All bounds, and what blocks light, follow from them.
std::vector<std::vector<glm::vec3>> FindOutermost(const stage::Prop& prop) {
  std::vector<std::vector<glm::vec3>> outermost(prop.parts.size());
  std::vector<stage::Pose> object_from_part;
  for (size_t i = 0; i < prop.parts.size(); ++i) {
    const stage::PropPart& part = prop.parts[i];
    object_from_part.push_back(part.parent == stage::PropPart::kNoParent
                                   ? part.parent_from_part
                                   : object_from_part[static_cast<size_t>(part.parent)] *
                                         part.parent_from_part);
    std::vector<glm::vec3> positions;
    for (const stage::PropMesh& mesh : part.meshes) {
      positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    }
    if (positions.empty()) {
      continue;
    }
    const auto keep = [&](auto measure) {
      const auto by = [&](const glm::vec3& a, const glm::vec3& b) {
        return measure(a) < measure(b);
      };
      const auto [low, high] = std::minmax_element(positions.begin(), positions.end(), by);
      outermost[i].insert(outermost[i].end(), {*low, *high});
    };
    const stage::Pose& pose = object_from_part.back();
    for (int axis = 0; axis < 3; ++axis) {
      keep([axis](const glm::vec3& position) { return position[axis]; });
      keep([&](const glm::vec3& position) { return (pose * position)[axis]; });
    }
    outermost[i].push_back(*std::max_element(positions.begin(), positions.end(),
                                             [&](const glm::vec3& a, const glm::vec3& b) {
                                               return glm::length(pose * a) < glm::length(pose * b);
                                             }));
  }
  return outermost;
}

// What the drama needs of a prop: its parts, their bounds and its use.
stage::Prop ExtentOf(const stage::Prop& prop, std::vector<std::vector<glm::vec3>> outermost) {
  stage::Prop extent;
  extent.name = prop.name;
  extent.use = prop.use;
  for (size_t i = 0; i < prop.parts.size(); ++i) {
    const stage::PropPart& part = prop.parts[i];
    extent.parts.push_back({part.name, part.parent, part.parent_from_part, {}});
    if (!outermost[i].empty()) {
      stage::PropMesh& mesh = extent.parts.back().meshes.emplace_back();
      mesh.normals.assign(outermost[i].size(), glm::vec3(0.0f, 1.0f, 0.0f));
      mesh.albedo.assign(outermost[i].size(), glm::vec3(0.0f));
      mesh.positions = std::move(outermost[i]);
    }
  }
  return extent;
}

bool Contains(std::span<const glm::vec3> positions, const glm::vec3& position) {
  return std::find(positions.begin(), positions.end(), position) != positions.end();
}

// The vertices that a mesh's levels of detail use, and those that are outermost, ascending.
std::vector<uint32_t> UsedVertices(const stage::PropMesh& mesh,
                                   std::span<const glm::vec3> outermost) {
  std::vector<bool> used(mesh.positions.size(), false);
  const auto mark = [&](const std::vector<uint32_t>& indices) {
    for (const uint32_t index : indices) {
      used[index] = true;
    }
  };
  mark(mesh.indices);
  for (const human::LevelOfDetail& level : mesh.coarser) {
    mark(level.indices);
  }
  std::vector<uint32_t> vertices;
  for (uint32_t v = 0; v < used.size(); ++v) {
    if (used[v] || Contains(outermost, mesh.positions[v])) {
      vertices.push_back(v);
    }
  }
  return vertices;
}

// Keeps these vertices of an array of `count` vertices with `values` values each, which may be
// repeated for several key poses. Leaves an empty array as it is.
template <typename T>
void KeepVertices(std::span<const uint32_t> vertices,
                  size_t count,
                  size_t values,
                  std::vector<T>& array) {
  std::vector<T> kept;
  for (size_t first = 0; first < array.size(); first += count * values) {
    for (const uint32_t v : vertices) {
      const auto from = array.begin() + static_cast<ptrdiff_t>(first + v * values);
      kept.insert(kept.end(), from, from + static_cast<ptrdiff_t>(values));
    }
  }
  array = std::move(kept);
}

// Leaves out levels of detail that are finer than a page shows, and their vertices.
// The bounds stay as they are. light_count: number of coefficients.
void CutDetail(size_t light_count,
               std::span<const glm::vec3> outermost,
               stage::PropMesh& mesh,
               human::LightTransfer::Mesh* light) {
  const float share = human::ErrorShare(human::Surface::kPlain);
  while (!mesh.coarser.empty() && share * mesh.coarser.front().error <= kDetailOfThings) {
    mesh.indices = std::move(mesh.coarser.front().indices);
    mesh.coarser.erase(mesh.coarser.begin());
  }
  const std::vector<uint32_t> vertices = UsedVertices(mesh, outermost);
  const size_t count = mesh.positions.size();
  std::vector<uint32_t> new_index(count, 0);
  for (uint32_t i = 0; i < vertices.size(); ++i) {
    new_index[vertices[i]] = i;
  }
  const auto rename = [&](std::vector<uint32_t>& indices) {
    for (uint32_t& index : indices) {
      index = new_index[index];
    }
  };
  rename(mesh.indices);
  for (human::LevelOfDetail& level : mesh.coarser) {
    rename(level.indices);
  }
  KeepVertices(vertices, count, 1, mesh.positions);
  KeepVertices(vertices, count, 1, mesh.normals);
  KeepVertices(vertices, count, 1, mesh.albedo);
  KeepVertices(vertices, count, 1, mesh.uvs);
  if (light != nullptr) {
    KeepVertices(vertices, count, 1, light->receivers);
    KeepVertices(vertices, count, 1, light->weights);
    KeepVertices(vertices, count, 1, light->backs);
    KeepVertices(vertices, count, 1, light->scale);
    KeepVertices(vertices, count, 3 * light_count, light->coefficients);
  }
}

Status ReduceProp(ObjectContent& object) {
  LARARIUM_ASSIGN_OR_RETURN(stage::Prop prop,
                            stage::ParseProp(object.prop, "object '" + object.name + "'"));
  const std::vector<std::vector<glm::vec3>> outermost = FindOutermost(prop);
  object.extent = stage::SerializeProp(ExtentOf(prop, outermost));
  size_t lit = 0;
  for (size_t i = 0; i < prop.parts.size(); ++i) {
    for (stage::PropMesh& mesh : prop.parts[i].meshes) {
      CutDetail(static_cast<size_t>(prop.light.count), outermost[i], mesh,
                prop.light.empty() ? nullptr : &prop.light.meshes[lit++]);
    }
  }
  std::vector<Mapping> mappings(prop.textures.size());
  for (const stage::PropPart& part : prop.parts) {
    for (const stage::PropMesh& mesh : part.meshes) {
      AddMesh(mesh, prop.materials, mappings);
    }
  }
  LARARIUM_RETURN_IF_ERROR(ReduceTextures(mappings, "object '" + object.name + "'", prop.textures));
  ReduceLight(prop.light);
  for (stage::PropPart& part : prop.parts) {  // Positions stay, for the sake of the bounds.
    for (stage::PropMesh& mesh : part.meshes) {
      RoundAll(mesh.normals, kDirection);
      RoundAll(mesh.uvs, kTexel);
      RoundAlbedo(mesh.albedo);
    }
  }
  object.prop = stage::SerializeProp(prop);
  return Status();
}

Status ReducePlace(PlaceContent& place) {
  LARARIUM_ASSIGN_OR_RETURN(
      vision::SceneDatabase map,
      vision::ParseSceneDatabase(place.scene, "place '" + place.place.name + "'"));
  for (vision::Descriptor& descriptor : map.descriptors) {
    for (uint8_t& value : descriptor) {
      value = static_cast<uint8_t>(
          std::min((value + kDescriptorStep / 2) / kDescriptorStep * kDescriptorStep,
                   256 - kDescriptorStep));
    }
  }
  for (vision::Observation& observation : map.observations) {
    observation.x = Rounded(observation.x, kObservedPixels);
    observation.y = Rounded(observation.y, kObservedPixels);
    observation.scale = RoundedTo(kObservedScaleBits, observation.scale);
  }
  const auto round = [](std::vector<Eigen::Vector3f>& vectors, int bits) {
    for (Eigen::Vector3f& vector : vectors) {
      vector = vector.unaryExpr([bits](float value) { return RoundedTo(bits, value); });
    }
  };
  round(map.normals, kNormalBits);
  round(map.colours, kColourBits);
  map.forest = vision::BuildForest(map.descriptors, {});
  place.scene = vision::SerializeSceneDatabase(map, kKeyframeQuality);
  return Status();
}

// Leaves a sound as it is if Opus does not make it smaller.
Result<std::vector<std::byte>> Smaller(std::span<const std::byte> sound, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> opus, EncodeOpus(sound, where));
  return opus.size() < sound.size() ? std::move(opus)
                                    : std::vector<std::byte>(sound.begin(), sound.end());
}

Status ReduceLine(SpokenContent& line) {
  if (!line.sound.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(line.sound, Smaller(line.sound, "line '" + line.line + "'"));
  }
  return Status();
}

Status ReduceSound(audio::SoundData& sound) {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> smaller,
                            Smaller(sound.bytes, "sound '" + sound.name + "'"));
  const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(smaller));
  sound.bytes = *owner;
  sound.owner = owner;
  return Status();
}

}  // namespace

Status ReduceForWeb(ExportContent& content, Progress& progress) {
  const auto count =
      static_cast<double>(content.places.size() + content.cast.size() + content.objects.size() +
                          content.lines.size() + content.sounds.size());
  double done = 0.0;
  const auto reduce = [&](auto& parts, auto reduce_part) -> Status {
    for (auto& part : parts) {
      progress.Report("reducing", done++ / count);
      if (progress.Cancelled()) {
        return Status::Error("export", "cancelled");
      }
      LARARIUM_RETURN_IF_ERROR(reduce_part(part));
    }
    return Status();
  };
  // The page writes captions with the browser's letters.
  content.caption_metrics.clear();
  content.caption_atlas.clear();
  LARARIUM_RETURN_IF_ERROR(reduce(content.places, ReducePlace));
  LARARIUM_RETURN_IF_ERROR(reduce(content.cast, ReducePerson));
  LARARIUM_RETURN_IF_ERROR(reduce(content.objects, ReduceProp));
  LARARIUM_RETURN_IF_ERROR(reduce(content.lines, ReduceLine));
  return reduce(content.sounds, ReduceSound);
}

}  // namespace lararium::exporter
