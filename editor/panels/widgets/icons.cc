#include "editor/panels/widgets/icons.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <initializer_list>
#include <limits>
#include <utility>

namespace lararium::panels {

namespace {

using glm::vec2;
using Points = std::initializer_list<vec2>;

constexpr float kGrid = 16.0f;
constexpr float kHalfStroke = 0.75f;

float DistanceToSegment(const vec2& at, const vec2& a, const vec2& b) {
  const vec2 along = b - a;
  const float length = glm::dot(along, along);
  const float t = length > 0.0f ? std::clamp(glm::dot(at - a, along) / length, 0.0f, 1.0f) : 0.0f;
  return glm::distance(at, a + t * along);
}

// Measures the signed distance from a point of the grid to everything that is drawn; below 0:
// inside. X points to the right, Y down; angles are degrees, clockwise from the right.
class Pen {
 public:
  explicit Pen(const vec2& at) : at_(at) {}

  void Line(Points points) {
    for (const vec2* b = points.begin() + 1; b != points.end(); ++b) {
      Stroke(DistanceToSegment(at_, b[-1], *b));
    }
  }
  void Loop(Points points) {
    Line(points);
    Stroke(DistanceToSegment(at_, points.begin()[points.size() - 1], *points.begin()));
  }
  // A convex polygon, clockwise.
  void Fill(Points points) {
    float outside = std::numeric_limits<float>::lowest();
    const vec2* a = points.begin() + points.size() - 1;
    for (const vec2* b = points.begin(); b != points.end(); a = b++) {
      const vec2 along = glm::normalize(*b - *a);
      outside = std::max(outside, glm::dot(at_ - *a, vec2(along.y, -along.x)));
    }
    distance_ = std::min(distance_, outside);
  }
  void Circle(const vec2& centre, float radius) {
    Stroke(std::abs(glm::distance(at_, centre) - radius));
  }
  void Disc(const vec2& centre, float radius) {
    distance_ = std::min(distance_, glm::distance(at_, centre) - radius);
  }
  void Arc(const vec2& centre, float radius, float from, float to) {
    const auto end = [&](float degrees) {
      const float angle = glm::radians(degrees);
      return centre + radius * vec2(std::cos(angle), std::sin(angle));
    };
    const vec2 arm = at_ - centre;
    float angle = glm::degrees(std::atan2(arm.y, arm.x));
    while (angle < from) {
      angle += 360.0f;
    }
    Stroke(angle <= to ? std::abs(glm::length(arm) - radius)
                       : std::min(glm::distance(at_, end(from)), glm::distance(at_, end(to))));
  }
  void Dot(const vec2& centre) { Disc(centre, 1.0f); }
  // count rays at equal angles from one circle to the other.
  void Rays(const vec2& centre, float inner, float outer, int count) {
    for (int i = 0; i < count; ++i) {
      const float angle = glm::radians(360.0f * static_cast<float>(i) / static_cast<float>(count));
      const vec2 along(std::cos(angle), std::sin(angle));
      Line({centre + inner * along, centre + outer * along});
    }
  }

  float distance() const { return distance_; }

 private:
  void Stroke(float from_middle) { distance_ = std::min(distance_, from_middle - kHalfStroke); }

  vec2 at_;
  float distance_ = std::numeric_limits<float>::max();
};

void DrawAction(Icon icon, Pen& pen) {
  switch (icon) {
    case Icon::kTrain:  // A film camera.
      pen.Loop({{1.5f, 4.5f}, {10.5f, 4.5f}, {10.5f, 11.5f}, {1.5f, 11.5f}});
      pen.Line({{10.5f, 9.0f}, {14.5f, 11.5f}, {14.5f, 4.5f}, {10.5f, 7.0f}});
      break;
    case Icon::kAddSession:  // A film camera with other light.
      pen.Circle({6.0f, 6.0f}, 2.25f);
      pen.Rays({6.0f, 6.0f}, 4.0f, 5.0f, 8);
      pen.Line({{12.0f, 9.5f}, {12.0f, 14.5f}});
      pen.Line({{9.5f, 12.0f}, {14.5f, 12.0f}});
      break;
    case Icon::kBake:  // A flame.
      pen.Loop({{8.5f, 1.5f},
                {11.5f, 5.5f},
                {12.5f, 9.5f},
                {11.0f, 13.0f},
                {8.0f, 14.5f},
                {5.0f, 13.0f},
                {3.5f, 9.5f},
                {5.0f, 6.5f},
                {6.5f, 8.0f}});
      break;
    case Icon::kExport:  // An arrow out of a box.
      pen.Line({{3.0f, 8.0f}, {3.0f, 14.0f}, {13.0f, 14.0f}, {13.0f, 8.0f}});
      pen.Line({{8.0f, 10.5f}, {8.0f, 2.0f}});
      pen.Line({{5.0f, 5.0f}, {8.0f, 2.0f}, {11.0f, 5.0f}});
      break;
    case Icon::kMove:
      pen.Line({{8.0f, 1.5f}, {8.0f, 14.5f}});
      pen.Line({{1.5f, 8.0f}, {14.5f, 8.0f}});
      pen.Line({{6.0f, 3.5f}, {8.0f, 1.5f}, {10.0f, 3.5f}});
      pen.Line({{6.0f, 12.5f}, {8.0f, 14.5f}, {10.0f, 12.5f}});
      pen.Line({{3.5f, 6.0f}, {1.5f, 8.0f}, {3.5f, 10.0f}});
      pen.Line({{12.5f, 6.0f}, {14.5f, 8.0f}, {12.5f, 10.0f}});
      break;
    case Icon::kTurn:
      pen.Arc({8.0f, 8.5f}, 5.5f, -30.0f, 240.0f);
      pen.Line({{9.0f, 1.5f}, {5.3f, 3.7f}, {8.0f, 7.0f}});
      break;
    case Icon::kScale:
      pen.Loop({{1.5f, 9.0f}, {7.0f, 9.0f}, {7.0f, 14.5f}, {1.5f, 14.5f}});
      pen.Line({{8.5f, 7.5f}, {14.0f, 2.0f}});
      pen.Line({{9.5f, 2.0f}, {14.0f, 2.0f}, {14.0f, 6.5f}});
      break;
    case Icon::kUndo:
      pen.Line({{5.5f, 2.0f}, {2.0f, 5.5f}, {5.5f, 9.0f}});
      pen.Line({{2.0f, 5.5f}, {9.5f, 5.5f}});
      pen.Arc({9.5f, 9.5f}, 4.0f, -90.0f, 90.0f);
      pen.Line({{9.5f, 13.5f}, {5.5f, 13.5f}});
      break;
    case Icon::kRedo:
      pen.Line({{10.5f, 2.0f}, {14.0f, 5.5f}, {10.5f, 9.0f}});
      pen.Line({{14.0f, 5.5f}, {6.5f, 5.5f}});
      pen.Arc({6.5f, 9.5f}, 4.0f, 90.0f, 270.0f);
      pen.Line({{6.5f, 13.5f}, {10.5f, 13.5f}});
      break;
    case Icon::kPlay:
      pen.Fill({{4.0f, 2.0f}, {13.5f, 8.0f}, {4.0f, 14.0f}});
      break;
    case Icon::kPause:
      pen.Fill({{3.5f, 2.5f}, {6.5f, 2.5f}, {6.5f, 13.5f}, {3.5f, 13.5f}});
      pen.Fill({{9.5f, 2.5f}, {12.5f, 2.5f}, {12.5f, 13.5f}, {9.5f, 13.5f}});
      break;
    case Icon::kAdd:
      pen.Line({{8.0f, 2.5f}, {8.0f, 13.5f}});
      pen.Line({{2.5f, 8.0f}, {13.5f, 8.0f}});
      break;
    case Icon::kSnap:  // A magnet.
      pen.Line({{3.0f, 2.0f}, {3.0f, 8.5f}});
      pen.Arc({8.0f, 8.5f}, 5.0f, 0.0f, 180.0f);
      pen.Line({{13.0f, 8.5f}, {13.0f, 2.0f}});
      pen.Line({{1.5f, 5.0f}, {4.5f, 5.0f}});
      pen.Line({{11.5f, 5.0f}, {14.5f, 5.0f}});
      break;
    case Icon::kRipple:  // Items that follow each other.
      pen.Line({{2.5f, 3.0f}, {7.5f, 8.0f}, {2.5f, 13.0f}});
      pen.Line({{8.5f, 3.0f}, {13.5f, 8.0f}, {8.5f, 13.0f}});
      break;
    case Icon::kFit:
      pen.Line({{1.5f, 3.0f}, {1.5f, 13.0f}});
      pen.Line({{14.5f, 3.0f}, {14.5f, 13.0f}});
      pen.Line({{4.0f, 8.0f}, {12.0f, 8.0f}});
      pen.Line({{6.0f, 6.0f}, {4.0f, 8.0f}, {6.0f, 10.0f}});
      pen.Line({{10.0f, 6.0f}, {12.0f, 8.0f}, {10.0f, 10.0f}});
      break;
    default:
      break;
  }
}

void DrawThing(Icon icon, Pen& pen) {
  switch (icon) {
    case Icon::kCameraView:
      pen.Loop({{1.5f, 4.5f},
                {5.0f, 4.5f},
                {6.0f, 2.5f},
                {10.0f, 2.5f},
                {11.0f, 4.5f},
                {14.5f, 4.5f},
                {14.5f, 13.0f},
                {1.5f, 13.0f}});
      pen.Circle({8.0f, 8.5f}, 2.5f);
      break;
    case Icon::kAroundView:  // An orbit around an object.
      pen.Dot({8.0f, 8.0f});
      pen.Arc({8.0f, 8.0f}, 6.0f, -60.0f, 60.0f);
      pen.Arc({8.0f, 8.0f}, 6.0f, 120.0f, 240.0f);
      pen.Line({{11.0f, 11.0f}, {11.0f, 13.5f}, {13.7f, 14.0f}});
      pen.Line({{5.0f, 5.0f}, {5.0f, 2.5f}, {2.3f, 2.0f}});
      break;
    case Icon::kPicks:  // Cross hairs.
      pen.Circle({8.0f, 8.0f}, 4.0f);
      pen.Rays({8.0f, 8.0f}, 2.5f, 6.5f, 4);
      break;
    case Icon::kProject:  // A folder.
      pen.Loop(
          {{1.5f, 3.5f}, {6.0f, 3.5f}, {7.5f, 5.5f}, {14.5f, 5.5f}, {14.5f, 13.0f}, {1.5f, 13.0f}});
      break;
    case Icon::kPlace:  // A pin.
      pen.Arc({8.0f, 6.25f}, 4.75f, 150.0f, 390.0f);
      pen.Line({{3.9f, 8.6f}, {8.0f, 14.5f}, {12.1f, 8.6f}});
      pen.Dot({8.0f, 6.25f});
      break;
    case Icon::kStage:  // The floor and the up axis.
      pen.Loop({{5.0f, 8.5f}, {14.5f, 8.5f}, {11.0f, 13.5f}, {1.5f, 13.5f}});
      pen.Line({{8.0f, 11.0f}, {8.0f, 2.0f}});
      pen.Line({{5.5f, 4.5f}, {8.0f, 2.0f}, {10.5f, 4.5f}});
      break;
    case Icon::kNudge:
      pen.Loop({{6.0f, 6.0f}, {10.0f, 6.0f}, {10.0f, 10.0f}, {6.0f, 10.0f}});
      pen.Line({{4.0f, 4.0f}, {1.5f, 8.0f}, {4.0f, 12.0f}});
      pen.Line({{12.0f, 4.0f}, {14.5f, 8.0f}, {12.0f, 12.0f}});
      break;
    case Icon::kProbe:  // A sun.
      pen.Circle({8.0f, 8.0f}, 2.75f);
      pen.Rays({8.0f, 8.0f}, 5.25f, 6.75f, 8);
      break;
    case Icon::kOccluder:  // A front that hides the object behind it.
      pen.Fill({{1.5f, 6.5f}, {9.0f, 6.5f}, {9.0f, 14.0f}, {1.5f, 14.0f}});
      pen.Arc({9.75f, 6.25f}, 4.5f, 180.0f, 450.0f);
      break;
    case Icon::kPerson:
      pen.Circle({8.0f, 4.5f}, 2.75f);
      pen.Arc({8.0f, 14.0f}, 5.5f, 180.0f, 360.0f);
      pen.Line({{2.5f, 14.0f}, {13.5f, 14.0f}});
      break;
    case Icon::kObject:  // An amphora.
      pen.Line({{5.5f, 1.5f}, {10.5f, 1.5f}});
      pen.Line({{6.5f, 1.5f},
                {6.5f, 4.5f},
                {4.0f, 7.5f},
                {7.0f, 14.5f},
                {9.0f, 14.5f},
                {12.0f, 7.5f},
                {9.5f, 4.5f},
                {9.5f, 1.5f}});
      pen.Line({{6.5f, 3.0f}, {2.5f, 4.5f}, {4.0f, 7.5f}});
      pen.Line({{9.5f, 3.0f}, {13.5f, 4.5f}, {12.0f, 7.5f}});
      break;
    case Icon::kCheckPoint:
      pen.Loop({{8.0f, 1.5f}, {14.5f, 8.0f}, {8.0f, 14.5f}, {1.5f, 8.0f}});
      pen.Line({{5.0f, 8.0f}, {7.25f, 10.25f}, {11.0f, 6.0f}});
      break;
    default:
      break;
  }
}

void DrawLane(Icon icon, Pen& pen) {
  switch (icon) {
    case Icon::kSpeech:
      pen.Loop({{1.5f, 2.5f},
                {14.5f, 2.5f},
                {14.5f, 10.5f},
                {7.5f, 10.5f},
                {4.0f, 14.0f},
                {4.0f, 10.5f},
                {1.5f, 10.5f}});
      break;
    case Icon::kWalk:  // A path.
      pen.Disc({3.0f, 13.0f}, 1.75f);
      pen.Line({{3.0f, 13.0f}, {8.0f, 13.0f}, {8.0f, 5.0f}, {14.0f, 5.0f}});
      pen.Line({{11.0f, 2.0f}, {14.0f, 5.0f}, {11.0f, 8.0f}});
      break;
    case Icon::kUse:  // A hand.
      pen.Line({{4.5f, 9.0f}, {4.5f, 4.0f}});
      pen.Line({{7.0f, 7.5f}, {7.0f, 2.0f}});
      pen.Line({{9.5f, 7.5f}, {9.5f, 2.0f}});
      pen.Line({{12.0f, 8.5f}, {12.0f, 4.0f}});
      pen.Line({{4.5f, 9.0f},
                {2.0f, 8.0f},
                {4.0f, 12.0f},
                {6.0f, 14.5f},
                {10.5f, 14.5f},
                {12.0f, 12.0f},
                {12.0f, 8.5f}});
      break;
    case Icon::kGesture:  // Raised arms.
      pen.Circle({8.0f, 3.25f}, 1.75f);
      pen.Line({{2.5f, 3.5f}, {8.0f, 7.5f}, {13.5f, 3.5f}});
      pen.Line({{8.0f, 7.5f}, {8.0f, 10.5f}});
      pen.Line({{4.5f, 14.5f}, {8.0f, 10.5f}, {11.5f, 14.5f}});
      break;
    case Icon::kGaze:  // An eye.
      pen.Arc({8.0f, 12.0f}, 7.5f, 213.0f, 327.0f);
      pen.Arc({8.0f, 4.0f}, 7.5f, 33.0f, 147.0f);
      pen.Disc({8.0f, 8.0f}, 2.0f);
      break;
    case Icon::kExpression:  // A face.
      pen.Circle({8.0f, 8.0f}, 6.5f);
      pen.Dot({5.75f, 6.25f});
      pen.Dot({10.25f, 6.25f});
      pen.Arc({8.0f, 8.0f}, 3.5f, 25.0f, 155.0f);
      break;
    case Icon::kClip:  // A film.
      pen.Loop({{1.5f, 3.5f}, {14.5f, 3.5f}, {14.5f, 12.5f}, {1.5f, 12.5f}});
      pen.Line({{5.0f, 3.5f}, {5.0f, 12.5f}});
      pen.Line({{11.0f, 3.5f}, {11.0f, 12.5f}});
      pen.Line({{1.5f, 8.0f}, {5.0f, 8.0f}});
      pen.Line({{11.0f, 8.0f}, {14.5f, 8.0f}});
      break;
    case Icon::kLight:  // An oil lamp.
      pen.Line({{1.5f, 8.5f}, {14.0f, 8.5f}, {10.5f, 11.5f}});
      pen.Arc({6.5f, 8.5f}, 5.0f, 30.0f, 180.0f);
      pen.Line({{4.0f, 14.25f}, {9.0f, 14.25f}});
      pen.Loop({{12.5f, 6.0f}, {11.25f, 4.5f}, {12.5f, 1.75f}, {13.75f, 4.5f}});
      break;
    case Icon::kSound:  // A note.
      pen.Disc({4.75f, 12.0f}, 2.5f);
      pen.Line({{6.5f, 12.0f}, {6.5f, 3.0f}, {13.0f, 2.0f}, {13.0f, 6.0f}});
      break;
    case Icon::kCaption:  // Text below a picture.
      pen.Loop({{1.5f, 2.5f}, {14.5f, 2.5f}, {14.5f, 13.5f}, {1.5f, 13.5f}});
      pen.Line({{4.5f, 10.5f}, {11.5f, 10.5f}});
      break;
    case Icon::kDescription:  // A page.
      pen.Loop({{3.0f, 1.5f}, {13.0f, 1.5f}, {13.0f, 14.5f}, {3.0f, 14.5f}});
      pen.Line({{5.5f, 5.0f}, {10.5f, 5.0f}});
      pen.Line({{5.5f, 8.0f}, {10.5f, 8.0f}});
      pen.Line({{5.5f, 11.0f}, {8.5f, 11.0f}});
      break;
    case Icon::kMarker:  // A flag.
      pen.Line({{4.0f, 14.5f}, {4.0f, 1.5f}, {13.0f, 4.75f}, {4.0f, 8.0f}});
      break;
    default:
      break;
  }
}

void DrawState(Icon icon, Pen& pen) {
  switch (icon) {
    case Icon::kInfo:
      pen.Circle({8.0f, 8.0f}, 6.5f);
      pen.Dot({8.0f, 4.75f});
      pen.Line({{8.0f, 7.5f}, {8.0f, 11.5f}});
      break;
    case Icon::kWarning:
      pen.Loop({{8.0f, 2.0f}, {14.5f, 13.5f}, {1.5f, 13.5f}});
      pen.Line({{8.0f, 6.5f}, {8.0f, 9.0f}});
      pen.Dot({8.0f, 11.5f});
      break;
    case Icon::kError:
      pen.Loop({{5.25f, 1.5f},
                {10.75f, 1.5f},
                {14.5f, 5.25f},
                {14.5f, 10.75f},
                {10.75f, 14.5f},
                {5.25f, 14.5f},
                {1.5f, 10.75f},
                {1.5f, 5.25f}});
      pen.Line({{5.5f, 5.5f}, {10.5f, 10.5f}});
      pen.Line({{10.5f, 5.5f}, {5.5f, 10.5f}});
      break;
    case Icon::kGood:
      pen.Circle({8.0f, 8.0f}, 6.5f);
      pen.Line({{4.75f, 8.25f}, {7.0f, 10.5f}, {11.25f, 5.75f}});
      break;
    case Icon::kNothingYet:
      pen.Circle({8.0f, 8.0f}, 4.5f);
      break;
    case Icon::kUnclear:  // A question mark.
      pen.Arc({8.0f, 5.25f}, 3.25f, 180.0f, 405.0f);
      pen.Line({{10.3f, 7.55f}, {8.0f, 9.5f}, {8.0f, 10.5f}});
      pen.Dot({8.0f, 13.5f});
      break;
    case Icon::kFound:
      pen.Circle({8.0f, 8.0f}, 6.5f);
      pen.Disc({8.0f, 8.0f}, 3.0f);
      break;
    case Icon::kLost:
      pen.Circle({8.0f, 8.0f}, 6.5f);
      pen.Line({{3.5f, 12.5f}, {12.5f, 3.5f}});
      break;
    case Icon::kSearching:  // A magnifier.
      pen.Circle({6.5f, 6.5f}, 4.75f);
      pen.Line({{10.0f, 10.0f}, {14.25f, 14.25f}});
      break;
    default:
      break;
  }
}

}  // namespace

std::vector<uint8_t> DrawIcon(Icon icon, int side) {
  std::vector<uint8_t> pixels;
  pixels.reserve(static_cast<size_t>(side * side));
  const float scale = static_cast<float>(side) / kGrid;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      Pen pen(vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) / scale);
      for (const auto draw : {DrawAction, DrawThing, DrawLane, DrawState}) {
        draw(icon, pen);
      }
      // An edge through the middle of a pixel covers half of it.
      const float covered = std::clamp(0.5f - scale * pen.distance(), 0.0f, 1.0f);
      pixels.push_back(static_cast<uint8_t>(std::lround(255.0f * covered)));
    }
  }
  return pixels;
}

std::string IconText(Icon icon) {
  const char32_t letter = LetterOf(icon);
  return {static_cast<char>(0xe0 | letter >> 12), static_cast<char>(0x80 | (letter >> 6 & 0x3f)),
          static_cast<char>(0x80 | (letter & 0x3f))};
}

std::string WithIcon(Icon icon, std::string_view text) {
  return IconText(icon) + "  " + std::string(text);
}

Icon IconOf(drama::LaneKind kind) {
  constexpr std::pair<std::string_view, Icon> kNamed[] = {
      {"speech", Icon::kSpeech},   {"walk", Icon::kWalk},     {"use", Icon::kUse},
      {"gesture", Icon::kGesture}, {"gaze", Icon::kGaze},     {"expression", Icon::kExpression},
      {"clip", Icon::kClip},       {"light", Icon::kLight},   {"sound", Icon::kSound},
      {"caption", Icon::kCaption}, {"marker", Icon::kMarker}, {"description", Icon::kDescription}};
  for (const auto& [name, icon] : kNamed) {
    if (name == drama::SpecOf(kind).icon) {
      return icon;
    }
  }
  return Icon::kStage;
}

}  // namespace lararium::panels
