#pragma once

// A cast library of a few vertices: every bone that the skeleton needs, each at its own vertex,
// a body of two quads and a few targets.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "shared/core/json.h"

namespace lararium::import::tiny {

class TinyCastLibrary {
 public:
  explicit TinyCastLibrary(std::filesystem::path folder) : folder_(std::move(folder)) {
    AddBones();
    base_["vertices"] = Json::array();
    for (size_t v = 0; v < vertex_count(); ++v) {
      for (const double coordinate :
           {0.1 * static_cast<double>(v % 7), 0.2 * static_cast<double>(v),
            0.1 * static_cast<double>(v % 5)}) {
        base_["vertices"].push_back(coordinate);
      }
    }
    base_["uvs"] = Json::array({Json::array({0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0})});
    base_["materials"] = Json::array({{{"DbgName", "body"}}});
    base_["faces"] = {11, 0, 1, 2, 3, 0, 0, 1, 2, 3, 11, 3, 2, 4, 5, 0, 0, 1, 2, 3};
    base_["skinWeights"] = Json::array();
    base_["skinIndices"] = Json::array();
    for (size_t v = 0; v < vertex_count(); ++v) {
      for (int k = 0; k < 4; ++k) {
        base_["skinWeights"].push_back(k == 0 ? 1.0 : 0.0);
        base_["skinIndices"].push_back(k == 0 ? v : 0);
      }
    }
    for (const char* target :
         {"macrodetails/caucasian-male-young", "macrodetails/african-male-young",
          "macrodetails/caucasian-female-child",
          "macrodetails/universal-male-young-maxmuscle-minweight", "nose/nose-hump-lesshump",
          "nose/nose-hump-morehump", "eyes/l-eye-size-big", "eyes/r-eye-size-big"}) {
      targets_.emplace_back(target);
    }
    modifiers_ = Json::parse(R"([
      {"group": "nose", "modifiers": [{"target": "nose-hump", "min": "lesshump", "max": "morehump"}]},
      {"group": "eyes", "modifiers": [{"target": "l-eye-size", "min": "small", "max": "big"},
                                      {"target": "r-eye-size", "min": "small", "max": "big"}]}])");
  }

  size_t vertex_count() const { return bones_.size(); }
  Json& base() { return base_; }
  Json& rig() { return rig_; }
  size_t target_bytes() const { return targets_.size() * vertex_count() * 3 * sizeof(int16_t); }

  // `surplus` is the number of extra bytes in the file of the targets.
  void Write(int surplus = 0) const {
    WriteFile("public/data/models/human_full_size.json", base_.dump());
    WriteFile("src/json/rigs/default.json", rig_.dump());
    Json list = {{"targets", Json::object()}};
    for (const std::string& target : targets_) {
      list["targets"]["data/targets/" + target + ".target"] = Json::array();
    }
    WriteFile("src/json/targets/target-list.json", list.dump());
    WriteFile("src/json/modifiers/modeling_modifiers.json", modifiers_.dump());
    WriteFile("src/json/modifiers/measurement_modifiers.json", "[]");
    WriteFile("public/data/targets/targets.bin",
              std::string(static_cast<size_t>(static_cast<int>(target_bytes()) + surplus), '\1'));
  }

 private:
  void AddBones() {
    AddBone("root", "");
    AddBone("pelvis.L", "root");
    AddBone("pelvis.R", "root");
    std::string parent = "root";
    for (const char* bone :
         {"spine05", "spine04", "spine03", "spine02", "spine01", "neck01", "neck02", "neck03",
          "head", "jaw", "tongue00", "tongue01", "tongue03", "special04"}) {
      AddBone(bone, parent);
      parent = bone;
    }
    for (const std::string side : {".L", ".R"}) {
      for (const char* bone :
           {"eye", "clavicle", "shoulder01", "upperarm01", "lowerarm01", "wrist", "metacarpal1",
            "metacarpal2", "metacarpal3", "metacarpal4", "upperleg01", "lowerleg01", "foot",
            "toe1-1", "toe2-1", "toe3-1", "toe4-1", "toe5-1"}) {
        AddBone(bone + side, "root");
      }
      for (int finger = 1; finger <= 5; ++finger) {
        for (int bone = 1; bone <= 3; ++bone) {
          AddBone("finger" + std::to_string(finger) + "-" + std::to_string(bone) + side, "root");
        }
      }
    }
  }

  void AddBone(const std::string& name, const std::string& parent) {
    const std::string head = name + "____head";
    rig_["joints"][head] = Json::array({bones_.size()});
    rig_["bones"][name] = {{"head", head}, {"parent", parent.empty() ? Json() : Json(parent)}};
    base_["bones"].push_back({{"name", head}});
    bones_.push_back(name);
  }

  void WriteFile(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << content;
  }

  std::filesystem::path folder_;
  std::vector<std::string> bones_;
  std::vector<std::string> targets_;
  Json base_ = Json::object();
  Json rig_ = Json::object();
  Json modifiers_;
};

}  // namespace lararium::import::tiny
