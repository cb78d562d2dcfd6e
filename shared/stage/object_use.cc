#include "shared/stage/object_use.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <map>
#include <span>

#include "shared/core/json_fields.h"
#include "shared/light/lamp.h"

namespace lararium::stage {
namespace {

constexpr double kMaxLength = 100.0;         // Limit of all lengths of an object, metres.
constexpr double kMaxDegrees = 720.0;        // Limit of angles.
constexpr double kMaxActionSeconds = 600.0;  // Limit of the duration of an action.
constexpr size_t kMaxNameBytes = 64;
constexpr size_t kMaxUseBytes = 1 << 20;
constexpr size_t kMaxOutline = 12;
constexpr double kMinGainDb = -60.0;
constexpr double kMaxGainDb = 12.0;

float Radians(double degrees) { return static_cast<float>(glm::radians(degrees)); }

template <typename T>
int FindByName(const std::vector<T>& items, std::string_view name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [name](const T& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

template <typename Vector>
void DescribeVector(Fields& fields,
                    const FieldKey& key,
                    Vector& vector,
                    double limit = kMaxLength) {
  const std::span<float> numbers(&vector.x, Vector::length());
  fields.Numbers(key, numbers);
  fields.RequireAt(key,
                   std::all_of(numbers.begin(), numbers.end(),
                               [limit](float x) { return std::abs(x) <= limit; }),
                   "is out of range");
}

glm::vec3 DescribeDirection(Fields& fields, const FieldKey& key) {
  glm::vec3 v(0.0f);
  DescribeVector(fields, key, v);
  const float length = glm::length(v);
  fields.RequireAt(key, length > 1e-3f, "must be a direction, not zero");
  return v / length;
}

// Describes the optional "heading" in degrees; returns radians.
float DescribeHeading(Fields& fields, double heading = 0.0) {
  fields.Number(Optional("heading"), heading, -kMaxDegrees, kMaxDegrees);
  return Radians(heading);
}

// {"at": [x, y, z], "heading": degrees} or {"at": ..., "turn": [about x, y, z]}.
void DescribePose(Fields& fields, const FieldKey& at, Pose& pose) {
  DescribeVector(fields, at, pose.position);
  glm::vec3 turn(0.0f);
  DescribeVector(fields, Optional("turn"), turn, kMaxDegrees);
  const float heading = DescribeHeading(fields, turn.y);
  pose.rotation = glm::normalize(glm::angleAxis(heading, glm::vec3(0, 1, 0)) *
                                 glm::angleAxis(Radians(turn.x), glm::vec3(1, 0, 0)) *
                                 glm::angleAxis(Radians(turn.z), glm::vec3(0, 0, 1)));
}

bool IsConvex(const std::vector<glm::vec2>& outline) {
  const size_t count = outline.size();
  if (count == 0) {
    return true;
  }
  bool left = false;
  bool right = false;
  for (size_t i = 0; i < count; ++i) {
    const glm::vec2 a = outline[(i + 1) % count] - outline[i];
    const glm::vec2 b = outline[(i + 2) % count] - outline[(i + 1) % count];
    const float cross = a.x * b.y - a.y * b.x;
    left = left || cross > 0.0f;
    right = right || cross < 0.0f;
  }
  return count >= 3 && left != right;
}

// Describes one object.json, for reading, and checks it against its prop. Sections are described in
// the order in which they refer to one another.
class UseDescription {
 public:
  UseDescription(Fields& fields, const Prop& prop, ObjectUse& use)
      : fields_(fields), prop_(prop), use_(use) {}

  void Describe() {
    fields_.Schema(1);
    DescribeStates();
    std::vector<Part> parts;
    Named("parts", parts, Prop::kMaxParts, &UseDescription::DescribePart);
    Named("grips", use_.grips, ObjectUse::kMaxGrips, &UseDescription::DescribeGrip);
    Named("lights", use_.lights, ObjectUse::kMaxLights, &UseDescription::DescribeLight);
    Named("places", use_.places, ObjectUse::kMaxPlaces, &UseDescription::DescribeStanding);
    Named("surfaces", use_.surfaces, ObjectUse::kMaxSpots, &UseDescription::DescribeSurface);
    Named("actions", use_.actions, ObjectUse::kMaxActions, &UseDescription::DescribeAction);
    fields_.List(Optional("sounds"), use_.sounds, ObjectUse::kMaxSounds,
                 [this](Fields& /*fields*/, StateSound& sound) { DescribeSound(sound); });
    fields_.Object(Optional("footprint"), use_.footprint,
                   [this](Fields& /*fields*/, Footprint& print) { DescribeFootprint(print); });
    fields_.Object("carry", use_.carry,
                   [this](Fields& /*fields*/, Carry& carry) { DescribeCarry(carry); });
    fields_.Integer(Optional("capacity"), use_.capacity, 1, 32);
    fields_.Object("queue", use_.queue, [this](Fields& fields, ApproachPlace& first) {
      DescribeStanding(first);
      DescribeVector(fields, Optional("step"), use_.queue_step);
    });
  }

 private:
  struct Part {
    std::string name;
  };

  // Describes the named entries of a section, in the order of the names.
  template <typename T>
  void Named(std::string_view section,
             std::vector<T>& entries,
             size_t max_count,
             void (UseDescription::*describe)(T& entry)) {
    std::map<std::string, T> named;
    fields_.Entries(Optional(section), named, max_count,
                    "must be an object of at most " + std::to_string(max_count) + " named entries",
                    [&](const FieldKey& key, T& entry) {
                      fields_.Require(!key.name.empty() && key.name.size() <= kMaxNameBytes,
                                      "a name must have from 1 to 64 bytes");
                      entry.name = key.name;
                      fields_.Object(key, entry,
                                     [&](Fields& /*fields*/, T& one) { (this->*describe)(one); });
                      entries.push_back(std::move(entry));
                    });
  }

  void DescribeStates() {
    if (!fields_.Has("states")) {
      return;
    }
    use_.states.clear();
    std::vector<std::string> names;
    fields_.List("states", names, ObjectUse::kMaxStates,
                 [this](const FieldKey& key, std::string& name) {
                   fields_.Text(key, name, kMaxNameBytes);
                   fields_.RequireAt(key, !name.empty() && use_.FindState(name) < 0,
                                     "every state needs a name of its own");
                   use_.states.push_back(name);
                 });
    fields_.RequireAt("states", !use_.states.empty(), "must name at least one state");
  }

  // The things that a list names, as bits; unchanged if the field is missing.
  template <typename Find>
  void DescribeSet(std::string_view key, const std::string& what, Find find, uint32_t& set) {
    if (!fields_.Has(key)) {
      return;
    }
    set = 0;
    std::vector<std::string> names;
    fields_.List(key, names, 32, [&](const FieldKey& entry, std::string& name) {
      fields_.Text(entry, name, kMaxNameBytes);
      const int index = find(name);
      fields_.RequireAt(entry, index >= 0, "there is no " + what + " '" + name + "'",
                        "name one that this object has");
      set |= index < 0 ? 0u : 1u << index;
    });
  }

  void DescribeStateSet(std::string_view key, uint32_t& set) {
    DescribeSet(
        key, "state", [this](std::string_view name) { return use_.FindState(name); }, set);
  }

  // An index into Prop::parts; unchanged if the field is missing.
  void DescribePartIndex(const FieldKey& key, int& part) {
    if (key.required || fields_.Has(key.name)) {
      std::string name;
      fields_.Text(key, name, kMaxNameBytes);
      part = prop_.FindPart(name);
      fields_.Require(part >= 0, "there is no part '" + name + "'", "name a node of the model");
    }
  }

  void DescribePart(Part& named) {
    const int part = prop_.FindPart(named.name);
    fields_.Require(part >= 0, "the model has no part of this name", "name a node of the model");
    if (fields_.Has("states")) {
      use_.shown.push_back({part, 0});
      DescribeStateSet("states", use_.shown.back().states);
    }
    const bool turns = fields_.Has("hinge");
    const bool slides = fields_.Has("slider");
    fields_.Require(!turns || !slides, "must be either a hinge or a slider, not both");
    if (turns || slides) {
      DescribeJoint(part, turns);
    } else {  // Limits have no effect then.
      fields_.Has("limits");
      fields_.Has("rest");
    }
  }

  void DescribeJoint(int part, bool turns) {
    fields_.Require(use_.joints.size() < ObjectUse::kMaxJoints,
                    "an object has at most " + std::to_string(ObjectUse::kMaxJoints) + " joints");
    ObjectJoint joint;
    joint.part = part;
    joint.kind = turns ? ObjectJoint::Kind::kHinge : ObjectJoint::Kind::kSlider;
    joint.axis = DescribeDirection(fields_, turns ? "hinge" : "slider");
    std::array<double, 2> limits = {};
    fields_.Numbers("limits", limits);
    double rest = std::clamp(0.0, std::min(limits[0], limits[1]), limits[1]);
    fields_.Number(Optional("rest"), rest, -kMaxDegrees, kMaxDegrees);
    const double most = turns ? kMaxDegrees : kMaxLength;
    fields_.Require(
        limits[0] <= rest && rest <= limits[1] && limits[0] >= -most && limits[1] <= most,
        "limits must be [least, most] with rest in between");
    const auto value = [turns](double x) { return turns ? Radians(x) : static_cast<float>(x); };
    joint.lower = value(limits[0]);
    joint.upper = value(limits[1]);
    joint.rest = value(rest);
    use_.joints.push_back(joint);
  }

  void DescribeGrip(Grip& grip) {
    DescribePartIndex(Optional("part"), grip.part);
    DescribeVector(fields_, "at", grip.part_from_hand.position);
    const glm::vec3 palm = DescribeDirection(fields_, "palm");
    const glm::vec3 fingers = DescribeDirection(fields_, "fingers");
    const glm::vec3 x = glm::cross(fingers, -palm);
    fields_.Require(glm::length(x) > 0.1f, "palm and fingers must point in different directions",
                    "palm faces what is held, fingers point along it");
    const glm::vec3 right = glm::normalize(x);
    const glm::vec3 back = -fingers;
    grip.part_from_hand.rotation =
        glm::normalize(glm::quat_cast(glm::mat3(right, glm::cross(back, right), back)));
    std::string hand = "either";
    fields_.Text(Optional("hand"), hand, kMaxNameBytes);
    fields_.Require(hand == "left" || hand == "right" || hand == "either",
                    "hand must be \"left\", \"right\" or \"either\"");
    grip.fits = {hand != "left", hand != "right"};
    std::string pose;
    fields_.Text(Optional("pose"), pose, kMaxNameBytes);
    const auto named = human::HandPoseNamed(pose);
    fields_.Require(pose.empty() || named, "there is no pose '" + pose + "' of a hand",
                    "use relaxed, flat, fist, cylinder, pinch, point, ladle or bowl");
    grip.hand_pose = named.value_or(grip.hand_pose);
  }

  void DescribeStanding(ApproachPlace& place) {
    DescribeVector(fields_, "at", place.position);
    place.heading = DescribeHeading(fields_);
  }

  // Describes "colour": [r, g, b] or "temperature": kelvin.
  void DescribeColour(glm::vec3& colour) {
    const bool warm = fields_.Has("temperature");
    fields_.Require(fields_.Has("colour") != warm,
                    "must have either \"colour\" or \"temperature\"");
    if (warm) {
      double kelvin = 6500.0;
      fields_.Number("temperature", kelvin, 1667.0, 25000.0);
      colour = light::ColourOfTemperature(kelvin);
      return;
    }
    DescribeVector(fields_, "colour", colour);
    const float luminance = glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    fields_.RequireAt("colour",
                      std::min({colour.r, colour.g, colour.b}) >= 0.0f && luminance > 1e-6f,
                      "must be linear red, green and blue of at least 0, not all 0");
    colour /= luminance;
  }

  void DescribeLight(ObjectLight& light) {
    DescribePartIndex(Optional("part"), light.part);
    DescribeVector(fields_, "at", light.position);
    DescribeColour(light.colour);
    fields_.Number("intensity", light.intensity, 0.0, 1e4);
    fields_.Number("radius", light.radius, 1e-3, 10.0);
    fields_.Number(Optional("flicker"), light.flicker, 0.0, 1.0);
    DescribeStateSet("states", light.states);
  }

  int FindPlace(std::string_view name) const { return FindByName(use_.places, name); }

  void DescribeSurface(Surface& surface) {
    int part = -1;
    DescribePartIndex(Optional("part"), part);
    fields_.List("spots", surface.spots, ObjectUse::kMaxSpots, [&](Fields& fields, Spot& spot) {
      spot.part = part;
      DescribePose(fields, "at", spot.part_from_spot);
      std::string place;
      fields.Text(Optional("place"), place, kMaxNameBytes);
      spot.place = FindPlace(place);
      fields.Require(place.empty() || spot.place >= 0, "there is no place '" + place + "'",
                     "name one that this object has");
    });
    spots_ += surface.spots.size();
    fields_.Require(
        !surface.spots.empty() && spots_ <= ObjectUse::kMaxSpots,
        "surfaces have from 1 to " + std::to_string(ObjectUse::kMaxSpots) + " spots in all");
  }

  void DescribeHands(HandGrips& hands) {
    fields_.Object(Optional("hands"), hands, [this](Fields& fields, HandGrips& grips) {
      constexpr const char* kNames[] = {"right", "left"};  // Indexed by side.
      for (size_t hand = 0; hand < 2; ++hand) {
        if (!fields.Has(kNames[hand])) {
          continue;
        }
        std::string name;
        fields.Text(kNames[hand], name, kMaxNameBytes);
        grips[hand] = use_.FindGrip(name);
        fields.Require(grips[hand] >= 0, "there is no grip '" + name + "'",
                       "name one that this object has");
        fields.Require(grips[hand] < 0 || use_.grips[static_cast<size_t>(grips[hand])].fits[hand],
                       "the grip '" + name + "' is for the other hand");
      }
    });
  }

  void DescribeAction(ObjectAction& action) {
    DescribeStateSet("from", action.from);
    std::string to;
    fields_.Text(Optional("to"), to, kMaxNameBytes);
    action.to = use_.FindState(to);
    fields_.Require(to.empty() || action.to >= 0, "there is no state '" + to + "'",
                    "name it in \"states\"");
    fields_.Flag(Optional("held"), action.held);
    DescribeSet(
        "places", "place", [this](std::string_view p) { return FindPlace(p); }, action.places);
    if (action.held) {
      fields_.Require(!fields_.Has("places") && !fields_.Has("seat"),
                      "an action with a held object cannot have places or a seat");
    } else {
      fields_.Require(!use_.places.empty(), "the action needs a place where the actor stands",
                      "add one to \"places\"");
    }
    fields_.Require(action.places != 0, "the list \"places\" is empty",
                    "name a place in it, or remove it to allow every place");
    DescribeHands(action.hands);
    fields_.Number(Optional("duration"), action.duration, 0.0, kMaxActionSeconds);
    action.release = static_cast<float>(kMaxActionSeconds);
    fields_.Number(Optional("release"), action.release, 0.0, kMaxActionSeconds);
    fields_.Text(Optional("clip"), action.clip, kMaxNameBytes);
    DescribeActionSound(action.sound);
    fields_.List(
        Optional("moves"), action.moves, ObjectUse::kMaxKeys,
        [&](Fields& /*fields*/, ObjectAction::Move& move) { DescribeMove(action.duration, move); });
    double last = 0.0;
    fields_.List(Optional("path"), action.path, ObjectUse::kMaxKeys,
                 [&](Fields& fields, ObjectAction::Key& key) {
                   fields.Number("t", last, last, action.duration);
                   key.time = static_cast<float>(last);
                   DescribePose(fields, "at", key.pose);
                 });
    fields_.Object("seat", action.seat, [](Fields& fields, ObjectSeat& seat) {
      DescribeVector(fields, "at", seat.position);
      seat.heading = DescribeHeading(fields);
    });
  }

  // Describes "begin" and "end" of a span of time from 0 to `most` seconds.
  void DescribeTimes(double most, float& begin_out, float& end_out) {
    double begin = 0.0;
    double end = most;
    fields_.Number(Optional("begin"), begin, 0.0, most);
    fields_.Number(Optional("end"), end, begin, most);
    begin_out = static_cast<float>(begin);
    end_out = static_cast<float>(end);
  }

  // The field is either the name of a sound or an object.
  void DescribeActionSound(ActionSound& sound) {
    if (fields_.IsText("sound")) {
      fields_.Text("sound", sound.name, kMaxNameBytes);
      return;
    }
    fields_.Object(Optional("sound"), sound, [this](Fields& fields, ActionSound& heard) {
      fields.Text("name", heard.name, kMaxNameBytes);
      DescribeTimes(kMaxActionSeconds, heard.begin, heard.end);
      fields.Flag(Optional("loop"), heard.loops);
      fields.Number(Optional("gain_db"), heard.gain_db, kMinGainDb, kMaxGainDb);
    });
  }

  void DescribeSound(StateSound& sound) {
    fields_.Text("name", sound.name, kMaxNameBytes);
    DescribeStateSet("states", sound.states);
    DescribeVector(fields_, Optional("at"), sound.position);
    fields_.Number(Optional("gain_db"), sound.gain_db, kMinGainDb, kMaxGainDb);
  }

  void DescribeMove(double duration, ObjectAction::Move& move) {
    int part = -1;
    DescribePartIndex("part", part);
    const auto joint = std::find_if(use_.joints.begin(), use_.joints.end(),
                                    [part](const ObjectJoint& j) { return j.part == part; });
    const bool moves = joint != use_.joints.end();
    fields_.Require(moves, "this part has no joint", "give it a hinge or a slider in \"parts\"");
    double to = 0.0;
    fields_.Number("to", to, -kMaxDegrees, kMaxDegrees);
    if (moves) {
      move.joint = static_cast<int>(joint - use_.joints.begin());
      move.to = joint->kind == ObjectJoint::Kind::kHinge ? Radians(to) : static_cast<float>(to);
      fields_.Require(move.to >= joint->lower - 1e-5f && move.to <= joint->upper + 1e-5f,
                      "\"to\" is outside of the joint's limits");
    }
    DescribeTimes(duration, move.begin, move.end);
  }

  void DescribeFootprint(Footprint& print) {
    fields_.List(
        "outline", print.outline, kMaxOutline,
        [this](const FieldKey& key, glm::vec2& corner) { DescribeVector(fields_, key, corner); });
    fields_.RequireAt("outline", IsConvex(print.outline),
                      "must be empty or the corners of a convex outline, in their order");
    DescribeStateSet("states", print.states);
  }

  void DescribeCarry(Carry& carry) {
    DescribeHands(carry.hands);
    const auto hands =
        std::count_if(carry.hands.begin(), carry.hands.end(), [](int grip) { return grip >= 0; });
    fields_.Require(hands > 0, "at least one hand must hold the object",
                    "name a grip in \"hands\"");
    fields_.Require(hands < 2 || fields_.Has("at"),
                    "the position of an object that both hands carry is missing", "add \"at\"");
    Pose pose;
    DescribePose(fields_, Optional("at"), pose);
    if (fields_.Has("at")) {
      carry.holder_from_object = pose;
    }
  }

  Fields& fields_;
  const Prop& prop_;
  ObjectUse& use_;
  size_t spots_ = 0;
};

PartBounds BoundsOf(const PropPart& part) {
  PartBounds bounds;
  for (const PropMesh& mesh : part.meshes) {
    for (const glm::vec3& position : mesh.positions) {
      bounds.lower = glm::min(bounds.lower, position);
      bounds.upper = glm::max(bounds.upper, position);
    }
  }
  return bounds;
}

// Bounds of all parts at rest, object frame.
void ComputeBounds(const Prop& prop, glm::vec3& lower, glm::vec3& upper) {
  lower = glm::vec3(std::numeric_limits<float>::max());
  upper = -lower;
  std::vector<Pose> object_from_part;
  for (const PropPart& part : prop.parts) {
    object_from_part.push_back(part.parent == PropPart::kNoParent
                                   ? part.parent_from_part
                                   : object_from_part[static_cast<size_t>(part.parent)] *
                                         part.parent_from_part);
    for (const PropMesh& mesh : part.meshes) {
      for (const glm::vec3& position : mesh.positions) {
        const glm::vec3 point = object_from_part.back() * position;
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
      }
    }
  }
  if (lower.x > upper.x) {  // No vertices.
    lower = upper = glm::vec3(0.0f);
  }
}

// An object that cannot be carried and gives no footprint blocks its bounding box.
void AddDefaultFootprint(const glm::vec3& lower, const glm::vec3& upper, ObjectUse& use) {
  if (upper.x > lower.x && upper.z > lower.z) {
    use.footprint.outline = {
        {lower.x, lower.z}, {upper.x, lower.z}, {upper.x, upper.z}, {lower.x, upper.z}};
  }
}

}  // namespace

int ObjectUse::FindState(std::string_view name) const {
  const auto found = std::find(states.begin(), states.end(), name);
  return found == states.end() ? -1 : static_cast<int>(found - states.begin());
}

int ObjectUse::FindAction(std::string_view name) const { return FindByName(actions, name); }
int ObjectUse::FindGrip(std::string_view name) const { return FindByName(grips, name); }

Result<ObjectUse> ParseObjectUse(std::string_view text,
                                 const Prop& prop,
                                 const std::string& where) {
  if (text.size() > kMaxUseBytes) {
    return Status::Error(where, "is longer than 1 MiB");
  }
  ObjectUse use;
  bool has_footprint = false;
  LARARIUM_RETURN_IF_ERROR(ReadFields(text, where, [&](Fields& fields) {
    UseDescription(fields, prop, use).Describe();
    has_footprint = fields.Has("footprint");
  }));
  if (!has_footprint && !use.carry) {
    glm::vec3 lower;
    glm::vec3 upper;
    ComputeBounds(prop, lower, upper);
    AddDefaultFootprint(lower, upper, use);
  }
  return use;
}

Result<std::shared_ptr<ObjectModel>> ObjectModel::Create(Prop prop, const std::string& where) {
  LARARIUM_RETURN_IF_ERROR(prop.Validate(where));
  std::shared_ptr<ObjectModel> model(new ObjectModel);
  ComputeBounds(prop, model->lower_, model->upper_);
  for (const PropPart& part : prop.parts) {
    model->part_bounds_.push_back(BoundsOf(part));
  }
  if (prop.use.empty()) {
    AddDefaultFootprint(model->lower_, model->upper_, model->use_);
  } else {
    LARARIUM_ASSIGN_OR_RETURN(model->use_, ParseObjectUse(prop.use, prop, where));
  }
  model->prop_ = std::move(prop);
  return model;
}

}  // namespace lararium::stage
