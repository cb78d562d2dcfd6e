#include "editor/import/motion/bml.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <utility>

#include "editor/text/foreign_text.h"
#include "shared/core/lower_case.h"

namespace lararium::import {
namespace {

using drama::LaneKind;
using drama::SyncPoint;
using drama::SyncTimes;

constexpr size_t kMaxBehaviours = 2000;
constexpr double kLongest = 24 * 3600.0;
constexpr double kFaceSeconds = 2.0;       // Default duration of a facial expression.
constexpr double kSecondsOfLetter = 0.06;  // Duration per letter of speech that is not a line.
constexpr double kRun = 2.5;               // Metres per second.

// BML's names of the seven points, by SyncPoint; faces use other names for some of them.
constexpr std::array<std::string_view, stage::kSyncPoints> kPointNames = {
    "start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end"};

std::optional<SyncPoint> PointNamed(std::string_view name) {
  if (name == "attackPeak") {
    return SyncPoint::kReady;
  }
  const auto found = std::find(kPointNames.begin(), kPointNames.end(), name);
  return found == kPointNames.end()
             ? std::nullopt
             : std::optional(static_cast<SyncPoint>(found - kPointNames.begin()));
}

std::string_view LocalName(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

// The first child of that name in any namespace.
pugi::xml_node Child(const pugi::xml_node& node, std::string_view name) {
  return node.find_child([name](const pugi::xml_node& child) { return LocalName(child) == name; });
}

// Calls visit(node) for all nodes below a node, in order of the text. Does not recurse, because
// files may be nested deeply.
template <typename Visit>
void ForEachBelow(pugi::xml_node node, Visit visit) {
  struct Walker : pugi::xml_tree_walker {
    explicit Walker(Visit& visit) : visit(visit) {}
    bool for_each(pugi::xml_node& below) override {
      visit(below);
      return true;
    }
    Visit& visit;
  };
  Walker walker(visit);
  node.traverse(walker);
}

// The encoding in the XML declaration; empty if there is none.
std::string DeclaredEncoding(std::string_view text) {
  const std::string_view head = text.substr(0, std::min<size_t>(text.find("?>"), 200));
  const size_t at = head.find("encoding");
  const size_t quote = head.find_first_of("'\"", at);
  const size_t end = quote == std::string_view::npos ? quote : head.find(head[quote], quote + 1);
  return at == std::string_view::npos || end == std::string_view::npos
             ? ""
             : std::string(head.substr(quote + 1, end - quote - 1));
}

// Words separated by single blanks.
std::string Words(std::string_view text) {
  std::string words;
  for (const char c : editor::TrimBlanks(text)) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!blank) {
      words += c;
    } else if (!words.empty() && words.back() != ' ') {
      words += ' ';
    }
  }
  return words;
}

std::optional<double> NumberOf(std::string_view text) {
  text = editor::TrimBlanks(text);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::abs(value) <= kLongest ? std::optional(value) : std::nullopt;
}

// Seconds such as "1.5", or a point of another behaviour with an offset: "speech1:end + 0.2".
struct SyncReference {
  std::string behaviour;  // If it is empty, `seconds` counts from the begin of the block.
  std::string point;
  double seconds = 0.0;
};

std::optional<SyncReference> ParseReference(std::string_view text, std::string_view block) {
  text = editor::TrimBlanks(text);
  if (const auto seconds = NumberOf(text)) {
    return SyncReference{"", "", *seconds};
  }
  SyncReference reference;
  for (size_t at = text.size(); at > 0; --at) {
    const char c = text[at - 1];
    if (c == '+' || c == '-') {
      if (const auto seconds = NumberOf(text.substr(at))) {
        reference.seconds = c == '-' ? -*seconds : *seconds;
        text = editor::TrimBlanks(text.substr(0, at - 1));
        break;
      }
    }
  }
  if (!block.empty() && text.starts_with(block) && text.substr(block.size()).starts_with(':') &&
      text.find(':', block.size() + 1) != std::string_view::npos) {
    text.remove_prefix(block.size() + 1);
  }
  const size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon == 0) {
    return std::nullopt;
  }
  reference.behaviour = text.substr(0, colon);
  reference.point = text.substr(colon + 1);
  // In "stroke:2" of repeated strokes, the first stroke stands for all.
  reference.point = reference.point.substr(0, reference.point.find(':'));
  return reference;
}

struct Behaviour {
  pugi::xml_node node;
  std::string tag;
  std::string id;
  std::string block;
  std::string actor;
  double block_begin = 0.0;
  std::array<std::optional<SyncReference>, stage::kSyncPoints> wanted;
  SyncTimes natural = {};                            // Seconds after its start.
  std::map<std::string, double, std::less<>> marks;  // Marks in speech, seconds after its start.
  std::string line;                                  // Id of a spoken line, if it is known.
  // Set when the behaviour is scheduled.
  std::optional<double> start;
  double end = 0.0;

  bool Waits() const {
    return std::any_of(wanted.begin(), wanted.end(), [](const auto& w) { return w.has_value(); });
  }
  const std::optional<SyncReference>& Wanted(SyncPoint point) const {
    return wanted[static_cast<size_t>(point)];
  }
};

class BmlReader {
 public:
  BmlReader(std::string_view text, std::string where, const BmlStage& stage)
      : text_(text), place_(std::move(where)), stage_(stage) {}

  Result<BmlImport> Read(double begin) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed) {
      return Status::Error(place_ + ":" + std::to_string(LineOf(parsed.offset)),
                           std::string("is not valid XML: ") + parsed.description());
    }
    WarnOfEntities();
    std::vector<pugi::xml_node> blocks;
    ForEachBelow(document, [&blocks](const pugi::xml_node& node) {
      if (LocalName(node) == "bml") {
        blocks.push_back(node);
      }
    });
    if (blocks.empty()) {
      return Status::Error(place_, "has no <bml> in it");
    }
    for (const pugi::xml_node& block : blocks) {
      const bool append = LowerCase(block.attribute("composition").as_string()) == "append";
      LARARIUM_RETURN_IF_ERROR(ReadBlock(block, append ? std::max(last_end_, begin) : begin));
    }
    std::stable_sort(import_.items.begin(), import_.items.end(), [](const auto& a, const auto& b) {
      return a.fields["at"].template get<double>() < b.fields["at"].template get<double>();
    });
    return std::move(import_);
  }

 private:
  size_t LineOf(ptrdiff_t offset) const {
    const auto end = text_.begin() + std::clamp<ptrdiff_t>(offset, 0, std::ssize(text_));
    return static_cast<size_t>(std::count(text_.begin(), end, '\n')) + 1;
  }

  // Entities that a document type declares are never expanded: a few lines could become gigabytes,
  // or name other files.
  void WarnOfEntities() {
    for (size_t at = text_.find('&'); at != std::string_view::npos; at = text_.find('&', at + 1)) {
      const size_t end = text_.find_first_not_of(
          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-", at + 1);
      const std::string name(text_.substr(at + 1, std::min(end, text_.size()) - at - 1));
      const bool known =
          name == "amp" || name == "lt" || name == "gt" || name == "quot" || name == "apos";
      if (end < text_.size() && text_[end] == ';' && !name.empty() && !known &&
          !InDocumentType(at)) {
        import_.warnings.push_back(place_ + ":" +
                                   std::to_string(LineOf(static_cast<ptrdiff_t>(at))) +
                                   ": the entity '&" + name + ";' is left as it is");
        return;
      }
    }
  }

  // Tells of attributes that mean nothing here. Those with a prefix belong to other programs.
  void WarnOfAttributes(const pugi::xml_node& node) {
    constexpr std::string_view kKnown[] = {
        "id",       "lexeme",    "target", "repetition",  "amount",          "au",   "manner",
        "duration", "influence", "type",   "offsetAngle", "offsetDirection", "xmlns"};
    std::string names;
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string_view name = attribute.name();
      const bool known = std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown);
      if (!known && !PointNamed(name) && name.find(':') == std::string_view::npos) {
        names += (names.empty() ? "" : ", ") + std::string(name);
      }
    }
    if (!names.empty()) {
      Warn(node, "has no meaning here and was left out: " + names);
    }
  }

  bool InDocumentType(size_t at) const {
    const size_t begin = text_.find("<!DOCTYPE");
    return begin < at && at < text_.find("]", begin);
  }

  // The kind and id of a behaviour.
  static std::string NameOf(const pugi::xml_node& node) {
    const std::string id = node.attribute("id").as_string();
    return std::string(LocalName(node)) + (id.empty() ? "" : " '" + id + "'");
  }

  void Warn(const pugi::xml_node& node, const std::string& what) {
    import_.warnings.push_back(place_ + ":" + std::to_string(LineOf(node.offset_debug())) + ": " +
                               NameOf(node) + ": " + what);
  }

  std::optional<std::string> ActorOf(const pugi::xml_node& block) {
    const std::string character = block.attribute("characterId").as_string();
    const auto found = stage_.characters.find(character);
    if (found == stage_.characters.end()) {
      Warn(block, character.empty()
                      ? "does not say whose behaviour it is; name a character with characterId"
                      : "there is no actor for the character '" + character +
                            "'; name one with --actor " + character + "=NAME");
      return std::nullopt;
    }
    return found->second;
  }

  Status ReadBlock(const pugi::xml_node& block, double begin) {
    const std::optional<std::string> actor = ActorOf(block);
    if (!actor) {
      return Status();
    }
    const size_t first = behaviours_.size();
    const std::string id = block.attribute("id").as_string();
    std::vector<pugi::xml_node> nodes;
    for (const pugi::xml_node& node : block.children()) {
      // <required> groups what must not be left out; we take all that we can.
      const bool group = LocalName(node) == "required";
      for (const pugi::xml_node& part : node.children()) {
        if (group) {
          nodes.push_back(part);
        }
      }
      if (!group && LocalName(node) != "bml") {
        nodes.push_back(node);
      }
    }
    for (const pugi::xml_node& node : nodes) {
      if (node.type() == pugi::node_element && LocalName(node) != "constraint") {
        LARARIUM_RETURN_IF_ERROR(AddBehaviour(node, id, *actor, begin));
      }
    }
    for (const pugi::xml_node& node : nodes) {
      if (LocalName(node) == "constraint") {
        AddConstraint(node, id);
      }
    }
    Resolve(first);
    for (size_t i = first; i < behaviours_.size(); ++i) {
      if (behaviours_[i].start) {
        last_end_ = std::max(last_end_, behaviours_[i].end);
        Emit(behaviours_[i]);
      }
    }
    return Status();
  }

  // ---- Behaviours and their points ----

  Status AddBehaviour(const pugi::xml_node& node,
                      const std::string& block,
                      const std::string& actor,
                      double begin) {
    if (behaviours_.size() >= kMaxBehaviours) {
      return Status::Error(place_, "has more than 2000 behaviours", "split it");
    }
    Behaviour behaviour;
    behaviour.node = node;
    behaviour.tag = LocalName(node);
    behaviour.id = node.attribute("id").as_string();
    behaviour.block = block;
    behaviour.actor = actor;
    behaviour.block_begin = begin;
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::optional<SyncPoint> point = PointNamed(attribute.name());
      if (!point) {
        continue;
      }
      auto& wanted = behaviour.wanted[static_cast<size_t>(*point)];
      wanted = ParseReference(attribute.value(), block);
      if (!wanted) {
        Warn(node, std::string(attribute.name()) + "=\"" + attribute.value() +
                       "\" is neither a time nor a point of a behaviour; it was left out");
        return Status();
      }
    }
    WarnOfAttributes(node);
    TimeNaturally(behaviour);
    if (!behaviour.id.empty() && !by_id_.emplace(behaviour.id, behaviours_.size()).second) {
      Warn(node, "another behaviour has the same id; references mean the first");
    }
    behaviours_.push_back(std::move(behaviour));
    return Status();
  }

  void TimeNaturally(Behaviour& behaviour) {
    if (behaviour.tag == "speech") {
      TimeSpeech(behaviour);
    } else if (const SyncTimes* clip = ClipOf(behaviour)) {
      behaviour.natural = *clip;
    } else if (behaviour.tag.starts_with("face")) {
      behaviour.natural = drama::PlainTimes(kFaceSeconds);
    } else if (behaviour.tag == "wait") {
      const auto seconds = NumberOf(behaviour.node.attribute("duration").as_string());
      behaviour.natural = drama::PlainTimes(std::max(seconds.value_or(0.0), 0.0));
    }
  }

  void TimeSpeech(Behaviour& speech) {
    std::string text;
    std::vector<std::pair<std::string, size_t>> marks;
    const pugi::xml_node said = Child(speech.node, "text");
    CollectText(said ? said : speech.node, text, marks);
    const std::string words = Words(text);
    for (const auto& [id, line] : stage_.lines) {
      const bool says = std::any_of(line.texts.begin(), line.texts.end(),
                                    [&](const std::string& said) { return Words(said) == words; });
      if (says || (speech.line.empty() && id == speech.id)) {
        speech.line = id;
        speech.natural = line.times;
        if (says) {
          break;
        }
      }
    }
    if (speech.line.empty()) {
      speech.natural = drama::PlainTimes(kSecondsOfLetter * static_cast<double>(words.size()));
      Warn(speech.node, "no line has the text '" + words.substr(0, 60) + "'; add it to lines.csv");
    }
    // Places marks within the stroke in proportion to the letters before them.
    const double from = speech.natural[static_cast<size_t>(SyncPoint::kStrokeStart)];
    const double to = speech.natural[static_cast<size_t>(SyncPoint::kStrokeEnd)];
    for (const auto& [id, letters] : marks) {
      const double share =
          static_cast<double>(letters) / static_cast<double>(std::max<size_t>(text.size(), 1));
      speech.marks[id] = from + share * (to - from);
    }
  }

  static void CollectText(const pugi::xml_node& node,
                          std::string& text,
                          std::vector<std::pair<std::string, size_t>>& marks) {
    ForEachBelow(node, [&](const pugi::xml_node& child) {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
        text += child.value();
      } else if (LocalName(child) == "sync") {
        marks.emplace_back(child.attribute("id").as_string(), text.size());
        text += ' ';
      }
    });
  }

  // The clip of the actor for a gesture, a head movement or pointing.
  const SyncTimes* ClipOf(const Behaviour& behaviour) const {
    const auto clips = stage_.clips.find(behaviour.actor);
    if (clips == stage_.clips.end()) {
      return nullptr;
    }
    const auto clip = clips->second.find(ClipName(behaviour));
    return clip == clips->second.end() ? nullptr : &clip->second;
  }

  static std::string ClipName(const Behaviour& behaviour) {
    if (behaviour.tag == "pointing") {
      return "point";
    }
    return behaviour.tag == "gesture" || behaviour.tag == "head"
               ? LowerCase(behaviour.node.attribute("lexeme").as_string())
               : "";
  }

  // Points that must coincide: the later ones wait for the first.
  void AddConstraint(const pugi::xml_node& constraint, const std::string& block) {
    for (const pugi::xml_node& node : constraint.children()) {
      if (LocalName(node) == "synchronize") {
        Synchronize(node, block);
      } else if (node.type() == pugi::node_element) {
        Warn(node, "is not supported; only <synchronize> is");
      }
    }
  }

  void Synchronize(const pugi::xml_node& node, const std::string& block) {
    std::vector<SyncReference> points;
    const auto add = [&](const char* text) {
      const auto reference = ParseReference(text, block);
      if (reference && by_id_.contains(reference->behaviour)) {
        points.push_back(*reference);
      } else {
        Warn(node, std::string("'") + text + "' is not a point of a behaviour");
      }
    };
    if (node.attribute("ref")) {
      add(node.attribute("ref").as_string());
    }
    for (const pugi::xml_node& child : node.children()) {
      if (LocalName(child) == "sync") {
        add(child.attribute("ref").as_string());
      }
    }
    // The points wait for a behaviour with a known time, or for speech.
    const auto leads = [&](const SyncReference& point) {
      const Behaviour& behaviour = behaviours_[by_id_.find(point.behaviour)->second];
      return behaviour.Waits() || behaviour.tag == "speech";
    };
    std::stable_partition(points.begin(), points.end(), leads);
    for (size_t i = 1; i < points.size(); ++i) {
      Behaviour& behaviour = behaviours_[by_id_.find(points[i].behaviour)->second];
      const std::optional<SyncPoint> point = PointNamed(points[i].point);
      if (!point || behaviour.Waits()) {
        Warn(node,
             "'" + points[i].behaviour + "' has a time of its own, or that point cannot be moved");
        continue;
      }
      SyncReference wanted = points[0];
      wanted.seconds -= points[i].seconds;
      behaviour.wanted[static_cast<size_t>(*point)] = wanted;
    }
  }

  // ---- Scheduling ----

  // Seconds of the drama; nullopt if it is not known yet.
  std::optional<double> TimeOf(const SyncReference& reference, const Behaviour& asker) const {
    if (reference.behaviour.empty()) {
      return asker.block_begin + reference.seconds;
    }
    const auto found = by_id_.find(reference.behaviour);
    if (found == by_id_.end() || !behaviours_[found->second].start) {
      return std::nullopt;
    }
    const Behaviour& other = behaviours_[found->second];
    if (const auto mark = other.marks.find(reference.point); mark != other.marks.end()) {
      return *other.start + mark->second + reference.seconds;
    }
    const std::optional<SyncPoint> point = PointNamed(reference.point);
    if (!point) {
      return std::nullopt;
    }
    const double at = *point == SyncPoint::kEnd
                          ? other.end
                          : *other.start + other.natural[static_cast<size_t>(*point)];
    return at + reference.seconds;
  }

  // Computes the start from a known point: the start itself, otherwise the most important of
  // the others.
  std::optional<double> StartOf(const Behaviour& behaviour) const {
    constexpr std::array kOrder = {
        SyncPoint::kStart, SyncPoint::kStroke, SyncPoint::kStrokeStart, SyncPoint::kStrokeEnd,
        SyncPoint::kReady, SyncPoint::kRelax,  SyncPoint::kEnd};
    for (const SyncPoint point : kOrder) {
      if (const auto& wanted = behaviour.Wanted(point)) {
        const std::optional<double> time = TimeOf(*wanted, behaviour);
        return time ? std::optional(*time - behaviour.natural[static_cast<size_t>(point)])
                    : std::nullopt;
      }
    }
    return behaviour.block_begin;
  }

  // Returns false if the end depends on a time that is not known yet.
  bool Place(Behaviour& behaviour, double start) {
    behaviour.end = start + behaviour.natural.back();
    if (const auto& end = behaviour.Wanted(SyncPoint::kEnd)) {
      const std::optional<double> time = TimeOf(*end, behaviour);
      if (!time) {
        return false;
      }
      behaviour.end = std::max(*time, start);
    }
    behaviour.start = start;
    return true;
  }

  void Resolve(size_t first) {
    bool progress = true;
    while (progress) {
      progress = false;
      for (size_t i = first; i < behaviours_.size(); ++i) {
        Behaviour& behaviour = behaviours_[i];
        if (!behaviour.start) {
          const std::optional<double> start = StartOf(behaviour);
          progress |= start && Place(behaviour, *start);
        }
      }
    }
    const Behaviour* waiting = nullptr;
    std::string others;
    for (size_t i = first; i < behaviours_.size(); ++i) {
      const Behaviour& behaviour = behaviours_[i];
      if (behaviour.start) {
        CheckOtherPoints(behaviour);
      } else if (NamesMissingPoint(behaviour)) {
        Warn(behaviour.node, "waits for a point that never occurs; it was left out");
      } else if (waiting == nullptr) {
        waiting = &behaviour;
      } else {
        others += (others.empty() ? "; left out as well: " : ", ") + NameOf(behaviour.node) +
                  " in line " + std::to_string(LineOf(behaviour.node.offset_debug()));
      }
    }
    if (waiting != nullptr) {
      Warn(waiting->node,
           "waits for a behaviour that waits for it, or that was left out; it was left out" +
               others);
    }
  }

  // Whether a behaviour waits for something that the file does not have. Otherwise it waits for
  // behaviours that have no time themselves.
  bool NamesMissingPoint(const Behaviour& behaviour) const {
    return std::any_of(behaviour.wanted.begin(), behaviour.wanted.end(),
                       [this](const auto& wanted) {
                         if (!wanted || wanted->behaviour.empty()) {
                           return false;
                         }
                         const auto found = by_id_.find(wanted->behaviour);
                         return found == by_id_.end() ||
                                (!behaviours_[found->second].marks.contains(wanted->point) &&
                                 !PointNamed(wanted->point));
                       });
  }

  // Behaviours are not stretched: only one of several requested points is kept.
  void CheckOtherPoints(const Behaviour& behaviour) {
    constexpr double kClose = 0.1;  // seconds
    for (int i = 1; i + 1 < stage::kSyncPoints; ++i) {
      const auto point = static_cast<size_t>(i);
      const auto time =
          behaviour.wanted[point] ? TimeOf(*behaviour.wanted[point], behaviour) : std::nullopt;
      const double at = *behaviour.start + behaviour.natural[point];
      if (time && std::abs(*time - at) > kClose) {
        char text[120];
        std::snprintf(text, sizeof(text), "its %s comes at %.2f s, not at %.2f s",
                      std::string(kPointNames[point]).c_str(), at, *time);
        Warn(behaviour.node, text);
      }
    }
  }

  // ---- Conversion to items ----

  void Emit(const Behaviour& behaviour) {
    static constexpr std::pair<std::string_view, void (BmlReader::*)(const Behaviour&)> kTakers[] =
        {{"gaze", &BmlReader::EmitGaze},
         {"gazeShift", &BmlReader::EmitGaze},
         {"head", &BmlReader::EmitGesture},
         {"gesture", &BmlReader::EmitGesture},
         {"pointing", &BmlReader::EmitGesture},
         {"posture", &BmlReader::EmitPosture},
         {"postureShift", &BmlReader::EmitPosture},
         {"locomotion", &BmlReader::EmitLocomotion},
         {"speech", &BmlReader::EmitSpeech},
         {"face", &BmlReader::EmitFace},
         {"faceShift", &BmlReader::EmitFace},
         {"faceLexeme", &BmlReader::EmitFace},
         {"faceFacs", &BmlReader::EmitFace},
         {"wait", &BmlReader::EmitNothing}};
    for (const auto& [tag, take] : kTakers) {
      if (tag == behaviour.tag) {
        return (this->*take)(behaviour);
      }
    }
    Warn(behaviour.node, "is not supported");
  }

  void EmitNothing(const Behaviour& /*behaviour*/) {}

  void Add(const Behaviour& behaviour, LaneKind lane, Json fields) {
    if (*behaviour.start < 0.0) {
      Warn(behaviour.node, "would begin before the drama; it begins with the drama");
    }
    fields["at"] = std::round(std::max(*behaviour.start, 0.0) * 1000.0) / 1000.0;
    if (!behaviour.id.empty()) {
      fields["id"] = behaviour.id;
    }
    import_.items.push_back({lane, behaviour.actor, std::move(fields)});
  }

  static double LengthOf(const Behaviour& behaviour) {
    return std::round((behaviour.end - std::max(*behaviour.start, 0.0)) * 1000.0) / 1000.0;
  }

  // The target in the form of look_at; null if it does not exist.
  Json TargetOf(const std::string& name) const {
    const std::string plain = LowerCase(name);
    for (const char* visitor : {"", "audience", "camera", "user", "visitor"}) {
      if (plain == visitor) {
        return "visitor";
      }
    }
    if (const auto character = stage_.characters.find(name); character != stage_.characters.end()) {
      return character->second;
    }
    return stage_.objects.contains(name) ? Json(name) : Json();
  }

  void EmitGaze(const Behaviour& behaviour) {
    const std::string name = behaviour.node.attribute("target").as_string();
    const Json target = TargetOf(name);
    if (target.is_null()) {
      return Warn(behaviour.node, "there is no actor or object called '" + name + "'");
    }
    Json fields = {{"target", target}};
    if (behaviour.tag == "gaze" && behaviour.Wanted(SyncPoint::kEnd)) {
      fields["length"] = LengthOf(behaviour);
    }
    if (behaviour.node.attribute("offsetAngle") || behaviour.node.attribute("influence")) {
      Warn(behaviour.node, "offsets and influences are left out: eyes, head and body share a look");
    }
    Add(behaviour, LaneKind::kGaze, std::move(fields));
  }

  void EmitGesture(const Behaviour& behaviour) {
    const std::string clip = ClipName(behaviour);
    if (ClipOf(behaviour) == nullptr) {
      return Warn(behaviour.node,
                  "'" + behaviour.actor + "' has no clip '" + clip + "'; add one to the figure");
    }
    const int repetitions = std::clamp(behaviour.node.attribute("repetition").as_int(1), 1, 100);
    Behaviour again = behaviour;
    for (int i = 0; i < repetitions; ++i) {
      Add(again, LaneKind::kGestures,
          {{"clip", clip}, {"part", behaviour.tag == "head" ? "head" : "upper"}});
      *again.start += behaviour.natural.back();
      again.id.clear();
    }
    const Json target = TargetOf(behaviour.node.attribute("target").as_string());
    if (behaviour.tag == "pointing" && !target.is_null()) {
      Add(again = behaviour, LaneKind::kGaze,
          {{"target", target}, {"length", LengthOf(behaviour)}});
    }
  }

  void EmitPosture(const Behaviour& behaviour) {
    const std::string type =
        LowerCase(Child(behaviour.node, "stance").attribute("type").as_string("none"));
    const std::string seat = behaviour.node.attribute("target").as_string();
    if (type == "standing") {
      Add(behaviour, LaneKind::kUses, {{"action", "stand"}});
    } else if (type == "sitting" && stage_.objects.contains(seat)) {
      Add(behaviour, LaneKind::kUses, {{"action", "sit"}, {"object", seat}});
    } else {
      Warn(behaviour.node, type == "sitting" ? "sitting needs a seat: an object as its target"
                                             : "the stance '" + type + "' is not supported");
    }
    if (Child(behaviour.node, "pose")) {
      Warn(behaviour.node, "poses of parts are not supported");
    }
  }

  void EmitLocomotion(const Behaviour& behaviour) {
    const std::string target = behaviour.node.attribute("target").as_string();
    Json to;
    double x = 0.0;
    double z = 0.0;
    if (const auto object = stage_.objects.find(target); object != stage_.objects.end()) {
      to = {{"x", object->second[0]}, {"z", object->second[1]}};
    } else if (ParsePoint(target, x, z)) {
      to = {{"x", x}, {"z", z}};
    } else {
      return Warn(behaviour.node,
                  "'" + target + "' is neither an object nor a position such as \"1.5 -2\" (x z)");
    }
    Json fields = {{"to", std::move(to)}};
    if (LowerCase(behaviour.node.attribute("manner").as_string()) == "run") {
      fields["speed"] = kRun;
    }
    Add(behaviour, LaneKind::kWalks, std::move(fields));
  }

  // Reads "x z", or "x y z" and ignores y; commas may separate the numbers.
  static bool ParsePoint(std::string text, double& x, double& z) {
    std::replace(text.begin(), text.end(), ',', ' ');
    std::vector<double> numbers;
    std::string_view rest = editor::TrimBlanks(text);
    while (!rest.empty() && numbers.size() < 4) {
      const size_t end = std::min(rest.find(' '), rest.size());
      const auto number = NumberOf(rest.substr(0, end));
      if (!number) {
        return false;
      }
      numbers.push_back(*number);
      rest = editor::TrimBlanks(rest.substr(end));
    }
    if (numbers.size() < 2 || numbers.size() > 3) {
      return false;
    }
    x = numbers.front();
    z = numbers.back();
    return true;
  }

  void EmitSpeech(const Behaviour& behaviour) {
    if (!behaviour.line.empty()) {
      Add(behaviour, LaneKind::kSpeech, {{"line", behaviour.line}});
    }
  }

  static std::string_view ExpressionOfLexeme(std::string_view lexeme) {
    constexpr std::pair<std::string_view, std::string_view> kLexemes[] = {
        {"smile", "joy"},           {"happy", "joy"},       {"joy", "joy"},
        {"sad", "sadness"},         {"ang", "anger"},       {"lower_brow", "anger"},
        {"fear", "fear"},           {"disgust", "disgust"}, {"surpris", "surprise"},
        {"raise_brow", "surprise"}, {"neutral", "neutral"}};
    for (const auto& [part, expression] : kLexemes) {
      if (lexeme.find(part) != std::string_view::npos) {
        return expression;
      }
    }
    return "";
  }

  // The expression that a single action unit (Ekman & Friesen, Facial Action Coding System,
  // 1978) is best known from.
  static std::string_view ExpressionOfUnit(int unit) {
    switch (unit) {
      case 6:
      case 12:
        return "joy";
      case 1:
      case 15:
      case 17:
        return "sadness";
      case 4:
      case 7:
      case 23:
      case 24:
        return "anger";
      case 20:
        return "fear";
      case 9:
      case 10:
        return "disgust";
      case 2:
      case 5:
      case 26:
      case 27:
        return "surprise";
      default:
        return "";
    }
  }

  void EmitFace(const Behaviour& behaviour) {
    if (behaviour.tag == "face" || behaviour.tag == "faceShift") {
      for (const pugi::xml_node& child : behaviour.node.children()) {
        Behaviour part = behaviour;
        part.node = child;
        part.tag = LocalName(child);
        if (part.tag == "lexeme" || part.tag == "faceLexeme") {
          EmitExpression(part, "lexeme");
        } else if (part.tag == "facs" || part.tag == "faceFacs") {
          EmitExpression(part, "au");
        } else if (child.type() == pugi::node_element) {
          Warn(child, "is not supported in a face");
        }
      }
      if (behaviour.node.attribute("lexeme")) {
        EmitExpression(behaviour, "lexeme");
      }
      return;
    }
    EmitExpression(behaviour, behaviour.tag == "faceFacs" ? "au" : "lexeme");
  }

  void EmitExpression(const Behaviour& behaviour, const char* attribute) {
    const std::string value = behaviour.node.attribute(attribute).as_string();
    const bool unit = std::string_view(attribute) == "au";
    const std::string_view expression =
        unit ? ExpressionOfUnit(behaviour.node.attribute("au").as_int())
             : ExpressionOfLexeme(LowerCase(value));
    if (expression.empty()) {
      return Warn(behaviour.node, "there is no expression for '" + value + "'");
    }
    if (unit) {
      Warn(behaviour.node,
           "action unit " + value + " is shown as '" + std::string(expression) + "'");
    }
    const double amount = NumberOf(behaviour.node.attribute("amount").as_string()).value_or(0.5);
    Json fields = {{"expression", expression}, {"intensity", std::clamp(amount, 0.0, 1.0)}};
    if (behaviour.tag != "faceShift") {
      fields["length"] = LengthOf(behaviour);
    }
    Add(behaviour, LaneKind::kExpressions, std::move(fields));
  }

  std::string_view text_;
  std::string place_;
  const BmlStage& stage_;
  std::vector<Behaviour> behaviours_;
  std::map<std::string, size_t, std::less<>> by_id_;
  double last_end_ = 0.0;
  BmlImport import_;
};

}  // namespace

Result<BmlImport> ImportBml(std::string_view text,
                            const std::string& where,
                            const BmlStage& stage,
                            double begin) {
  if (text.size() > kMaxBmlBytes) {
    return Status::Error(where, "is longer than 4 MiB", "split it");
  }
  LARARIUM_ASSIGN_OR_RETURN(const editor::ForeignText decoded,
                            editor::DecodeText(text, where, DeclaredEncoding(text)));
  LARARIUM_ASSIGN_OR_RETURN(BmlImport imported, BmlReader(decoded.text, where, stage).Read(begin));
  if (!decoded.note.empty()) {
    imported.warnings.insert(imported.warnings.begin(), where + ": " + decoded.note);
  }
  return imported;
}

}  // namespace lararium::import
