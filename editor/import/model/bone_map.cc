#include "editor/import/model/bone_map.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <sstream>

#include "editor/import/model/bone_structure.h"
#include "editor/import/model/joint_names.h"
#include "shared/core/file.h"
#include "shared/core/json.h"

namespace lararium::import {
namespace {

constexpr size_t kMaxNamesBytes = size_t{1} << 20;
// Bones between limbs can hardly be anything else than the trunk.
constexpr float kTrunkConfidence = 0.9f;

constexpr const char* kNeeded[] = {"humanoid_root", "skullbase", "r_shoulder", "r_elbow", "r_wrist",
                                   "l_shoulder",    "l_elbow",   "l_wrist",    "r_hip",   "r_knee",
                                   "r_ankle",       "l_hip",     "l_knee",     "l_ankle"};
constexpr const char* kFingers[] = {"thumb", "index", "middle", "ring", "pinky"};

// Joint names of a spine or neck with `count` joints, from below.
const std::vector<const char*>& SpineNames(size_t count) {
  static const std::vector<const char*> kNames[] = {
      {},
      {"vl5"},
      {"vl5", "vt4"},
      {"vl5", "vt10", "vt4"},
      {"vl5", "vl2", "vt10", "vt4"},
      {"vl5", "vl2", "vt12", "vt8", "vt4"},
      {"vl5", "vl3", "vl1", "vt10", "vt7", "vt4"},
      {"vl5", "vl4", "vl3", "vl1", "vt10", "vt7", "vt4"},
      {"vl5", "vl4", "vl3", "vl2", "vl1", "vt10", "vt7", "vt4"}};
  return kNames[std::min(count, std::size(kNames) - 1)];
}

const std::vector<const char*>& NeckNames(size_t count) {
  static const std::vector<const char*> kNames[] = {
      {}, {"vc4"}, {"vc7", "vc4"}, {"vc7", "vc4", "vc2"}, {"vc7", "vc6", "vc4", "vc2"}};
  return kNames[std::min(count, std::size(kNames) - 1)];
}

const std::set<std::string, std::less<>>& KnownJoints() {
  static const std::set<std::string, std::less<>> kKnown = [] {
    std::set<std::string, std::less<>> known = {"humanoid_root", "sacroiliac", "skullbase",
                                                "temporomandibular"};
    for (size_t count = 1; count <= 8; ++count) {
      known.insert(SpineNames(count).begin(), SpineNames(count).end());
      known.insert(NeckNames(count).begin(), NeckNames(count).end());
    }
    for (const std::string side : {"r_", "l_"}) {
      for (const char* joint : {"sternoclavicular", "acromioclavicular", "shoulder", "elbow",
                                "wrist", "hip", "knee", "ankle", "midtarsal", "eyeball_joint"}) {
        known.insert(side + joint);
      }
      for (const char* finger : kFingers) {
        for (const char* segment : {"0", "1", "2", "3"}) {
          known.insert(side + finger + segment);
        }
      }
    }
    return known;
  }();
  return kKnown;
}

std::string SideName(BodySide side) { return side == BodySide::kRight ? "r_" : "l_"; }

class Mapper {
 public:
  explicit Mapper(const Rig& rig) : rig_(rig), used_(rig.size(), false) {
    for (const std::string& name : rig.names) {
      parsed_.push_back(ParseBoneName(name));
    }
  }

  BoneMap Map(const std::vector<GivenBones>& given) {
    for (const GivenBones& bones : given) {
      AddGiven(bones);
    }
    for (const BodySide side : {BodySide::kRight, BodySide::kLeft}) {
      AddArmByName(side);
      AddLegByName(side);
      AddFingersByName(side);
    }
    AddByName("skullbase", BodySide::kMiddle, {BonePart::kHead});
    AddByStructure();
    AddPelvisAndSpine();
    AddNeckAndFace();
    return std::move(map_);
  }

 private:
  int BoneOf(const std::string& joint) const {
    const MappedBone* mapped = map_.Find(joint);
    return mapped == nullptr ? Rig::kNoParent : static_cast<int>(mapped->bone);
  }
  const BoneName& Parsed(int bone) const { return parsed_[static_cast<size_t>(bone)]; }
  bool Has(const std::string& joint) const {
    return map_.Find(joint) != nullptr || absent_.contains(joint);
  }

  void Add(const std::string& joint, int bone, FoundBy found_by, float confidence) {
    if (bone != Rig::kNoParent && !used_[static_cast<size_t>(bone)] && !Has(joint)) {
      used_[static_cast<size_t>(bone)] = true;
      map_.bones.push_back({joint, static_cast<size_t>(bone), found_by, confidence});
    }
  }

  void AddGiven(const GivenBones& given) {
    for (const auto& [joint, bone] : given.bones) {
      if (bone == Rig::kNoParent) {
        absent_.insert(joint);
      } else {
        Add(joint, bone, given.found_by, 1.0f);
      }
    }
  }

  // The bone nearest to the root that has the first of these parts that exists.
  int FindPart(BodySide side, const std::vector<BonePart>& parts, int below) const {
    for (const BonePart part : parts) {
      for (size_t bone = 0; bone < rig_.size(); ++bone) {
        const bool fits = parsed_[bone].part == part && parsed_[bone].side == side && !used_[bone];
        if (fits && (below == Rig::kNoParent || rig_.IsBelow(below, static_cast<int>(bone)))) {
          return static_cast<int>(bone);
        }
      }
    }
    return Rig::kNoParent;
  }

  int AddByName(const std::string& joint,
                BodySide side,
                const std::vector<BonePart>& parts,
                int below = Rig::kNoParent) {
    if (!Has(joint)) {
      Add(joint, FindPart(side, parts, below), FoundBy::kName, 1.0f);
    }
    return BoneOf(joint);
  }

  // "Shoulder" is the upper arm if there is no other bone for it, otherwise the clavicle.
  void AddArmByName(BodySide side) {
    const std::string s = SideName(side);
    const int shoulder =
        AddByName(s + "shoulder", side, {BonePart::kUpperArm, BonePart::kShoulder});
    const int elbow = AddByName(s + "elbow", side, {BonePart::kForearm}, shoulder);
    AddByName(s + "wrist", side, {BonePart::kHand}, elbow);
    const int clavicle = FindPart(side, {BonePart::kClavicle, BonePart::kShoulder}, Rig::kNoParent);
    if (clavicle != Rig::kNoParent && shoulder != Rig::kNoParent &&
        rig_.IsBelow(clavicle, shoulder)) {
      Add(s + "sternoclavicular", clavicle, FoundBy::kName, 1.0f);
    }
  }

  // "Leg" is the thigh if there is also a shin, otherwise the shin. "Hip" is the thigh if there
  // is no other bone for it.
  void AddLegByName(BodySide side) {
    const std::string s = SideName(side);
    const bool has_shin = FindPart(side, {BonePart::kShin}, Rig::kNoParent) != Rig::kNoParent;
    std::vector<BonePart> thigh = {BonePart::kThigh};
    if (has_shin) {
      thigh.push_back(BonePart::kLeg);
    }
    thigh.push_back(BonePart::kHip);
    const int hip = AddByName(s + "hip", side, thigh);
    const int knee = AddByName(s + "knee", side, {BonePart::kShin, BonePart::kLeg}, hip);
    const int ankle = AddByName(s + "ankle", side, {BonePart::kFoot}, knee);
    AddByName(s + "midtarsal", side, {BonePart::kToes}, ankle);
    if (ankle != Rig::kNoParent && !Has(s + "midtarsal")) {
      // The only bone below a foot: the ball or the end of the toes.
      const std::vector<int> below = rig_.Children()[static_cast<size_t>(ankle)];
      if (below.size() == 1) {
        Add(s + "midtarsal", below[0], FoundBy::kStructure, 0.5f);
      }
    }
  }

  void AddFingersByName(BodySide side) {
    for (size_t bone = 0; bone < rig_.size(); ++bone) {
      const BoneName& name = parsed_[bone];
      if (name.side == side && name.part >= BonePart::kThumb && name.part <= BonePart::kLittle) {
        const auto finger = static_cast<size_t>(name.part) - static_cast<size_t>(BonePart::kThumb);
        Add(SideName(side) + kFingers[finger] + std::to_string(name.segment),
            static_cast<int>(bone), FoundBy::kName, 1.0f);
      }
    }
    AddByName(SideName(side) + "eyeball_joint", side, {BonePart::kEye});
  }

  // Takes a limb as a whole, because one half by name and the other by shape rarely fit.
  void AddByStructure() {
    const std::vector<MappedBone> found = MapByStructure(rig_);
    for (const std::string side : {"r_", "l_"}) {
      TakeLimb(found, {side + "shoulder", side + "elbow", side + "wrist"}, side);
      TakeLimb(found, {side + "hip", side + "knee", side + "ankle"}, side);
    }
    Take(found, "skullbase");
  }

  void Take(const std::vector<MappedBone>& found, const std::string& joint) {
    for (const MappedBone& mapped : found) {
      if (mapped.joint == joint) {
        Add(joint, static_cast<int>(mapped.bone), FoundBy::kStructure, mapped.confidence);
      }
    }
  }

  void TakeLimb(const std::vector<MappedBone>& found,
                const std::array<std::string, 3>& limb,
                const std::string& side) {
    const bool whole = std::all_of(limb.begin(), limb.end(), [&](const std::string& joint) {
      return map_.Find(joint) != nullptr;
    });
    const bool has_structure = std::all_of(limb.begin(), limb.end(), [&](const std::string& joint) {
      return std::any_of(found.begin(), found.end(),
                         [&](const MappedBone& m) { return m.joint == joint; });
    });
    if (whole || !has_structure) {
      return;
    }
    for (const std::string& joint : limb) {
      Drop(joint);
    }
    const bool arm = limb[0] == side + "shoulder";
    for (const MappedBone& mapped : found) {
      const bool leg_part = mapped.joint == side + "hip" || mapped.joint == side + "knee" ||
                            mapped.joint == side + "ankle" || mapped.joint == side + "midtarsal";
      if (mapped.joint.starts_with(side) && leg_part != arm) {
        Add(mapped.joint, static_cast<int>(mapped.bone), FoundBy::kStructure, mapped.confidence);
      }
    }
  }

  // Removes a joint that was found only by name.
  void Drop(const std::string& joint) {
    std::erase_if(map_.bones, [&](const MappedBone& mapped) {
      if (mapped.joint != joint || mapped.found_by != FoundBy::kName) {
        return false;
      }
      used_[mapped.bone] = false;
      return true;
    });
  }

  FoundBy HowFound(int bone, BonePart part) const {
    return Parsed(bone).part == part ? FoundBy::kName : FoundBy::kStructure;
  }

  // The pelvis is the common parent of both legs and the trunk; the spine leads from it to the
  // common parent of both arms.
  void AddPelvisAndSpine() {
    const int legs = rig_.CommonAncestor(BoneOf("r_hip"), BoneOf("l_hip"));
    int arms = rig_.CommonAncestor(BoneOf("r_shoulder"), BoneOf("l_shoulder"));
    const int head = BoneOf("skullbase");
    const int trunk = arms != Rig::kNoParent ? arms : head;
    const int pelvis = trunk == Rig::kNoParent ? legs : rig_.CommonAncestor(legs, trunk);
    if (pelvis == Rig::kNoParent) {
      AddByName("humanoid_root", BodySide::kMiddle, {BonePart::kPelvis});
    } else {
      const FoundBy found_by = HowFound(pelvis, BonePart::kPelvis);
      Add("humanoid_root", pelvis, found_by, found_by == FoundBy::kName ? 1.0f : kTrunkConfidence);
    }
    for (const std::string side : {"r_", "l_"}) {
      AddClavicle(side, arms);
    }
    if (arms != Rig::kNoParent) {
      AddChain(rig_.Chain(BoneOf("humanoid_root"), arms), SpineNames, BonePart::kSpine);
    }
  }

  void AddClavicle(const std::string& side, int chest) {
    const int shoulder = BoneOf(side + "shoulder");
    if (chest == Rig::kNoParent || shoulder == Rig::kNoParent || Has(side + "sternoclavicular")) {
      return;
    }
    std::vector<int> chain = rig_.Chain(chest, shoulder);
    chain.pop_back();
    if (!chain.empty()) {
      Add(side + "sternoclavicular", chain.back(), FoundBy::kStructure, kTrunkConfidence);
    }
  }

  void AddNeckAndFace() {
    const int head = BoneOf("skullbase");
    const int arms = rig_.CommonAncestor(BoneOf("r_shoulder"), BoneOf("l_shoulder"));
    if (head != Rig::kNoParent && arms != Rig::kNoParent) {
      std::vector<int> chain = rig_.Chain(arms, head);
      if (!chain.empty()) {
        chain.pop_back();
      }
      AddChain(chain, NeckNames, BonePart::kNeck);
    }
    AddByName("temporomandibular", BodySide::kMiddle, {BonePart::kJaw}, head);
  }

  // In chains with more bones than names, the middle bones keep their own names.
  void AddChain(const std::vector<int>& chain,
                const std::vector<const char*>& (*names_of)(size_t),
                BonePart part) {
    const std::vector<const char*>& names = names_of(chain.size());
    for (size_t i = 0; i < names.size(); ++i) {
      const size_t at = names.size() == 1 ? 0 : i * (chain.size() - 1) / (names.size() - 1);
      const FoundBy found_by = HowFound(chain[at], part);
      Add(names[i], chain[at], found_by, found_by == FoundBy::kName ? 1.0f : kTrunkConfidence);
    }
  }

  const Rig& rig_;
  std::vector<bool> used_;
  std::vector<BoneName> parsed_;
  std::set<std::string> absent_;
  BoneMap map_;
};

std::string Padded(std::string text, size_t width) {
  text.resize(std::max(width, text.size() + 2), ' ');
  return text;
}

}  // namespace

std::optional<size_t> Rig::Find(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::nullopt
                              : std::optional(static_cast<size_t>(found - names.begin()));
}

bool Rig::IsBelow(int ancestor, int bone) const {
  while (bone > ancestor) {
    bone = parents[static_cast<size_t>(bone)];
  }
  return bone == ancestor && bone != kNoParent;
}

int Rig::CommonAncestor(int a, int b) const {
  while (a != b) {
    if (a == kNoParent || b == kNoParent) {
      return kNoParent;
    }
    (a > b ? a : b) = parents[static_cast<size_t>(std::max(a, b))];
  }
  return a;
}

std::vector<std::vector<int>> Rig::Children() const {
  std::vector<std::vector<int>> children(size());
  for (size_t i = 0; i < size(); ++i) {
    if (parents[i] != kNoParent) {
      children[static_cast<size_t>(parents[i])].push_back(static_cast<int>(i));
    }
  }
  return children;
}

std::vector<int> Rig::Chain(int ancestor, int bone) const {
  std::vector<int> chain;
  if (!IsBelow(ancestor, bone)) {
    return chain;
  }
  for (; bone != ancestor; bone = parents[static_cast<size_t>(bone)]) {
    chain.push_back(bone);
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

const MappedBone* BoneMap::Find(std::string_view joint) const {
  const auto found = std::find_if(bones.begin(), bones.end(),
                                  [&](const MappedBone& m) { return m.joint == joint; });
  return found == bones.end() ? nullptr : &*found;
}

std::span<const char* const> NeededJointNames() { return kNeeded; }

std::vector<std::string> KnownJointNames() { return {KnownJoints().begin(), KnownJoints().end()}; }

const char* NameOf(FoundBy found_by) {
  switch (found_by) {
    case FoundBy::kSavedMap:
      return "saved map";
    case FoundBy::kFile:
      return "file";
    case FoundBy::kName:
      return "name";
    case FoundBy::kStructure:
      return "structure";
  }
  return "";
}

std::vector<NamedBone> NamedBones(const Rig& rig, const BoneMap& map) {
  std::vector<NamedBone> named;
  for (const MappedBone& mapped : map.bones) {
    named.push_back({mapped.joint, rig.names[mapped.bone], mapped.found_by, mapped.confidence});
  }
  return named;
}

bool BoneMap::IsHuman() const {
  return std::all_of(std::begin(kNeeded), std::end(kNeeded),
                     [&](const char* joint) { return Find(joint) != nullptr; });
}

BoneMap MapBones(const Rig& rig, const std::vector<GivenBones>& given) {
  BoneMap map = Mapper(rig).Map(given);
  std::sort(map.bones.begin(), map.bones.end(),
            [](const MappedBone& a, const MappedBone& b) { return a.bone < b.bone; });
  return map;
}

GivenBones FindGiven(const Rig& rig, const BoneNames& names) {
  GivenBones given;
  for (const auto& [joint, name] : names) {
    const auto bone = rig.Find(name);
    if (name.empty()) {
      given.bones[joint] = Rig::kNoParent;
    } else if (bone) {
      given.bones[joint] = static_cast<int>(*bone);
    }
  }
  return given;
}

std::string Preview(const Rig& rig, const BoneMap& map) {
  std::ostringstream text;
  size_t widest = 4;
  std::vector<bool> used(rig.size(), false);
  for (const MappedBone& mapped : map.bones) {
    widest = std::max(widest, rig.names[mapped.bone].size());
    used[mapped.bone] = true;
  }
  const size_t column = std::min<size_t>(widest + 2, 48);
  text << Padded("joint", 20) << Padded("bone", column) << Padded("found by", 12) << "sure\n";
  for (const MappedBone& mapped : map.bones) {
    text << Padded(mapped.joint, 20) << Padded(rig.names[mapped.bone], column)
         << Padded(NameOf(mapped.found_by), 12) << static_cast<int>(100.0f * mapped.confidence)
         << "%\n";
  }
  const char* separator = "no joint of H-Anim: ";
  for (size_t bone = 0; bone < rig.size(); ++bone) {
    if (!used[bone]) {
      text << separator << rig.names[bone];
      separator = ", ";
    }
  }
  text << "\n";
  return text.str();
}

namespace {

void DescribeMapFile(Fields& fields, BoneNames& names) {
  fields.Schema(1);
  DescribeBoneNames(fields, "bones", names);
}

}  // namespace

Result<BoneNames> ParseBoneNames(std::string_view json, std::string_view where) {
  return ParseFields<BoneNames>(json, where, DescribeMapFile, UnknownFields::kIgnore);
}

void DescribeBoneNames(Fields& fields, const FieldKey& key, BoneNames& names) {
  std::set<std::string> seen;
  fields.Entries(
      key, names, std::numeric_limits<size_t>::max(), "must be an object of joints and their bones",
      [&](const FieldKey& joint, std::string& bone) {
        const std::string name(joint.name);
        fields.Require(KnownJoints().contains(name),
                       "'" + name.substr(0, 64) + "' is not a joint of H-Anim that people have",
                       "see the table that the import prints");
        fields.Text(joint, bone, 1024);
        fields.Require(bone.empty() || seen.insert(bone).second,
                       "bone '" + bone + "' is given to two joints");
      });
}

Result<BoneNames> LoadBoneNames(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file, kMaxNamesBytes));
  return ParseBoneNames(text, file.string());
}

Status SaveBoneNames(const std::filesystem::path& file, const BoneNames& names) {
  return SaveJson(file, FormatFields(names, DescribeMapFile));
}

BoneNames NamesOf(const Rig& rig, const BoneMap& map) {
  BoneNames names;
  for (const MappedBone& mapped : map.bones) {
    names[mapped.joint] = rig.names[mapped.bone];
  }
  return names;
}

}  // namespace lararium::import
