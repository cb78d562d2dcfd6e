#include "editor/import/cast/cast_mesh.h"

#include <cmath>

#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::import {
namespace {

// Flags of a face record.
constexpr uint32_t kQuad = 1;
constexpr uint32_t kMaterial = 2;
constexpr uint32_t kFaceUv = 4;
constexpr uint32_t kVertexUvs = 8;
constexpr uint32_t kFaceNormal = 16;
constexpr uint32_t kVertexNormals = 32;
constexpr uint32_t kFaceColour = 64;
constexpr uint32_t kVertexColours = 128;
constexpr size_t kMaxNumbers = 8 * kMaxCastVertices;

Result<float> ToNumber(const JsonView& list, const Json& value) {
  if (!value.is_number()) {
    return list.Problem("must hold numbers only", kFetchAgain);
  }
  const float number = value.get<float>();
  if (!std::isfinite(number)) {
    return list.Problem("must hold finite numbers only", kFetchAgain);
  }
  return number;
}

Status AppendIndices(const JsonView& list,
                     const Json& array,
                     size_t limit,
                     size_t max_count,
                     int depth,
                     std::vector<uint32_t>& indices) {
  for (const Json& value : array) {
    if (value.is_array() && depth < 1) {
      LARARIUM_RETURN_IF_ERROR(AppendIndices(list, value, limit, max_count, depth + 1, indices));
      continue;
    }
    if (!value.is_number_unsigned() || value.get<uint64_t>() >= limit) {
      return list.Problem("must hold indices below " + std::to_string(limit), kFetchAgain);
    }
    if (indices.size() == max_count) {
      return list.Problem("has more than " + std::to_string(max_count) + " indices", kFetchAgain);
    }
    indices.push_back(static_cast<uint32_t>(value.get<uint64_t>()));
  }
  return Status();
}

// Reads the records of variable length in which faces are stored.
class FaceReader {
 public:
  FaceReader(const JsonView& place, const std::vector<uint32_t>& records, const CastMesh& mesh)
      : place_(place), records_(records), mesh_(mesh) {}

  bool done() const { return next_ == records_.size(); }

  Result<CastFace> Read() {
    LARARIUM_ASSIGN_OR_RETURN(const uint32_t flags, Take(256));
    const size_t corners = flags & kQuad ? 4 : 3;
    CastFace face;
    LARARIUM_RETURN_IF_ERROR(TakeCorners(corners, mesh_.positions.size(), face.vertices));
    if (flags & kMaterial) {
      LARARIUM_ASSIGN_OR_RETURN(face.material, Take(std::max<size_t>(mesh_.materials.size(), 1)));
    }
    LARARIUM_RETURN_IF_ERROR(Skip(flags & kFaceUv ? 1 : 0));
    if (flags & kVertexUvs) {
      LARARIUM_RETURN_IF_ERROR(TakeCorners(corners, mesh_.uvs.size(), face.uvs));
    }
    LARARIUM_RETURN_IF_ERROR(Skip(flags & kFaceNormal ? 1 : 0));
    LARARIUM_RETURN_IF_ERROR(Skip(flags & kVertexNormals ? corners : 0));
    LARARIUM_RETURN_IF_ERROR(Skip(flags & kFaceColour ? 1 : 0));
    LARARIUM_RETURN_IF_ERROR(Skip(flags & kVertexColours ? corners : 0));
    return face;
  }

 private:
  Result<uint32_t> Take(size_t limit) {
    if (next_ == records_.size()) {
      return place_.Problem("the last face is cut short", kFetchAgain);
    }
    const uint32_t value = records_[next_++];
    if (value >= limit) {
      return place_.Problem("a face refers to data that do not exist", kFetchAgain);
    }
    return value;
  }

  Status TakeCorners(size_t corners, size_t limit, std::array<uint32_t, 4>& out) {
    for (size_t i = 0; i < corners; ++i) {
      LARARIUM_ASSIGN_OR_RETURN(out[i], Take(limit));
    }
    if (corners == 3) {
      out[3] = out[2];
    }
    return Status();
  }

  Status Skip(size_t count) {
    if (records_.size() - next_ < count) {
      return place_.Problem("the last face is cut short", kFetchAgain);
    }
    next_ += count;
    return Status();
  }

  const JsonView& place_;
  const std::vector<uint32_t>& records_;
  const CastMesh& mesh_;
  size_t next_ = 0;
};

// Describes a material, for reading.
void DescribeMaterial(Fields& fields, CastMaterial& material) {
  fields.Text("DbgName", material.name, 200);
  fields.Text(Optional("mapDiffuse"), material.colour_texture, 500);
  fields.Numbers(Optional("colorDiffuse"), std::span(&material.colour.x, 3));
}

// `uvs` is a list of layers; only the first is used.
Result<std::vector<glm::vec2>> ReadUvs(const JsonView& model) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView layers, model.Field("uvs"));
  std::vector<glm::vec2> uvs;
  if (!layers.json().is_array()) {
    return layers.Problem("must be a list of layers", kFetchAgain);
  }
  if (layers.json().empty()) {
    return uvs;
  }
  const Json& layer = layers.json().front();
  if (!layer.is_array() || layer.size() % 2 != 0 || layer.size() > kMaxNumbers) {
    return layers.Problem("must hold pairs of numbers", kFetchAgain);
  }
  uvs.reserve(layer.size() / 2);
  for (size_t i = 0; i < layer.size(); i += 2) {
    LARARIUM_ASSIGN_OR_RETURN(const float u, ToNumber(layers, layer[i]));
    LARARIUM_ASSIGN_OR_RETURN(const float v, ToNumber(layers, layer[i + 1]));
    uvs.emplace_back(u, v);
  }
  return uvs;
}

}  // namespace

Result<std::vector<float>> ReadNumbers(const JsonView& object,
                                       std::string_view key,
                                       size_t stride,
                                       size_t max_count) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView list, object.Field(key));
  if (!list.json().is_array() || list.json().size() % stride != 0 ||
      list.json().size() > max_count) {
    return list.Problem("must be a list of at most " + std::to_string(max_count) +
                            " numbers, a multiple of " + std::to_string(stride),
                        kFetchAgain);
  }
  std::vector<float> numbers;
  numbers.reserve(list.json().size());
  for (const Json& value : list.json()) {
    LARARIUM_ASSIGN_OR_RETURN(const float number, ToNumber(list, value));
    numbers.push_back(number);
  }
  return numbers;
}

Result<std::vector<glm::vec3>> ReadRows(const JsonView& object,
                                        std::string_view key,
                                        size_t count) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView list, object.Field(key));
  if (!list.json().is_array() || list.json().size() != count) {
    return list.Problem("must be a list of " + std::to_string(count) + " rows", kFetchAgain);
  }
  std::vector<glm::vec3> rows;
  rows.reserve(count);
  for (const Json& row : list.json()) {
    if (!row.is_array() || row.size() != 3) {
      return list.Problem("must hold rows of three numbers", kFetchAgain);
    }
    glm::vec3 value;
    for (int axis = 0; axis < 3; ++axis) {
      LARARIUM_ASSIGN_OR_RETURN(value[axis], ToNumber(list, row[axis]));
    }
    rows.push_back(value);
  }
  return rows;
}

Result<std::vector<uint32_t>> ReadIndices(const JsonView& object,
                                          std::string_view key,
                                          size_t limit,
                                          size_t max_count) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView list, object.Field(key));
  if (!list.json().is_array()) {
    return list.Problem("must be a list", kFetchAgain);
  }
  std::vector<uint32_t> indices;
  LARARIUM_RETURN_IF_ERROR(AppendIndices(list, list.json(), limit, max_count, 0, indices));
  return indices;
}

Result<CastMesh> ReadCastMesh(const JsonView& model) {
  CastMesh mesh;
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<float> numbers,
                            ReadNumbers(model, "vertices", 3, 3 * kMaxCastVertices));
  for (size_t i = 0; i < numbers.size(); i += 3) {
    mesh.positions.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  }
  LARARIUM_ASSIGN_OR_RETURN(mesh.uvs, ReadUvs(model));
  const auto describe = [&](Fields& fields) {
    fields.List(Optional("materials"), mesh.materials, 1000, DescribeMaterial);
  };
  LARARIUM_RETURN_IF_ERROR(ReadFields(model, describe, UnknownFields::kIgnore));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView faces, model.Field("faces"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<uint32_t> records,
                            ReadIndices(model, "faces", size_t{1} << 31, 2 * kMaxNumbers));
  FaceReader reader(faces, records, mesh);
  while (!reader.done()) {
    LARARIUM_ASSIGN_OR_RETURN(const CastFace face, reader.Read());
    mesh.faces.push_back(face);
  }
  return mesh;
}

}  // namespace lararium::import
