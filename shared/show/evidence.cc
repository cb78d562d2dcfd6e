#include "shared/show/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shared/core/srgb.h"

namespace lararium::show {
namespace {

using stage::Certainty;

// Blue, orange and reddish purple (Okabe & Ito, Color Universal Design, 2008), and grey.
struct Look {
  Certainty certainty;
  glm::vec3 colour;  // sRGB-encoded
  int stripes;
};
constexpr std::array<Look, stage::kCertaintyCount> kLooks = {{
    {Certainty::kAttested, {0.0f, 0.447f, 0.698f}, 0},
    {Certainty::kInferred, {0.902f, 0.624f, 0.0f}, 1},
    {Certainty::kImagined, {0.8f, 0.475f, 0.655f}, 2},
    {Certainty::kUnsaid, {0.6f, 0.6f, 0.6f}, 0},
}};
constexpr float kShare = 0.85f;
constexpr float kStripeShare = 1.0f / 40.0f;  // Stripe width as a share of the picture's height.

struct Words {
  std::string_view language;
  std::array<std::string_view, stage::kCertaintyCount> words;  // Indexed by Certainty.
};
constexpr std::array<Words, 6> kWords = {{
    {"en", {"not documented", "attested", "inferred", "imagined"}},
    {"it", {"non documentato", "attestato", "dedotto", "immaginato"}},
    {"la", {"non scriptum", "testatum", "coniectum", "fictum"}},
    {"de", {"nicht belegt", "bezeugt", "erschlossen", "erfunden"}},
    {"fr", {"non documenté", "attesté", "déduit", "imaginé"}},
    {"es", {"sin documentar", "atestiguado", "deducido", "imaginado"}},
}};

// A person or object is looked at if it is within kNearMiddle radians of the view's middle. Another
// one replaces it once it is nearer by kStays radians. To prefer what is in front, a metre of
// distance counts as kRadiansPerMetre.
constexpr double kNearMiddle = 0.2;
constexpr double kStays = 0.04;
constexpr double kRadiansPerMetre = 0.03;
// Heights of test points on a person, metres.
constexpr std::array<float, 4> kHeights = {0.4f, 0.8f, 1.2f, 1.6f};

const Look& LookOf(Certainty certainty) {
  return *std::find_if(kLooks.begin(), kLooks.end(),
                       [certainty](const Look& look) { return look.certainty == certainty; });
}

render::SceneMark MarkOf(Certainty certainty, int height) {
  const Look& look = LookOf(certainty);
  const glm::vec3& c = look.colour;
  return {{LinearFromSrgb(c.r), LinearFromSrgb(c.g), LinearFromSrgb(c.b)},
          kShare,
          look.stripes,
          kStripeShare * static_cast<float>(height)};
}

// Lighter than on stage, so that it is legible on the dark background.
glm::vec3 TitleColour(Certainty certainty) {
  return glm::vec3(0.45f) + 0.55f * LookOf(certainty).colour;
}

// Distance of a point from the view's middle, as a sortable value; nullopt: too far away.
std::optional<double> AwayFromLook(const geometry::Rigid3& camera_from_stage,
                                   const glm::vec3& point) {
  const Eigen::Vector3d at = camera_from_stage * Eigen::Vector3d(point.x, point.y, point.z);
  const double angle = std::atan2(std::hypot(at.x(), at.y()), at.z());
  return angle < kNearMiddle ? std::optional(angle + kRadiansPerMetre * at.norm()) : std::nullopt;
}

}  // namespace

std::string_view EvidenceWord(Certainty certainty, std::string_view language) {
  const std::string_view plain = language.substr(0, language.find('-'));
  const auto found = std::find_if(kWords.begin(), kWords.end(),
                                  [plain](const Words& words) { return words.language == plain; });
  return (found == kWords.end() ? kWords.front() : *found).words[static_cast<size_t>(certainty)];
}

Evidence::Evidence(const ShowContent& content) : cast_count_(content.cast.size()) {
  const auto add = [&](stage::Subject subject, const std::string& name, const std::string& title) {
    Known& known = known_.emplace_back();
    known.title = title;
    if (const stage::Claim* claim = content.paradata.Find(subject, name)) {
      known.certainty = claim->certainty;
      known.text = claim->Text(content.language);
    }
    known.title += (title.empty() ? "" : ": ");
    known.title += EvidenceWord(known.certainty, content.language);
  };
  for (const CastMember& member : content.cast) {
    add(stage::Subject::kPerson, member.name, member.title);
  }
  for (const StageObject& object : content.objects) {
    add(stage::Subject::kObject, object.name, "");
  }
  for (size_t i = 0; i < kLooks.size(); ++i) {
    entries_[i] = {kLooks[i].colour, kLooks[i].stripes,
                   EvidenceWord(kLooks[i].certainty, content.language)};
  }
}

render::SceneMark Evidence::MarkOfActor(uint32_t cast, int height) const {
  return MarkOf(known_[cast].certainty, height);
}

render::SceneMark Evidence::MarkOfObject(uint32_t object, int height) const {
  return MarkOf(known_[cast_count_ + object].certainty, height);
}

std::optional<size_t> Evidence::LookedAt(const StagedFrame& staged) const {
  std::optional<size_t> best;
  double least = std::numeric_limits<double>::max();
  const auto consider = [&](size_t index, const glm::vec3& point) {
    const std::optional<double> away = AwayFromLook(*staged.camera.camera_from_stage, point);
    const double stays = index == looked_at_ ? kStays : 0.0;
    if (away && *away - stays < least) {
      least = *away - stays;
      best = index;
    }
  };
  if (!staged.camera.camera_from_stage) {
    return best;
  }
  for (const StagedActor& actor : staged.people.actors) {
    for (const float height : kHeights) {
      const glm::vec4 point = actor.stage_from_actor * glm::vec4(0.0f, height, 0.0f, 1.0f);
      consider(actor.cast, glm::vec3(point));
    }
  }
  for (const StagedObject& object : staged.things.objects) {
    consider(cast_count_ + object.object,
             glm::vec3(staged.things.stage_from_part[object.part_begin][3]));
  }
  return best;
}

const render::Legend& Evidence::LegendOf(const StagedFrame& staged) {
  looked_at_ = LookedAt(staged);
  legend_ = {entries_, {}, glm::vec3(1.0f), {}};
  if (looked_at_) {
    const Known& known = known_[*looked_at_];
    legend_.title = known.title;
    legend_.title_colour = TitleColour(known.certainty);
    legend_.text = known.text;
  }
  return legend_;
}

}  // namespace lararium::show
