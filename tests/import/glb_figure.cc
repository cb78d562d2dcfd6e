#include "tests/import/glb_figure.h"

#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lararium::test {
namespace {

void Append(std::vector<std::byte>& bytes, const void* data, size_t size) {
  const auto* begin = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), begin, begin + size);
}

void AppendU32(std::vector<std::byte>& bytes, uint32_t value) { Append(bytes, &value, 4); }

std::vector<float> Floats(const glm::vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

size_t GlbFigure::AddBytes(const std::vector<std::byte>& bytes) {
  binary.resize((binary.size() + 3) / 4 * 4);
  json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
  binary.insert(binary.end(), bytes.begin(), bytes.end());
  json["buffers"] = Json::array({{{"byteLength", binary.size()}}});
  return json["bufferViews"].size() - 1;
}

size_t GlbFigure::AddFloats(const std::vector<float>& values, size_t components) {
  std::vector<std::byte> bytes;
  Append(bytes, values.data(), values.size() * sizeof(float));
  const size_t view = AddBytes(bytes);
  const char* type = components == 1   ? "SCALAR"
                     : components == 2 ? "VEC2"
                     : components == 3 ? "VEC3"
                     : components == 4 ? "VEC4"
                                       : "MAT4";
  json["accessors"].push_back({{"bufferView", view},
                               {"componentType", 5126},
                               {"count", values.size() / components},
                               {"type", type}});
  return json["accessors"].size() - 1;
}

std::vector<std::byte> GlbFigure::Glb() const {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::vector<std::byte> data = binary;
  data.resize((data.size() + 3) / 4 * 4);
  std::vector<std::byte> bytes;
  AppendU32(bytes, 0x46546c67);
  AppendU32(bytes, 2);
  AppendU32(bytes, static_cast<uint32_t>(12 + 8 + text.size() + 8 + data.size()));
  AppendU32(bytes, static_cast<uint32_t>(text.size()));
  AppendU32(bytes, 0x4e4f534a);
  Append(bytes, text.data(), text.size());
  AppendU32(bytes, static_cast<uint32_t>(data.size()));
  AppendU32(bytes, 0x004e4942);
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

GlbFigure MakeGlbFigure(const human::Skeleton& skeleton, const GlbFigureOptions& options) {
  GlbFigure figure;
  Json& json = figure.json;
  json["asset"] = {{"version", "2.0"}};
  json["accessors"] = Json::array();
  json["bufferViews"] = Json::array();
  std::vector<float> positions, normals, weights, matrices;
  std::vector<std::byte> joints;
  Json nodes = Json::array(), skin_joints = Json::array();
  const float unit = glm::length(glm::vec3(options.file_from_actor[0]));
  for (size_t j = 0; j < skeleton.size(); ++j) {
    const auto at = [&](size_t joint) {
      const glm::vec3 p = -glm::vec3(skeleton.joint_from_actor[joint][3]);
      return glm::vec3(options.file_from_actor * glm::vec4(p, 1.0f));
    };
    const int16_t parent = skeleton.parents[j];
    const glm::vec3 base = parent < 0 ? glm::vec3(0.0f) : at(static_cast<size_t>(parent));
    nodes.push_back(
        {{"name", options.name(skeleton.names[j])}, {"translation", Floats(at(j) - base)}});
    if (parent >= 0) {
      nodes[static_cast<size_t>(parent)]["children"].push_back(j);
    }
    skin_joints.push_back(j);
    for (int corner = 0; corner < 3; ++corner) {
      glm::vec3 p = -glm::vec3(skeleton.joint_from_actor[j][3]);
      p[corner] += 0.02f;
      p = glm::vec3(options.file_from_actor * glm::vec4(p, 1.0f));
      const glm::vec3 n = glm::mat3(options.file_from_actor) * glm::vec3(0, 1, 0) / unit;
      for (int c = 0; c < 3; ++c) {
        positions.push_back(p[c]);
        normals.push_back(n[c]);
        weights.push_back(c == 0 ? 1.0f : 0.0f);
      }
      weights.push_back(0.0f);
      for (int c = 0; c < 4; ++c) {
        joints.push_back(static_cast<std::byte>(c == 0 ? j : 0));
      }
    }
    glm::mat4 inverse_bind(1.0f);
    inverse_bind[3] = glm::vec4(-at(j), 1.0f);
    for (int c = 0; c < 16; ++c) {
      matrices.push_back(inverse_bind[c / 4][c % 4]);
    }
  }
  nodes.push_back({{"name", "figure"}, {"mesh", 0}, {"skin", 0}});
  Json attributes;
  attributes["POSITION"] = figure.AddFloats(positions, 3);
  attributes["NORMAL"] = figure.AddFloats(normals, 3);
  attributes["WEIGHTS_0"] = figure.AddFloats(weights, 4);
  const size_t view = figure.AddBytes(joints);
  json["accessors"].push_back({{"bufferView", view},
                               {"componentType", 5121},
                               {"count", joints.size() / 4},
                               {"type", "VEC4"}});
  attributes["JOINTS_0"] = json["accessors"].size() - 1;
  json["skins"] = Json::array(
      {{{"joints", skin_joints}, {"inverseBindMatrices", figure.AddFloats(matrices, 16)}}});
  json["meshes"] = Json::array(
      {{{"name", "figure"}, {"primitives", Json::array({{{"attributes", attributes}}})}}});
  json["scenes"] = Json::array({{{"nodes", {0, nodes.size() - 1}}}});
  json["scene"] = 0;
  json["nodes"] = std::move(nodes);
  return figure;
}

}  // namespace lararium::test
