// The walk of the plain figure, written as BVH in the ways of other programs and imported again:
// in every frame it walks as before, for any zero pose of the file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <sstream>

#include "editor/import/model/clip_track.h"
#include "editor/import/motion/clip_import.h"
#include "shared/core/file.h"
#include "shared/human/turns.h"
#include "tests/import/plain_figure.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kPasses = 3;

struct Style {
  bool along_bones = false;  // The X axis of each joint lies along its bone.
  glm::quat file_from_actor = human::kNoTurn;
  float scale = 100.0f;
};

class ForeignWalk : public ::testing::Test {
 protected:
  const human::Skeleton& skeleton() const { return figure_.skeleton; }

  // The orientation of a joint at rest, in actor axes.
  glm::quat AtRest(size_t joint, const Style& style) const {
    if (!style.along_bones) {
      return human::kNoTurn;
    }
    glm::vec3 bone = skeleton().rest[joint].translation;
    for (size_t child = skeleton().size(); child-- > joint + 1;) {
      bone = skeleton().parents[child] == static_cast<int16_t>(joint)
                 ? skeleton().rest[child].translation
                 : bone;
    }
    return glm::length(bone) > 1e-3f ? human::Arc(glm::vec3(1, 0, 0), glm::normalize(bone))
                                     : human::kNoTurn;
  }

  void AddJoint(size_t joint, const Style& style, std::ostream& text, std::vector<size_t>& order) {
    const int16_t parent = skeleton().parents[joint];
    const glm::quat above =
        parent < 0 ? human::kNoTurn : AtRest(static_cast<size_t>(parent), style);
    const glm::vec3 offset =
        style.scale * (glm::conjugate(above) * skeleton().rest[joint].translation);
    text << (parent < 0 ? "ROOT " : "JOINT ") << skeleton().names[joint] << "\n{\nOFFSET "
         << offset.x << " " << offset.y << " " << offset.z
         << "\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
    order.push_back(joint);
    bool is_end = true;
    for (size_t child = 0; child < skeleton().size(); ++child) {
      if (skeleton().parents[child] == static_cast<int16_t>(joint)) {
        AddJoint(child, style, text, order);
        is_end = false;
      }
    }
    text << (is_end ? "End Site\n{\nOFFSET 0 0 0\n}\n}\n" : "}\n");
  }

  // The walk travels to -Z, so that its root motion can be compared.
  std::string Write(const Style& style) {
    std::ostringstream text;
    std::vector<size_t> order;
    text << "HIERARCHY\n";
    AddJoint(0, style, text, order);
    const size_t count = skeleton().size(), keys = walk_.KeyCount(count) - 1;
    text << "MOTION\nFrames: " << kPasses * keys << "\nFrame Time: " << 1.0f / walk_.keys_per_second
         << "\n";
    for (size_t key = 0; key < kPasses * keys; ++key) {
      for (const size_t joint : order) {
        const human::JointTransform& local = walk_.keys[key % keys * count + joint];
        const int16_t parent = skeleton().parents[joint];
        const bool is_root = parent < 0;
        const glm::quat above =
            is_root ? human::kNoTurn : AtRest(static_cast<size_t>(parent), style);
        glm::vec3 position = local.translation;
        glm::quat rotation = local.rotation;
        if (is_root) {
          position.z -= walk_.stride * static_cast<float>(key) / static_cast<float>(keys);
          position = style.file_from_actor * position;
          rotation = style.file_from_actor * rotation;
        }
        position = style.scale * (glm::conjugate(above) * position);
        const glm::mat3 m = glm::mat3_cast(glm::conjugate(above) * rotation * AtRest(joint, style));
        // The angles of Z, X and Y; m[column][row].
        const float x = std::asin(glm::clamp(m[1][2], -1.0f, 1.0f));
        text << position.x << " " << position.y << " " << position.z << " "
             << glm::degrees(std::atan2(-m[1][0], m[1][1])) << " " << glm::degrees(x) << " "
             << glm::degrees(std::atan2(-m[0][2], m[2][2])) << " ";
      }
      text << "\n";
    }
    return text.str();
  }

  Result<ImportedClip> Import(const Style& style) {
    const std::filesystem::path file = folder_ / "walk.bvh";
    EXPECT_TRUE(WriteFileAtomically(file, Write(style)).ok());
    ClipImportOptions options;
    options.drop_calibration = false;
    return ImportClip(file, skeleton(), options);
  }

  glm::vec3 At(const JointFrames& frames, const std::string& joint) const {
    return frames.positions[IndexOfJoint(skeleton(), joint)];
  }

  // Hips are above the feet, the lower foot is on the floor, and limbs point where they did.
  void ExpectWalks(const human::Clip& clip) {
    const size_t count = skeleton().size(), keys = walk_.KeyCount(count) - 1;
    const float ankle = RestPosition(skeleton(), "r_ankle").y;
    JointFrames now, before;
    for (size_t key = 0; key < clip.KeyCount(count); ++key) {
      ComputeFrames(skeleton(), std::span(clip.keys).subspan(key * count, count), now);
      ComputeFrames(skeleton(), std::span(walk_.keys).subspan(key % keys * count, count), before);
      float lowest = 1.0f, lowest_before = 1.0f;
      for (const std::string side : {"r_", "l_"}) {
        EXPECT_GT(At(now, side + "hip").y, At(now, side + "ankle").y + 0.6f) << key;
        for (const auto& [from, to] : {std::pair{"hip", "knee"}, std::pair{"knee", "ankle"},
                                       std::pair{"shoulder", "elbow"}}) {
          const glm::vec3 a = At(now, side + to) - At(now, side + from);
          const glm::vec3 b = At(before, side + to) - At(before, side + from);
          EXPECT_GT(glm::dot(glm::normalize(a), glm::normalize(b)), std::cos(glm::radians(18.0f)))
              << side << to << " in key " << key;
        }
        for (const char* joint : {"ankle", "midtarsal"}) {
          lowest = std::min(lowest, At(now, side + joint).y);
          lowest_before = std::min(lowest_before, At(before, side + joint).y);
        }
      }
      EXPECT_GT(At(now, "skullbase").y, At(now, "humanoid_root").y + 0.4f) << key;
      EXPECT_NEAR(lowest, lowest_before, 0.03f) << key;
      EXPECT_LT(lowest, ankle + 0.02f) << key;
    }
  }

  const human::Human& figure_ = PlainFigure();
  const human::Clip walk_ = *std::find_if(figure_.clips.begin(),
                                          figure_.clips.end(),
                                          [](const auto& clip) { return clip.name == "walk"; });
  test::TemporaryFolder folder_;
};

TEST_F(ForeignWalk, ComesBackFromAPlainFile) {
  const auto imported = Import({});
  ASSERT_TRUE(imported.ok()) << imported.message();
  EXPECT_THAT(imported->notes, IsEmpty());
  ExpectWalks(imported->clip);
}

TEST_F(ForeignWalk, WalksWhereTheZeroPoseIsNoPoseOfAPerson) {
  for (const float scale : {1.0f, 100.0f}) {
    const auto imported = Import({.along_bones = true, .scale = scale});
    ASSERT_TRUE(imported.ok()) << imported.message();
    ASSERT_EQ(imported->notes.size(), 1u);
    EXPECT_THAT(imported->notes[0], HasSubstr("pose at rest"));
    ExpectWalks(imported->clip);
  }
}

TEST_F(ForeignWalk, WalksWhereTheMotionStandsAlongAnotherAxisThanTheZeroPose) {
  for (const bool along_bones : {false, true}) {
    for (const auto& [axis, angle] :
         {std::pair{glm::vec3(1, 0, 0), 90.0f}, std::pair{glm::vec3(0, 0, 1), -90.0f},
          std::pair{glm::vec3(1, 0, 0), 180.0f}}) {
      const auto imported = Import({.along_bones = along_bones,
                                    .file_from_actor = glm::angleAxis(glm::radians(angle), axis)});
      ASSERT_TRUE(imported.ok()) << imported.message();
      ExpectWalks(imported->clip);
    }
  }
}

TEST_F(ForeignWalk, WalksForwardsWhateverItsHeading) {
  for (const float heading : {35.0f, 120.0f}) {
    const auto imported =
        Import({.along_bones = true, .file_from_actor = human::TurnY(glm::radians(heading))});
    ASSERT_TRUE(imported.ok()) << imported.message();
    EXPECT_NEAR(imported->clip.stride / kPasses, walk_.stride, 0.1f * walk_.stride);
    ExpectWalks(imported->clip);
  }
}

}  // namespace
}  // namespace lararium::import
