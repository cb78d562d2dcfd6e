#include "editor/import/model/built_model.h"

#include <algorithm>
#include <cstring>

#include "shared/core/json.h"

namespace lararium::import {
namespace {

void AppendBlock(std::vector<std::byte>& bytes, std::span<const std::byte> block) {
  const uint64_t size = block.size();
  const auto* begin = reinterpret_cast<const std::byte*>(&size);
  bytes.insert(bytes.end(), begin, begin + sizeof(size));
  bytes.insert(bytes.end(), block.begin(), block.end());
}

// Takes the next block; empty, and at the end of the data, if there is none.
std::span<const std::byte> TakeBlock(std::span<const std::byte>& bytes) {
  uint64_t size = 0;
  if (bytes.size() < sizeof(size)) {
    return bytes = {};
  }
  std::memcpy(&size, bytes.data(), sizeof(size));
  bytes = bytes.subspan(sizeof(size));
  if (size > bytes.size()) {
    return bytes = {};
  }
  const auto block = bytes.first(size);
  bytes = bytes.subspan(size);
  return block;
}

}  // namespace

Result<std::vector<std::byte>> PackModel(const BuiltModel& model) {
  Json head = {
      {"bones", model.bones},    {"is_human", model.is_human},     {"bone_table", model.bone_table},
      {"notes", model.notes},    {"images", Json::array()},        {"uses", Json::array()},
      {"joints", Json::array()}, {"bone_names", model.bone_names}, {"emissions", Json::array()}};
  for (const NamedBone& named : model.joints) {
    head["joints"].push_back(
        {named.joint, named.bone, static_cast<int>(named.found_by), named.confidence});
  }
  for (const ModelImage& image : model.images) {
    head["images"].push_back(image.name);
  }
  for (const TextureUse& use : model.uses) {
    head["uses"].push_back({use.colour, use.normal});
  }
  for (const glm::vec3& emission : model.emissions) {
    head["emissions"].push_back({emission.x, emission.y, emission.z});
  }
  const std::string text = DumpJson(head);
  std::vector<std::byte> bytes;
  AppendBlock(bytes, std::as_bytes(std::span(text)));
  AppendBlock(bytes, human::SerializeHuman(model.human));
  for (const ModelImage& image : model.images) {
    AppendBlock(bytes, image.encoded);
  }
  return bytes;
}

Result<BuiltModel> UnpackModel(std::span<const std::byte> bytes, const std::string& where) {
  const auto text = TakeBlock(bytes);
  LARARIUM_ASSIGN_OR_RETURN(
      const Json head, ParseJson({reinterpret_cast<const char*>(text.data()), text.size()}, where));
  BuiltModel model;
  LARARIUM_ASSIGN_OR_RETURN(model.human, human::ParseHuman(TakeBlock(bytes), where));
  // PackModel wrote this in the child process, which a hostile file may have taken over.
  try {
    model.bones = head.at("bones").get<BoneNames>();
    model.is_human = head.at("is_human").get<bool>();
    model.bone_table = head.at("bone_table").get<std::string>();
    model.bone_names = head.at("bone_names").get<std::vector<std::string>>();
    for (const Json& named : head.at("joints")) {
      const int found_by =
          std::clamp(named.at(2).get<int>(), 0, static_cast<int>(FoundBy::kStructure));
      model.joints.push_back({named.at(0).get<std::string>(), named.at(1).get<std::string>(),
                              static_cast<FoundBy>(found_by), named.at(3).get<float>()});
    }
    model.notes = head.at("notes").get<std::vector<std::string>>();
    for (const Json& name : head.at("images")) {
      const auto block = TakeBlock(bytes);
      model.images.push_back({name.get<std::string>(), {block.begin(), block.end()}});
    }
    const auto images = static_cast<int>(model.images.size());
    for (const Json& use : head.at("uses")) {
      model.uses.push_back({use.at(0).get<int>(), use.at(1).get<int>()});
      if (model.uses.back().colour >= images || model.uses.back().normal >= images) {
        return Status::Error(where, "its reader returned invalid data");
      }
    }
    for (const Json& emission : head.at("emissions")) {
      model.emissions.emplace_back(emission.at(0).get<float>(), emission.at(1).get<float>(),
                                   emission.at(2).get<float>());
    }
  } catch (const Json::exception&) {
    return Status::Error(where, "its reader returned invalid data");
  }
  if (model.uses.size() != model.human.materials.size() ||
      model.emissions.size() != model.human.materials.size()) {
    return Status::Error(where, "its reader returned invalid data");
  }
  return model;
}

}  // namespace lararium::import
