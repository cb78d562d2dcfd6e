#include "editor/import/model/bvh_scene.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <utility>

#include "shared/core/lower_case.h"

namespace lararium::import {
namespace {

constexpr size_t kMaxJoints = 2000, kMaxValues = 40'000'000;
constexpr double kUsualFrameTime = 1.0 / 30.0;
constexpr double kLongestFrame = 5.0;  // Seconds; a longer frame time is a rate.
constexpr char kBlanks[] = " \t\v\f";

// Reads a number with a decimal point or comma.
std::optional<double> ReadNumber(std::string_view word) {
  std::string text(word.substr(word.starts_with('+') ? 1 : 0));
  while (text.ends_with(',') || text.ends_with(';')) {
    text.pop_back();
  }
  std::replace(text.begin(), text.end(), ',', '.');
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value)
             ? std::optional(value)
             : std::nullopt;
}

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t at = 0; (at = line.find_first_not_of(kBlanks, at)) != line.npos;) {
    const size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

struct Line {
  std::vector<std::string_view> words;
  size_t number = 0;
};

// Lines with at least one word, without comments; braces are lines of their own.
std::vector<Line> SplitLines(std::string_view text, size_t& at, size_t& number) {
  std::vector<Line> lines;
  while (at < text.size()) {
    const size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    std::string_view rest = text.substr(at, end - at);
    ++number;
    at = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    while (!rest.empty()) {
      const size_t brace = std::min(rest.find_first_of("{}"), rest.size());
      std::vector<std::string_view> words = Words(rest.substr(0, brace));
      if (!words.empty() && (words[0].starts_with('#') || words[0].starts_with("//"))) {
        break;
      }
      if (!words.empty()) {
        lines.push_back({std::move(words), number});
      }
      if (brace < rest.size()) {
        lines.push_back({{rest.substr(brace, 1)}, number});
      }
      rest.remove_prefix(std::min(brace + 1, rest.size()));
    }
    if (!lines.empty() && LowerCase(std::string(lines.back().words[0])) == "motion") {
      break;
    }
  }
  return lines;
}

// One of the six kinds: 0 to 2 for positions, 3 to 5 for rotations about X, Y and Z.
std::optional<size_t> ChannelKind(std::string_view word) {
  const std::string name = LowerCase(std::string(word));
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::string letter(1, static_cast<char>('x' + axis));
    if (name == letter + "position" || name == letter + "translation") {
      return axis;
    }
    if (name == letter + "rotation") {
      return 3 + axis;
    }
  }
  return std::nullopt;
}

struct Joint {
  std::string name;
  int parent = -1;
  std::array<double, 3> offset = {0.0, 0.0, 0.0};
  std::vector<size_t> channels;  // ChannelKind
  size_t first_value = 0;        // Index of its first value in a frame.
  bool is_end = false;
  bool is_left_out = false;  // Belongs to a further root.
};

class BvhReader {
 public:
  BvhReader(std::string_view text, const std::string& where, std::vector<std::string>& notes)
      : text_(text), where_(where), notes_(notes) {}

  Result<std::unique_ptr<aiScene>> Read() {
    at_ = text_.starts_with("\xef\xbb\xbf") ? 3 : 0;
    lines_ = SplitLines(text_, at_, number_);
    LARARIUM_RETURN_IF_ERROR(ReadHierarchy());
    LARARIUM_RETURN_IF_ERROR(ReadMotion());
    return MakeScene();
  }

 private:
  Status Problem(size_t line, const std::string& what) const {
    return Status::Error(where_ + ":" + std::to_string(line), what, "export the motion again");
  }

  static bool Is(const Line& line, const char* word) {
    return LowerCase(std::string(line.words[0])) == word;
  }

  static std::string NameIn(const Line& line) {
    std::string name;
    for (size_t i = 1; i < line.words.size(); ++i) {
      name += (i > 1 ? " " : "") + std::string(line.words[i]);
    }
    return name.substr(0, 256);
  }

  Status ReadHierarchy() {
    std::vector<int> open;  // Joints whose braces are open.
    int named = -1;         // The joint whose brace comes next.
    for (const Line& line : lines_) {
      if (Is(line, "hierarchy") || Is(line, "motion")) {
        continue;
      }
      if (Is(line, "root") || Is(line, "joint") || Is(line, "end")) {
        if (Is(line, "root") != open.empty()) {
          return Problem(line.number, "a joint is not within the braces of a root");
        }
        if (joints_.size() >= kMaxJoints) {
          return Problem(line.number, "there are more than 2000 joints");
        }
        named = AddJoint(line, open);
      } else if (Is(line, "{")) {
        if (named < 0) {
          return Problem(line.number, "a brace opens without a joint before it");
        }
        open.push_back(std::exchange(named, -1));
      } else if (Is(line, "}")) {
        if (open.empty()) {
          return Problem(line.number, "a brace closes that was never opened");
        }
        open.pop_back();
      } else if (open.empty()) {
        return Problem(line.number, "'" + std::string(line.words[0].substr(0, 40)) +
                                        "' is not a word of BVH at this place");
      } else if (Is(line, "offset")) {
        LARARIUM_RETURN_IF_ERROR(ReadOffset(line, joints_[static_cast<size_t>(open.back())]));
      } else if (Is(line, "channels")) {
        LARARIUM_RETURN_IF_ERROR(ReadChannels(line, joints_[static_cast<size_t>(open.back())]));
      }
    }
    if (!open.empty() || named >= 0) {
      return Problem(number_, "a brace is missing at the end of the hierarchy");
    }
    return joints_.empty() ? Problem(number_, "there is no ROOT in it") : Status();
  }

  int AddJoint(const Line& line, const std::vector<int>& open) {
    Joint joint;
    joint.is_end = Is(line, "end");
    joint.parent = open.empty() ? -1 : open.back();
    joint.is_left_out =
        open.empty() ? !joints_.empty() : joints_[static_cast<size_t>(open.back())].is_left_out;
    joint.name =
        joint.is_end ? "EndSite_" + joints_[static_cast<size_t>(open.back())].name : NameIn(line);
    if (open.empty() && !joints_.empty()) {
      notes_.push_back("line " + std::to_string(line.number) + ": the further root '" + joint.name +
                       "' is left out");
    }
    const auto has_name = [&](const Joint& other) { return other.name == joint.name; };
    while (std::any_of(joints_.begin(), joints_.end(), has_name)) {
      joint.name += "'";
    }
    joints_.push_back(joint);
    return static_cast<int>(joints_.size()) - 1;
  }

  Status ReadOffset(const Line& line, Joint& joint) const {
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto value =
          axis + 1 < line.words.size() ? ReadNumber(line.words[axis + 1]) : std::nullopt;
      if (!value) {
        return Problem(line.number, "OFFSET needs three numbers");
      }
      joint.offset[axis] = *value;
    }
    return Status();
  }

  Status ReadChannels(const Line& line, Joint& joint) {
    const auto count = line.words.size() > 1 ? ReadNumber(line.words[1]) : std::nullopt;
    if (!count || *count != static_cast<double>(line.words.size() - 2)) {
      return Problem(line.number, "CHANNELS needs their number and then as many names");
    }
    if (!joint.channels.empty()) {
      return Problem(line.number, "joint '" + joint.name + "' has CHANNELS twice");
    }
    joint.first_value = values_per_frame_;
    for (size_t i = 2; i < line.words.size(); ++i) {
      const auto kind = ChannelKind(line.words[i]);
      if (!kind) {
        return Problem(line.number, "'" + std::string(line.words[i].substr(0, 40)) +
                                        "' is not a channel of BVH, such as Xrotation");
      }
      joint.channels.push_back(*kind);
    }
    values_per_frame_ += joint.channels.size();
    return Status();
  }

  // The rest of the text: "Frames: 60", "Frame Time: 0.033" and the values.
  Status ReadMotion() {
    if (values_per_frame_ == 0) {
      return Problem(number_, "no joint has a channel");
    }
    std::optional<double> frames;
    size_t bad = 0, first_bad = 0;
    for (; at_ < text_.size(); ++number_) {
      const size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
      const std::vector<std::string_view> words = Words(text_.substr(at_, end - at_));
      at_ = end + (text_.substr(end).starts_with("\r\n") ? 2 : 1);
      const std::string first = words.empty() ? "" : LowerCase(std::string(words[0]));
      if (first.empty() || first.starts_with('#') || first.starts_with("//")) {
        continue;
      }
      if (first.starts_with("frame")) {
        const auto value = NumberAfterColon(words);
        (first.starts_with("frames") ? frames : frame_time_) = value;
        continue;
      }
      for (const std::string_view word : words) {
        const auto value = ReadNumber(word);
        if (!value && bad++ == 0) {
          first_bad = number_ + 1;
        }
        const size_t frame_before = values_.size() - values_per_frame_;
        values_.push_back(value                                 ? static_cast<float>(*value)
                          : values_.size() >= values_per_frame_ ? values_[frame_before]
                                                                : 0.0f);
        if (values_.size() > kMaxValues) {
          return Problem(number_ + 1, "the motion is too long");
        }
      }
    }
    if (bad > 0) {
      notes_.push_back(std::to_string(bad) + " values are no numbers, the first in line " +
                       std::to_string(first_bad) + "; those of the frame before are taken");
    }
    return CheckFrames(frames);
  }

  static std::optional<double> NumberAfterColon(const std::vector<std::string_view>& words) {
    const std::string_view last = words.back();
    return ReadNumber(last.substr(last.rfind(':') + 1));
  }

  Status CheckFrames(const std::optional<double>& stated) {
    frames_ = values_.size() / values_per_frame_;
    const size_t rest = values_.size() % values_per_frame_;
    if (frames_ == 0) {
      return Problem(number_, "there is no whole frame of " + std::to_string(values_per_frame_) +
                                  " values in it");
    }
    if (rest != 0) {
      notes_.push_back("its last frame has " + std::to_string(rest) + " of " +
                       std::to_string(values_per_frame_) + " values and is left out");
    }
    if (!stated || *stated != static_cast<double>(frames_)) {
      notes_.push_back("it has " + std::to_string(frames_) + " frames, not as many as it states");
    }
    if (!frame_time_ || !(*frame_time_ > 0.0)) {
      notes_.push_back("it states no frame time; 30 frames a second are assumed");
      frame_time_ = kUsualFrameTime;
    } else if (*frame_time_ > kLongestFrame) {
      notes_.push_back("its frame time is taken for a number of frames a second");
      frame_time_ = 1.0 / *frame_time_;
    }
    return Status();
  }

  // Whether the positions of a joint below the root are nothing but zeros: some programs write
  // six channels for each joint, and mean the offset.
  bool HasEmptyPositions(const Joint& joint) const {
    for (size_t frame = 0; frame < frames_; ++frame) {
      for (size_t c = 0; c < joint.channels.size(); ++c) {
        const float value = values_[frame * values_per_frame_ + joint.first_value + c];
        if (joint.channels[c] < 3 && value != 0.0f) {
          return false;
        }
      }
    }
    return joint.parent >= 0;
  }

  std::unique_ptr<aiScene> MakeScene() const {
    auto scene = std::make_unique<aiScene>();
    std::vector<aiNode*> nodes;
    auto* animation = new aiAnimation;
    scene->mAnimations = new aiAnimation* [1] { animation };
    scene->mNumAnimations = 1;
    animation->mTicksPerSecond = 1.0;
    animation->mChannels = new aiNodeAnim*[joints_.size()];
    for (const Joint& joint : joints_) {
      auto* node = joint.is_left_out ? nullptr : new aiNode(joint.name);
      nodes.push_back(node);
      if (node == nullptr) {
        continue;
      }
      const std::array<double, 3>& o = joint.offset;
      aiMatrix4x4::Translation(
          aiVector3D(static_cast<float>(o[0]), static_cast<float>(o[1]), static_cast<float>(o[2])),
          node->mTransformation);
      if (joint.parent < 0) {
        scene->mRootNode = node;
      } else {
        nodes[static_cast<size_t>(joint.parent)]->addChildren(1, &node);
      }
      if (!joint.channels.empty()) {
        animation->mChannels[animation->mNumChannels++] = MakeChannel(joint);
      }
    }
    return scene;
  }

  aiNodeAnim* MakeChannel(const Joint& joint) const {
    auto* keys = new aiNodeAnim;
    keys->mNodeName = joint.name;
    keys->mNumPositionKeys = keys->mNumRotationKeys = static_cast<unsigned>(frames_);
    keys->mPositionKeys = new aiVectorKey[frames_];
    keys->mRotationKeys = new aiQuatKey[frames_];
    const bool keeps_offset = HasEmptyPositions(joint);
    for (size_t frame = 0; frame < frames_; ++frame) {
      std::array<float, 3> position;
      std::copy(joint.offset.begin(), joint.offset.end(), position.begin());
      glm::quat rotation(1.0f, 0.0f, 0.0f, 0.0f);
      for (size_t c = 0; c < joint.channels.size(); ++c) {
        const float value = values_[frame * values_per_frame_ + joint.first_value + c];
        if (const size_t kind = joint.channels[c]; kind >= 3) {
          glm::vec3 axis(0.0f);
          axis[static_cast<int>(kind - 3)] = 1.0f;
          rotation = rotation * glm::angleAxis(glm::radians(value), axis);
        } else if (!keeps_offset) {
          position[kind] = value;
        }
      }
      const double time = static_cast<double>(frame) * *frame_time_;
      keys->mPositionKeys[frame] = {time, aiVector3D(position[0], position[1], position[2])};
      keys->mRotationKeys[frame] = {time,
                                    aiQuaternion(rotation.w, rotation.x, rotation.y, rotation.z)};
    }
    return keys;
  }

  const std::string_view text_;
  const std::string& where_;
  std::vector<std::string>& notes_;
  size_t at_ = 0;      // Position in `text_`.
  size_t number_ = 0;  // Number of lines before it.
  std::vector<Line> lines_;
  std::vector<Joint> joints_;
  size_t values_per_frame_ = 0, frames_ = 0;
  std::vector<float> values_;
  std::optional<double> frame_time_;
};

}  // namespace

Result<std::unique_ptr<aiScene>> ReadBvhScene(std::string_view text,
                                              const std::string& where,
                                              std::vector<std::string>& notes) {
  return BvhReader(text, where, notes).Read();
}

bool LooksLikeBvh(std::string_view text) {
  text.remove_prefix(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
  size_t number = 0;
  for (size_t at = 0; at < text.size() && number < 1000; ++number) {
    const size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::vector<std::string_view> words = Words(text.substr(at, end - at));
    at = end + 1;
    if (!words.empty() && !words[0].starts_with('#') && !words[0].starts_with("//")) {
      return LowerCase(std::string(words[0])) == "hierarchy";
    }
  }
  return false;
}

}  // namespace lararium::import
