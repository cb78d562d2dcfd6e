#include "shared/stage/object_use.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <initializer_list>
#include <limits>

#include "shared/core/json.h"
#include "shared/light/lamp.h"

namespace lararium::stage {
namespace {

constexpr double kMaxLength = 100.0;         // Limit of all lengths of an object, metres.
constexpr double kMaxDegrees = 720.0;        // Limit of angles.
constexpr double kMaxActionSeconds = 600.0;  // Limit of the duration of an action.
constexpr size_t kMaxNameBytes = 64;
constexpr size_t kMaxTextBytes = 1 << 20;
constexpr size_t kMaxOutline = 12;

float Radians(double degrees) { return static_cast<float>(glm::radians(degrees)); }

template <typename T>
int FindByName(const std::vector<T>& items, std::string_view name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [name](const T& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

Result<glm::vec3> ReadVector(const JsonView& view, double limit = kMaxLength) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> v, view.Numbers(3));
  if (std::any_of(v.begin(), v.end(), [limit](double x) { return std::abs(x) > limit; })) {
    return view.Problem("is out of range");
  }
  return glm::vec3(v[0], v[1], v[2]);
}

Result<glm::vec3> ReadDirection(const JsonView& view) {
  LARARIUM_ASSIGN_OR_RETURN(const glm::vec3 v, ReadVector(view));
  const float length = glm::length(v);
  if (!(length > 1e-3f)) {
    return view.Problem("must be a direction, not zero");
  }
  return v / length;
}

Result<glm::vec2> ReadGroundPoint(const JsonView& view) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> v, view.Numbers(2));
  if (std::abs(v[0]) > kMaxLength || std::abs(v[1]) > kMaxLength) {
    return view.Problem("is out of range");
  }
  return glm::vec2(v[0], v[1]);
}

// The number in `field`, or `fallback` if the field is missing.
Result<double> ReadNumber(
    const JsonView& view, std::string_view field, double fallback, double min, double max) {
  return view.Has(field) ? view.Number(field, min, max) : fallback;
}

Result<std::string> ReadName(const JsonView& view, std::string_view field) {
  return view.Has(field) ? view.Text(field, kMaxNameBytes) : std::string();
}

// {"at": [x, y, z], "heading": degrees} or {"at": ..., "turn": [about x, y, z]}.
Result<Pose> ReadPose(const JsonView& view) {
  Pose pose;
  LARARIUM_ASSIGN_OR_RETURN(const JsonView at, view.Field("at"));
  LARARIUM_ASSIGN_OR_RETURN(pose.position, ReadVector(at));
  glm::vec3 turn(0.0f);
  if (view.Has("turn")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("turn"));
    LARARIUM_ASSIGN_OR_RETURN(turn, ReadVector(field, kMaxDegrees));
  }
  LARARIUM_ASSIGN_OR_RETURN(const double heading,
                            ReadNumber(view, "heading", turn.y, -kMaxDegrees, kMaxDegrees));
  const auto about = [](double degrees, const glm::vec3& axis) {
    return glm::angleAxis(Radians(degrees), axis);
  };
  pose.rotation = glm::normalize(about(heading, {0, 1, 0}) * about(turn.x, {1, 0, 0}) *
                                 about(turn.z, {0, 0, 1}));
  return pose;
}

// Reads one object.json and checks it against its prop. Sections are read in the order in which
// they refer to one another.
class UseReader {
 public:
  UseReader(const JsonView& root, const Prop& prop) : root_(root), prop_(prop) {}

  Result<ObjectUse> Read() {
    LARARIUM_RETURN_IF_ERROR(
        root_.CheckFields({"schema", "states", "parts", "grips", "places", "surfaces", "actions",
                           "sounds", "footprint", "carry", "capacity", "queue", "lights"}));
    LARARIUM_RETURN_IF_ERROR(root_.Integer("schema", 1, 1).status());
    LARARIUM_RETURN_IF_ERROR(ReadStates());
    LARARIUM_RETURN_IF_ERROR(ForEach("parts", Prop::kMaxParts, &UseReader::ReadPart));
    LARARIUM_RETURN_IF_ERROR(ForEach("grips", ObjectUse::kMaxGrips, &UseReader::ReadGrip));
    LARARIUM_RETURN_IF_ERROR(ForEach("lights", ObjectUse::kMaxLights, &UseReader::ReadLight));
    LARARIUM_RETURN_IF_ERROR(ForEach("places", ObjectUse::kMaxPlaces, &UseReader::ReadPlace));
    LARARIUM_RETURN_IF_ERROR(ForEach("surfaces", ObjectUse::kMaxSpots, &UseReader::ReadSurface));
    LARARIUM_RETURN_IF_ERROR(ForEach("actions", ObjectUse::kMaxActions, &UseReader::ReadAction));
    LARARIUM_RETURN_IF_ERROR(ReadSounds());
    LARARIUM_RETURN_IF_ERROR(ReadFootprint());
    LARARIUM_RETURN_IF_ERROR(ReadCarry());
    LARARIUM_RETURN_IF_ERROR(ReadQueue());
    return std::move(use_);
  }

 private:
  // Calls `read` for every named entry of a section, in the order of the names.
  Status ForEach(std::string_view section,
                 size_t max_count,
                 Status (UseReader::*read)(const std::string& name, const JsonView& view)) {
    if (!root_.Has(section)) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView view, root_.Field(section));
    if (!view.json().is_object()) {
      return view.Problem("must be an object of named entries");
    }
    if (view.json().size() > max_count) {
      return view.Problem("has more than the " + std::to_string(max_count) +
                          " entries that are allowed");
    }
    for (const auto& item : view.json().items()) {
      if (item.key().empty() || item.key().size() > kMaxNameBytes) {
        return view.Problem("a name must have from 1 to 64 bytes");
      }
      LARARIUM_ASSIGN_OR_RETURN(const JsonView entry, view.Field(item.key()));
      LARARIUM_RETURN_IF_ERROR((this->*read)(item.key(), entry));
    }
    return Status();
  }

  Status ReadStates() {
    if (!root_.Has("states")) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView view, root_.Field("states"));
    LARARIUM_ASSIGN_OR_RETURN(const auto items, view.Array(ObjectUse::kMaxStates));
    use_.states.clear();
    for (const JsonView& item : items) {
      LARARIUM_ASSIGN_OR_RETURN(std::string name, item.Text(kMaxNameBytes));
      if (name.empty() || use_.FindState(name) >= 0) {
        return item.Problem("every state needs a name of its own");
      }
      use_.states.push_back(std::move(name));
    }
    return use_.states.empty() ? view.Problem("must name at least one state") : Status();
  }

  // The states that a list names, as bits; all states if the field is missing.
  Result<uint32_t> ReadStateSet(const JsonView& view, std::string_view field) {
    return ReadSet(view, field, "state", [this](std::string_view s) { return use_.FindState(s); });
  }

  template <typename Find>
  Result<uint32_t> ReadSet(const JsonView& view,
                           std::string_view field,
                           const std::string& what,
                           Find find) {
    if (!view.Has(field)) {
      return ~0u;
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView list, view.Field(field));
    LARARIUM_ASSIGN_OR_RETURN(const auto items, list.Array(32));
    uint32_t set = 0;
    for (const JsonView& item : items) {
      LARARIUM_ASSIGN_OR_RETURN(const std::string name, item.Text(kMaxNameBytes));
      const int index = find(name);
      if (index < 0) {
        return item.Problem("there is no " + what + " '" + name + "'",
                            "name one that this object has");
      }
      set |= 1u << index;
    }
    return set;
  }

  // Index into Prop::parts; -1 if the field is missing.
  Result<int> ReadPartIndex(const JsonView& view, std::string_view field) {
    if (!view.Has(field)) {
      return -1;
    }
    LARARIUM_ASSIGN_OR_RETURN(const std::string name, view.Text(field, kMaxNameBytes));
    const int part = prop_.FindPart(name);
    if (part < 0) {
      return view.Problem("there is no part '" + name + "'", "name a node of the model");
    }
    return part;
  }

  Status ReadPart(const std::string& name, const JsonView& view) {
    const int part = prop_.FindPart(name);
    if (part < 0) {
      return view.Problem("the model has no part of this name", "name a node of the model");
    }
    LARARIUM_RETURN_IF_ERROR(view.CheckFields({"hinge", "slider", "limits", "rest", "states"}));
    if (view.Has("states")) {
      LARARIUM_ASSIGN_OR_RETURN(const uint32_t states, ReadStateSet(view, "states"));
      use_.shown.push_back({part, states});
    }
    if (view.Has("hinge") && view.Has("slider")) {
      return view.Problem("must be either a hinge or a slider, not both");
    }
    if (view.Has("hinge") || view.Has("slider")) {
      return ReadJoint(part, view);
    }
    return Status();
  }

  Status ReadJoint(int part, const JsonView& view) {
    if (use_.joints.size() == ObjectUse::kMaxJoints) {
      return view.Problem("an object has at most " + std::to_string(ObjectUse::kMaxJoints) +
                          " joints");
    }
    ObjectJoint joint;
    joint.part = part;
    joint.kind = view.Has("hinge") ? ObjectJoint::Kind::kHinge : ObjectJoint::Kind::kSlider;
    const bool turns = joint.kind == ObjectJoint::Kind::kHinge;
    LARARIUM_ASSIGN_OR_RETURN(const JsonView axis, view.Field(turns ? "hinge" : "slider"));
    LARARIUM_ASSIGN_OR_RETURN(joint.axis, ReadDirection(axis));
    LARARIUM_ASSIGN_OR_RETURN(const auto limits, view.Numbers("limits", 2));
    LARARIUM_ASSIGN_OR_RETURN(
        const double rest,
        ReadNumber(view, "rest", std::clamp(0.0, std::min(limits[0], limits[1]), limits[1]),
                   -kMaxDegrees, kMaxDegrees));
    const double most = turns ? kMaxDegrees : kMaxLength;
    if (!(limits[0] <= rest && rest <= limits[1] && limits[0] >= -most && limits[1] <= most)) {
      return view.Problem("limits must be [least, most] with rest in between");
    }
    const auto value = [turns](double x) { return turns ? Radians(x) : static_cast<float>(x); };
    joint.lower = value(limits[0]);
    joint.upper = value(limits[1]);
    joint.rest = value(rest);
    use_.joints.push_back(joint);
    return Status();
  }

  Status ReadGrip(const std::string& name, const JsonView& view) {
    LARARIUM_RETURN_IF_ERROR(view.CheckFields({"part", "at", "palm", "fingers", "hand", "pose"}));
    Grip grip;
    grip.name = name;
    LARARIUM_ASSIGN_OR_RETURN(grip.part, ReadPartIndex(view, "part"));
    LARARIUM_ASSIGN_OR_RETURN(const JsonView at, view.Field("at"));
    LARARIUM_ASSIGN_OR_RETURN(grip.part_from_hand.position, ReadVector(at));
    LARARIUM_ASSIGN_OR_RETURN(const JsonView palm_view, view.Field("palm"));
    LARARIUM_ASSIGN_OR_RETURN(const glm::vec3 palm, ReadDirection(palm_view));
    LARARIUM_ASSIGN_OR_RETURN(const JsonView fingers_view, view.Field("fingers"));
    LARARIUM_ASSIGN_OR_RETURN(const glm::vec3 fingers, ReadDirection(fingers_view));
    const glm::vec3 x = glm::cross(fingers, -palm);
    if (!(glm::length(x) > 0.1f)) {
      return view.Problem("palm and fingers must point in different directions",
                          "palm faces what is held, fingers point along it");
    }
    const glm::vec3 right = glm::normalize(x);
    const glm::vec3 back = -fingers;
    grip.part_from_hand.rotation =
        glm::normalize(glm::quat_cast(glm::mat3(right, glm::cross(back, right), back)));
    if (view.Has("hand")) {
      LARARIUM_ASSIGN_OR_RETURN(const std::string hand, view.Text("hand", kMaxNameBytes));
      if (hand != "left" && hand != "right" && hand != "either") {
        return view.Problem("hand must be \"left\", \"right\" or \"either\"");
      }
      grip.fits = {hand != "left", hand != "right"};
    }
    LARARIUM_ASSIGN_OR_RETURN(const std::string pose, ReadName(view, "pose"));
    if (!pose.empty()) {
      const auto named = human::HandPoseNamed(pose);
      if (!named) {
        return view.Problem("there is no pose '" + pose + "' of a hand",
                            "use relaxed, flat, fist, cylinder, pinch, point, ladle or bowl");
      }
      grip.hand_pose = *named;
    }
    use_.grips.push_back(std::move(grip));
    return Status();
  }

  Result<ApproachPlace> ReadStanding(const JsonView& view) {
    ApproachPlace place;
    LARARIUM_ASSIGN_OR_RETURN(const JsonView at, view.Field("at"));
    LARARIUM_ASSIGN_OR_RETURN(place.position, ReadGroundPoint(at));
    LARARIUM_ASSIGN_OR_RETURN(const double heading,
                              ReadNumber(view, "heading", 0.0, -kMaxDegrees, kMaxDegrees));
    place.heading = Radians(heading);
    return place;
  }

  // Reads "colour": [r, g, b] or "temperature": kelvin.
  static Result<glm::vec3> ReadColour(const JsonView& view) {
    if (view.Has("colour") == view.Has("temperature")) {
      return view.Problem("must have either \"colour\" or \"temperature\"");
    }
    if (view.Has("temperature")) {
      LARARIUM_ASSIGN_OR_RETURN(const double kelvin, view.Number("temperature", 1667.0, 25000.0));
      return light::ColourOfTemperature(kelvin);
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("colour"));
    LARARIUM_ASSIGN_OR_RETURN(const glm::vec3 colour, ReadVector(field));
    const float luminance = glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    if (std::min({colour.r, colour.g, colour.b}) < 0.0f || !(luminance > 1e-6f)) {
      return field.Problem("must be linear red, green and blue of at least 0, not all 0");
    }
    return colour / luminance;
  }

  Status ReadLight(const std::string& name, const JsonView& view) {
    LARARIUM_RETURN_IF_ERROR(view.CheckFields(
        {"part", "at", "colour", "temperature", "intensity", "radius", "flicker", "states"}));
    ObjectLight light;
    light.name = name;
    LARARIUM_ASSIGN_OR_RETURN(light.part, ReadPartIndex(view, "part"));
    LARARIUM_ASSIGN_OR_RETURN(const JsonView at, view.Field("at"));
    LARARIUM_ASSIGN_OR_RETURN(light.position, ReadVector(at));
    LARARIUM_ASSIGN_OR_RETURN(light.colour, ReadColour(view));
    LARARIUM_ASSIGN_OR_RETURN(const double intensity, view.Number("intensity", 0.0, 1e4));
    LARARIUM_ASSIGN_OR_RETURN(const double radius, view.Number("radius", 1e-3, 10.0));
    LARARIUM_ASSIGN_OR_RETURN(const double flicker, ReadNumber(view, "flicker", 0.0, 0.0, 1.0));
    light.intensity = static_cast<float>(intensity);
    light.radius = static_cast<float>(radius);
    light.flicker = static_cast<float>(flicker);
    LARARIUM_ASSIGN_OR_RETURN(light.states, ReadStateSet(view, "states"));
    use_.lights.push_back(std::move(light));
    return Status();
  }

  Status ReadPlace(const std::string& name, const JsonView& view) {
    LARARIUM_RETURN_IF_ERROR(view.CheckFields({"at", "heading"}));
    LARARIUM_ASSIGN_OR_RETURN(ApproachPlace place, ReadStanding(view));
    place.name = name;
    use_.places.push_back(std::move(place));
    return Status();
  }

  int FindPlace(std::string_view name) const { return FindByName(use_.places, name); }

  Status ReadSurface(const std::string& name, const JsonView& view) {
    LARARIUM_RETURN_IF_ERROR(view.CheckFields({"part", "spots"}));
    Surface surface;
    surface.name = name;
    LARARIUM_ASSIGN_OR_RETURN(const int part, ReadPartIndex(view, "part"));
    LARARIUM_ASSIGN_OR_RETURN(const JsonView list, view.Field("spots"));
    LARARIUM_ASSIGN_OR_RETURN(const auto items, list.Array(ObjectUse::kMaxSpots));
    for (const JsonView& item : items) {
      LARARIUM_RETURN_IF_ERROR(item.CheckFields({"at", "heading", "turn", "place"}));
      Spot spot;
      spot.part = part;
      LARARIUM_ASSIGN_OR_RETURN(spot.part_from_spot, ReadPose(item));
      LARARIUM_ASSIGN_OR_RETURN(const std::string place, ReadName(item, "place"));
      spot.place = FindPlace(place);
      if (!place.empty() && spot.place < 0) {
        return item.Problem("there is no place '" + place + "'", "name one that this object has");
      }
      surface.spots.push_back(spot);
    }
    spots_ += surface.spots.size();
    if (surface.spots.empty() || spots_ > ObjectUse::kMaxSpots) {
      return view.Problem("surfaces have from 1 to " + std::to_string(ObjectUse::kMaxSpots) +
                          " spots in all");
    }
    use_.surfaces.push_back(std::move(surface));
    return Status();
  }

  Result<HandGrips> ReadHands(const JsonView& view) {
    HandGrips hands = kNoHands;
    if (!view.Has("hands")) {
      return hands;
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("hands"));
    LARARIUM_RETURN_IF_ERROR(field.CheckFields({"left", "right"}));
    constexpr const char* kNames[] = {"right", "left"};  // Indexed by side.
    for (size_t hand = 0; hand < 2; ++hand) {
      if (!field.Has(kNames[hand])) {
        continue;
      }
      LARARIUM_ASSIGN_OR_RETURN(const std::string name, field.Text(kNames[hand], kMaxNameBytes));
      hands[hand] = use_.FindGrip(name);
      if (hands[hand] < 0) {
        return field.Problem("there is no grip '" + name + "'", "name one that this object has");
      }
      if (!use_.grips[static_cast<size_t>(hands[hand])].fits[hand]) {
        return field.Problem("the grip '" + name + "' is for the other hand");
      }
    }
    return hands;
  }

  Status ReadAction(const std::string& name, const JsonView& view) {
    LARARIUM_RETURN_IF_ERROR(
        view.CheckFields({"from", "to", "held", "places", "hands", "duration", "release", "moves",
                          "path", "clip", "sound", "seat"}));
    ObjectAction action;
    action.name = name;
    LARARIUM_ASSIGN_OR_RETURN(action.from, ReadStateSet(view, "from"));
    LARARIUM_ASSIGN_OR_RETURN(const std::string to, ReadName(view, "to"));
    action.to = to.empty() ? -1 : use_.FindState(to);
    if (!to.empty() && action.to < 0) {
      return view.Problem("there is no state '" + to + "'", "name it in \"states\"");
    }
    if (view.Has("held")) {
      LARARIUM_ASSIGN_OR_RETURN(const JsonView held, view.Field("held"));
      LARARIUM_ASSIGN_OR_RETURN(action.held, held.Boolean());
    }
    LARARIUM_ASSIGN_OR_RETURN(
        action.places,
        ReadSet(view, "places", "place", [this](std::string_view p) { return FindPlace(p); }));
    if (action.held ? view.Has("places") || view.Has("seat") : use_.places.empty()) {
      return view.Problem(action.held ? "an action with a held object cannot have places or a seat"
                                      : "the action needs a place where the actor stands",
                          action.held ? "" : "add one to \"places\"");
    }
    if (action.places == 0) {
      return view.Problem("the list \"places\" is empty",
                          "name a place in it, or remove it to allow every place");
    }
    LARARIUM_ASSIGN_OR_RETURN(action.hands, ReadHands(view));
    LARARIUM_ASSIGN_OR_RETURN(const double duration,
                              ReadNumber(view, "duration", 1.0, 0.0, kMaxActionSeconds));
    action.duration = static_cast<float>(duration);
    LARARIUM_ASSIGN_OR_RETURN(const double release, ReadNumber(view, "release", kMaxActionSeconds,
                                                               0.0, kMaxActionSeconds));
    action.release = static_cast<float>(release);
    LARARIUM_ASSIGN_OR_RETURN(action.clip, ReadName(view, "clip"));
    LARARIUM_RETURN_IF_ERROR(ReadActionSound(view, action));
    LARARIUM_RETURN_IF_ERROR(ReadMoves(view, action));
    LARARIUM_RETURN_IF_ERROR(ReadPath(view, action));
    if (view.Has("seat")) {
      LARARIUM_ASSIGN_OR_RETURN(const JsonView seat, view.Field("seat"));
      LARARIUM_RETURN_IF_ERROR(seat.CheckFields({"at", "heading"}));
      LARARIUM_ASSIGN_OR_RETURN(const JsonView at, seat.Field("at"));
      ObjectAction::Seat place;
      LARARIUM_ASSIGN_OR_RETURN(place.position, ReadVector(at));
      LARARIUM_ASSIGN_OR_RETURN(const double heading,
                                ReadNumber(seat, "heading", 0.0, -kMaxDegrees, kMaxDegrees));
      place.heading = Radians(heading);
      action.seat = place;
    }
    use_.actions.push_back(std::move(action));
    return Status();
  }

  // The field is either the name of a sound or an object.
  Status ReadActionSound(const JsonView& view, ObjectAction& action) {
    if (!view.Has("sound")) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field("sound"));
    ActionSound& sound = action.sound;
    if (field.json().is_string()) {
      LARARIUM_ASSIGN_OR_RETURN(sound.name, ReadName(view, "sound"));
      return Status();
    }
    LARARIUM_RETURN_IF_ERROR(field.CheckFields({"name", "begin", "end", "loop", "gain_db"}));
    LARARIUM_ASSIGN_OR_RETURN(sound.name, field.Text("name", kMaxNameBytes));
    LARARIUM_ASSIGN_OR_RETURN(const double begin,
                              ReadNumber(field, "begin", 0.0, 0.0, kMaxActionSeconds));
    LARARIUM_ASSIGN_OR_RETURN(
        const double end, ReadNumber(field, "end", kMaxActionSeconds, begin, kMaxActionSeconds));
    sound.begin = static_cast<float>(begin);
    sound.end = static_cast<float>(end);
    if (field.Has("loop")) {
      LARARIUM_ASSIGN_OR_RETURN(const JsonView loop, field.Field("loop"));
      LARARIUM_ASSIGN_OR_RETURN(sound.loops, loop.Boolean());
    }
    return ReadGain(field, sound.gain_db);
  }

  Status ReadGain(const JsonView& view, float& gain_db) {
    LARARIUM_ASSIGN_OR_RETURN(const double gain, ReadNumber(view, "gain_db", 0.0, -60.0, 12.0));
    gain_db = static_cast<float>(gain);
    return Status();
  }

  Status ReadSounds() {
    if (!root_.Has("sounds")) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView list, root_.Field("sounds"));
    LARARIUM_ASSIGN_OR_RETURN(const auto items, list.Array(ObjectUse::kMaxSounds));
    for (const JsonView& item : items) {
      LARARIUM_RETURN_IF_ERROR(item.CheckFields({"name", "states", "at", "gain_db"}));
      StateSound sound;
      LARARIUM_ASSIGN_OR_RETURN(sound.name, item.Text("name", kMaxNameBytes));
      LARARIUM_ASSIGN_OR_RETURN(sound.states, ReadStateSet(item, "states"));
      if (item.Has("at")) {
        LARARIUM_ASSIGN_OR_RETURN(const JsonView at, item.Field("at"));
        LARARIUM_ASSIGN_OR_RETURN(sound.position, ReadVector(at));
      }
      LARARIUM_RETURN_IF_ERROR(ReadGain(item, sound.gain_db));
      use_.sounds.push_back(std::move(sound));
    }
    return Status();
  }

  Status ReadMoves(const JsonView& view, ObjectAction& action) {
    if (!view.Has("moves")) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView list, view.Field("moves"));
    LARARIUM_ASSIGN_OR_RETURN(const auto items, list.Array(ObjectUse::kMaxKeys));
    for (const JsonView& item : items) {
      LARARIUM_RETURN_IF_ERROR(item.CheckFields({"part", "to", "begin", "end"}));
      ObjectAction::Move move;
      LARARIUM_RETURN_IF_ERROR(item.Field("part").status());
      LARARIUM_ASSIGN_OR_RETURN(const int part, ReadPartIndex(item, "part"));
      const auto joint = std::find_if(use_.joints.begin(), use_.joints.end(),
                                      [part](const ObjectJoint& j) { return j.part == part; });
      if (joint == use_.joints.end()) {
        return item.Problem("this part has no joint", "give it a hinge or a slider in \"parts\"");
      }
      move.joint = static_cast<int>(joint - use_.joints.begin());
      LARARIUM_ASSIGN_OR_RETURN(const double to, item.Number("to", -kMaxDegrees, kMaxDegrees));
      move.to = joint->kind == ObjectJoint::Kind::kHinge ? Radians(to) : static_cast<float>(to);
      if (move.to < joint->lower - 1e-5f || move.to > joint->upper + 1e-5f) {
        return item.Problem("\"to\" is outside of the joint's limits");
      }
      LARARIUM_ASSIGN_OR_RETURN(const double begin,
                                ReadNumber(item, "begin", 0.0, 0.0, action.duration));
      LARARIUM_ASSIGN_OR_RETURN(const double end,
                                ReadNumber(item, "end", action.duration, begin, action.duration));
      move.begin = static_cast<float>(begin);
      move.end = static_cast<float>(end);
      action.moves.push_back(move);
    }
    return Status();
  }

  Status ReadPath(const JsonView& view, ObjectAction& action) {
    if (!view.Has("path")) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView list, view.Field("path"));
    LARARIUM_ASSIGN_OR_RETURN(const auto items, list.Array(ObjectUse::kMaxKeys));
    double last = 0.0;
    for (const JsonView& item : items) {
      LARARIUM_RETURN_IF_ERROR(item.CheckFields({"t", "at", "turn", "heading"}));
      LARARIUM_ASSIGN_OR_RETURN(last, item.Number("t", last, action.duration));
      LARARIUM_ASSIGN_OR_RETURN(const Pose pose, ReadPose(item));
      action.path.push_back({static_cast<float>(last), pose});
    }
    return Status();
  }

  Status ReadFootprint() {
    if (!root_.Has("footprint")) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView view, root_.Field("footprint"));
    LARARIUM_RETURN_IF_ERROR(view.CheckFields({"outline", "states"}));
    LARARIUM_ASSIGN_OR_RETURN(const JsonView list, view.Field("outline"));
    LARARIUM_ASSIGN_OR_RETURN(const auto items, list.Array(kMaxOutline));
    for (const JsonView& item : items) {
      LARARIUM_ASSIGN_OR_RETURN(const glm::vec2 corner, ReadGroundPoint(item));
      use_.footprint.outline.push_back(corner);
    }
    if (!IsConvex(use_.footprint.outline)) {
      return list.Problem("must be empty or the corners of a convex outline, in their order");
    }
    LARARIUM_ASSIGN_OR_RETURN(use_.footprint.states, ReadStateSet(view, "states"));
    has_footprint_ = true;
    return Status();
  }

  static bool IsConvex(const std::vector<glm::vec2>& outline) {
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

  Status ReadCarry() {
    if (!root_.Has("carry")) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView view, root_.Field("carry"));
    LARARIUM_RETURN_IF_ERROR(view.CheckFields({"hands", "at", "heading", "turn"}));
    Carry carry;
    LARARIUM_ASSIGN_OR_RETURN(carry.hands, ReadHands(view));
    const auto hands =
        std::count_if(carry.hands.begin(), carry.hands.end(), [](int grip) { return grip >= 0; });
    if (hands == 0) {
      return view.Problem("at least one hand must hold the object", "name a grip in \"hands\"");
    }
    if (view.Has("at")) {
      LARARIUM_ASSIGN_OR_RETURN(carry.holder_from_object, ReadPose(view));
    } else if (hands == 2) {
      return view.Problem("the position of an object that both hands carry is missing",
                          "add \"at\"");
    }
    use_.carry = carry;
    return Status();
  }

  Status ReadQueue() {
    if (root_.Has("capacity")) {
      LARARIUM_ASSIGN_OR_RETURN(const int64_t capacity, root_.Integer("capacity", 1, 32));
      use_.capacity = static_cast<int>(capacity);
    }
    if (!root_.Has("queue")) {
      return Status();
    }
    LARARIUM_ASSIGN_OR_RETURN(const JsonView view, root_.Field("queue"));
    LARARIUM_RETURN_IF_ERROR(view.CheckFields({"at", "heading", "step"}));
    LARARIUM_ASSIGN_OR_RETURN(use_.queue, ReadStanding(view));
    if (view.Has("step")) {
      LARARIUM_ASSIGN_OR_RETURN(const JsonView step, view.Field("step"));
      LARARIUM_ASSIGN_OR_RETURN(use_.queue_step, ReadGroundPoint(step));
    }
    return Status();
  }

 public:
  bool has_footprint() const { return has_footprint_; }

 private:
  const JsonView& root_;
  const Prop& prop_;
  ObjectUse use_;
  size_t spots_ = 0;
  bool has_footprint_ = false;
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
  if (text.size() > kMaxTextBytes) {
    return Status::Error(where, "is longer than 1 MiB");
  }
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, where));
  const JsonView root(json, where);
  UseReader reader(root, prop);
  LARARIUM_ASSIGN_OR_RETURN(ObjectUse use, reader.Read());
  if (!reader.has_footprint() && !use.carry) {
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
