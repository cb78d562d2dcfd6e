#include "web/page/page_show.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "shared/core/check.h"
#include "shared/core/json.h"
#include "shared/geometry/glm_convert.h"
#include "shared/render/quality.h"
#include "shared/stage/place.h"
#include "shared/vision/foreground/foreground_mask.h"
#include "shared/vision/pose_smoother.h"

namespace lararium::web {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kWhere[] = "show";  // The folder of the show, in errors.
// The page asks the camera for this rate.
constexpr double kFramesPerSecond = 30.0;

template <typename Time>
int64_t MicrosecondsOf(Time time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
}

double SteadySeconds() { return 1e-6 * static_cast<double>(MicrosecondsOf(Clock::now())); }

size_t CoarsestLevel() { return render::QualityLadder().size() - 1; }

// numbers: see PageShow::kTrackedNumbers.
vision::TrackedFrame ParseTracked(std::span<const double> numbers) {
  vision::TrackedFrame tracked;
  tracked.state = static_cast<vision::TrackState>(numbers[0]);
  tracked.reason = static_cast<vision::TrackReason>(numbers[1]);
  tracked.followed = numbers[2] != 0.0;
  tracked.map = static_cast<uint32_t>(numbers[3]);
  if (tracked.state == vision::TrackState::kTracking) {
    tracked.camera_from_map = geometry::Rigid3{
        .rotation = Eigen::Quaterniond(numbers[7], numbers[4], numbers[5], numbers[6]),
        .translation = Eigen::Vector3d(numbers[8], numbers[9], numbers[10])};
  }
  geometry::CameraModel& c = tracked.camera;
  c.width = static_cast<int>(numbers[11]);
  c.height = static_cast<int>(numbers[12]);
  const double* number = &numbers[13];
  for (double* value : {&c.fx, &c.fy, &c.cx, &c.cy, &c.k1, &c.k2, &c.p1, &c.p2}) {
    *value = *number++;
  }
  return tracked;
}

}  // namespace

// Gives the smoother the poses that another worker has found, and the mask the points.
class GivenPoses final : public vision::PoseSource {
 public:
  vision::TrackedFrame Track(const geometry::Frame& frame) override {
    next.frame = frame;
    return std::move(next);
  }
  void Seen(std::vector<vision::SeenPoint>& seen) const override { seen = points; }

  vision::TrackedFrame next;
  std::vector<vision::SeenPoint> points;
};

PageShow::PageShow(bundle::Bundle bundle)
    : bundle_(std::move(bundle)),
      log_(MakeSilentLog()),
      quality_(show::QualityOptions::ForCamera(CoarsestLevel() + 1, kFramesPerSecond),
               CoarsestLevel()) {}

PageShow::~PageShow() = default;

Result<std::unique_ptr<PageShow>> PageShow::Open(std::string_view manifest,
                                                 std::span<const std::byte> signature,
                                                 std::string_view key) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::PublicKey trusted,
                            bundle::ParsePublicKey(key, "museum.pub"));
  LARARIUM_ASSIGN_OR_RETURN(bundle::Bundle bundle,
                            bundle::Bundle::FromManifest(manifest, signature, trusted, kWhere));
  return std::unique_ptr<PageShow>(new PageShow(std::move(bundle)));
}

Result<std::vector<std::string>> PageShow::FindMissing(
    Stage stage, const show::LanguageChoice& languages) const {
  LARARIUM_ASSIGN_OR_RETURN(
      const show::NeededMembers needed,
      show::FindNeededMembers(bundle_.manifest(), WithGroup(languages), kWhere));
  std::vector<std::string> missing;
  const auto add = [&](const std::vector<std::string>& members) {
    std::copy_if(members.begin(), members.end(), std::back_inserter(missing),
                 [this](const std::string& member) { return !bundle_.Has(member); });
  };
  switch (stage) {
    case Stage::kGuide:
      add(needed.guide);
      break;
    case Stage::kDrama:
      add(needed.guide);
      add(needed.rest);
      add(needed.language);
      break;
    case Stage::kPerson:
      if (const std::optional<size_t> next = NextPerson()) {
        add({bundle_.manifest().cast[*next].human});
      }
      break;
    case Stage::kThings:
      if (things_missing_) {
        add(needed.things);
      }
      break;
    case Stage::kVoices:
      add(needed.voices);
      break;
    case Stage::kShow:
      for (const std::vector<std::string>* members :
           {&needed.guide, &needed.rest, &needed.language, &needed.voices, &needed.people,
            &needed.things}) {
        add(*members);
      }
      break;
    case Stage::kLanguages:
      add(needed.language);
      add(needed.voices);
      break;
  }
  return missing;
}

std::optional<size_t> PageShow::NextPerson() const {
  const std::optional<geometry::Rigid3>& camera_from_stage = staged_.camera.camera_from_stage;
  const glm::vec3 camera =
      camera_from_stage ? geometry::ToGlm(camera_from_stage->Center()) : glm::vec3(0.0f);
  std::vector<float> distances(person_missing_.size(), std::numeric_limits<float>::max());
  for (const show::StagedActor& actor : staged_.people.actors) {
    distances[actor.cast] = glm::distance(glm::vec3(actor.stage_from_actor[3]), camera);
  }
  std::optional<size_t> next;
  for (size_t i = 0; i < person_missing_.size(); ++i) {
    if (person_missing_[i] && (!next || distances[i] < distances[*next])) {
      next = i;
    }
  }
  return next;
}

std::byte* PageShow::NewPiece(size_t size) { return piece_.emplace(size).bytes().data(); }

Status PageShow::AddPiece(std::string_view member) {
  CHECK(piece_);
  bundle::Piece piece = std::move(*piece_);
  piece_.reset();
  return bundle_.Add(member, std::move(piece));
}

Result<std::span<const std::byte>> PageShow::map(size_t index) const {
  return bundle_.member(bundle_.manifest().places[index].scene);
}

PageGroup* PageShow::JoinGroup(const std::string& name, uint64_t boot) {
  const std::optional<bundle::FleetEntry>& fleet = bundle_.manifest().fleet;
  if (!fleet || fleet->group.empty()) {
    return nullptr;
  }
  fleet_.group.reset();
  fleet_.feed.emplace(SteadySeconds);
  fleet_.group.emplace(
      group::GroupMemberOptions{
          .name = std::string(group::kPage) + name,
          .boot = boot,
          .wall = [] { return MicrosecondsOf(std::chrono::system_clock::now()); }},
      *fleet_.feed, [] { return MicrosecondsOf(Clock::now()); });
  return &*fleet_.group;
}

show::LanguageChoice PageShow::WithGroup(show::LanguageChoice languages) const {
  const std::optional<bundle::FleetEntry>& fleet = bundle_.manifest().fleet;
  languages.in_step = fleet && !fleet->group.empty();
  return languages;
}

Result<std::unique_ptr<show::Show>> PageShow::Make(show::ShowContent content, bool together) {
  drama::DramaOptions options;
  // Late news of a group change the past.
  options.past = together ? drama::Past::kKept : drama::Past::kForgotten;
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<show::Show> made,
                            show::Show::Create(std::move(content), options, *log_));
  if (together) {
    fleet_.feed->SetShow(bundle::DramaVersion(bundle_.manifest()) + " " + LARARIUM_VERSION + " " +
                             std::to_string(options.seed),
                         group::MarkersOf(made->content().drama));
    made->Join(fleet_.feed->group());
  }
  return made;
}

void PageShow::Begin(std::unique_ptr<show::Show> show) {
  sound_.reset();
  show_ = std::move(show);
  show_->SetTrackingLossFader({});
  show_->detail().SetQuality(render::QualityLadder()[quality_.level()]);
  if (target_) {
    show_->detail().SetPictureSize(target_->width(), target_->height());
  }
  texts_ = show::TextsOf(show_->content());
  told_texts_.clear();
  fleet_.markers = group::MarkersOf(show_->content().drama);
  show_->input().Hold(fleet_.holds);
}

Json PageShow::DescribeState() const {
  constexpr size_t kMostMarkers = 64;
  const std::optional<geometry::Rigid3>& camera = staged_.camera.camera_from_stage;
  // The state of a group has them.
  Json markers = Json::array();
  for (size_t i = 0; !fleet_.group && i < std::min(fleet_.markers.size(), kMostMarkers); ++i) {
    markers.push_back(fleet_.markers[i].name);
  }
  Json position;
  if (camera) {
    const Eigen::Vector3d centre = camera->Center();
    position = {centre.x(), centre.y(), centre.z()};
  }
  return {{"version", LARARIUM_VERSION},
          {"title", bundle_.manifest().title},
          {"show", bundle::ShowVersion(bundle_.manifest())},
          {"place", show_->content().places[staged_.camera.place].stage.name},
          {"position", position},
          {"seconds", time()},
          {"length", length() > 0.0 ? Json(length()) : Json()},
          {"picture", {{"quality", quality_.level()}}},
          {"held", fleet_.group ? Json() : Json(fleet_.holds)},
          {"markers", markers}};
}

void PageShow::Hold(bool holds) {
  fleet_.holds = holds;
  show_->input().Hold(holds);
}

void PageShow::GoTo(std::string_view marker) {
  const auto found = std::find_if(fleet_.markers.begin(), fleet_.markers.end(),
                                  [&](const auto& one) { return one.name == marker; });
  if (found != fleet_.markers.end()) {
    show_->input().RestartAt(static_cast<double>(found->tick) / drama::Drama::kTicksPerSecond);
  }
}

Status PageShow::LoadGuide(const show::LanguageChoice& languages) {
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, show::LoadGuideContent(bundle_, languages));
  return Start(std::move(content), false);
}

Status PageShow::Load(const show::LanguageChoice& languages) {
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content,
                            show::LoadShowContent(bundle_, {}, WithGroup(languages)));
  LARARIUM_ASSIGN_OR_RETURN(
      const show::NeededMembers needed,
      show::FindNeededMembers(bundle_.manifest(), WithGroup(languages), kWhere));
  std::set<std::string_view> kept(needed.language.begin(), needed.language.end());
  kept.insert(needed.voices.begin(), needed.voices.end());
  person_missing_.clear();
  for (const bundle::CastEntry& entry : bundle_.manifest().cast) {
    person_missing_.push_back(!bundle_.Has(entry.human));
    if (person_missing_.back()) {
      kept.insert(entry.motion);
    }
  }
  things_missing_ = std::any_of(needed.things.begin(), needed.things.end(),
                                [this](const auto& thing) { return !bundle_.Has(thing); });
  if (things_missing_) {
    for (const bundle::ObjectEntry& entry : bundle_.manifest().objects) {
      kept.insert(entry.prop);
    }
  }
  for (const bundle::Member& member : bundle_.manifest().members) {
    if (!kept.contains(member.name)) {
      bundle_.Remove(member.name);
    }
  }
  return Start(std::move(content), fleet_.group.has_value());
}

Status PageShow::LoadPeople() {
  const std::vector<bundle::CastEntry>& cast = bundle_.manifest().cast;
  for (size_t i = 0; i < person_missing_.size(); ++i) {
    if (person_missing_[i] && bundle_.Has(cast[i].human)) {
      LARARIUM_ASSIGN_OR_RETURN(show::CastMember member,
                                show::LoadCastMember(bundle_, cast[i], 0.0f, textures_));
      show_->SetPerson(i, std::move(member));
      person_missing_[i] = false;
      bundle_.Remove(cast[i].human);
      bundle_.Remove(cast[i].motion);
    }
  }
  return Status();
}

Status PageShow::LoadThings() {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<show::StageObject> objects,
                            show::LoadObjects(bundle_, textures_));
  for (const bundle::ObjectEntry& entry : bundle_.manifest().objects) {
    bundle_.Remove(entry.prop);
  }
  things_missing_ = false;
  show_->SetObjects(objects);
  return renderer_->SetObjects(show_->content());
}

Status PageShow::LoadVoices(const show::LanguageChoice& languages) {
  LARARIUM_ASSIGN_OR_RETURN(const show::ShowContent content,
                            show::LoadInLanguages(bundle_, WithGroup(languages), show_->content()));
  sound_.reset();
  return show_->SetSounds(content, *log_);
}

Status PageShow::Start(show::ShowContent content, bool together) {
  // The page writes the texts itself, so that they have the browser's letters, directions and
  // sizes.
  content.caption_font.reset();
  renderer_.reset();
  if (!context_) {
    LARARIUM_ASSIGN_OR_RETURN(context_,
                              render::CreateOffscreenContext(render::GraphicsApi::kOpenGlEs30));
  }
  auto given = std::make_unique<GivenPoses>();
  given_ = given.get();
  const auto maps = show::Maps(content.places);
  smoothed_ = vision::Smooth(vision::WithForeground(std::move(given), maps), maps,
                             vision::Smoothing::kSoft);
  LARARIUM_ASSIGN_OR_RETURN(
      renderer_, show::ShowRenderer::Create(content, render::QualityLadder()[quality_.level()]));
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<show::Show> show, Make(std::move(content), together));
  Begin(std::move(show));
  begun_.reset();
  FindViews();
  return Status();
}

Status PageShow::SetLanguages(const show::LanguageChoice& languages) {
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content,
                            show::LoadInLanguages(bundle_, WithGroup(languages), show_->content()));
  content.caption_font.reset();
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<show::Show> show,
                            Make(std::move(content), fleet_.group.has_value()));
  LARARIUM_RETURN_IF_ERROR(show->ResumeFrom(*show_));
  Begin(std::move(show));
  return Status();
}

Status PageShow::OpenSound() {
  sound_.reset();
  if (!show_->sounds()->clips().empty()) {
    LARARIUM_ASSIGN_OR_RETURN(sound_, PageSound::Create(show_->sounds()));
  }
  return Status();
}

uint8_t* PageShow::NewImage(PixelFormat format, int width, int height) {
  image_.format = format;
  if (format == PixelFormat::kRgba) {
    image_.pixels.create(height, width, CV_8UC4);
  } else {
    image_.pixels.create(height + height / 2, width, CV_8UC1);
  }
  return image_.pixels.data;
}

const cv::Mat& PageShow::ComputeLuminance() {
  if (image_.format == PixelFormat::kRgba) {
    cv::cvtColor(image_.pixels, image_.luminance, cv::COLOR_RGBA2GRAY);
  } else {
    image_.luminance = image_.pixels.rowRange(0, image_.pixels.rows * 2 / 3);
  }
  return image_.luminance;
}

double* PageShow::NewSeen(size_t count) {
  seen_numbers_.resize(3 * count);
  return seen_numbers_.data();
}

void PageShow::TakeTracked(std::span<const double> numbers) {
  vision::TrackedFrame& next = given_->next;
  next = ParseTracked(numbers);
  const vision::SceneDatabase& map = *show_->content().places[next.map].map;
  std::vector<vision::SeenPoint>& seen = given_->points;
  seen.clear();
  for (size_t i = 0; i + 2 < seen_numbers_.size(); i += 3) {
    const auto point = static_cast<uint32_t>(seen_numbers_[i]);
    CHECK(point < map.points.size());  // The tracker has the same maps.
    seen.push_back(
        {point, Eigen::Vector2d(seen_numbers_[i + 1], seen_numbers_[i + 2]).cast<float>()});
  }
  gain_ = gain_estimator_.Estimate(frame_.bgr, map, seen).value_or(gain_);
  next.gain = gain_;
}

Status PageShow::SetSize(int width, int height) {
  if (!target_ || target_->width() != width || target_->height() != height) {
    LARARIUM_ASSIGN_OR_RETURN(target_, render::RenderTarget::Create(width, height));
    show_->detail().SetPictureSize(width, height);
  }
  return Status();
}

void PageShow::ChooseQuality(Clock::time_point start, const Moment& moment) {
  const std::chrono::duration<double, std::milli> work = Clock::now() - start;
  if (staged_.camera.camera_from_stage &&
      quality_.AddFrame(moment.seconds, std::max(work.count(), moment.late_ms))) {
    const render::Quality& quality = render::QualityLadder()[quality_.level()];
    renderer_->SetQuality(quality);
    show_->detail().SetQuality(quality);
  }
}

double PageShow::SinceBegun(double seconds) {
  begun_ = begun_.value_or(seconds);
  return seconds - *begun_;
}

void PageShow::BeginFrame(const Moment& moment) {
  frame_ = {
      .index = frame_.index + 1, .capture_time = SinceBegun(moment.seconds), .bgr = {}, .grey = {}};
}

void PageShow::StageImage(vision::TrackedFrame tracked, const Moment& moment) {
  show_->input().SetHour(moment.hour);
  show_->StageFrame(std::move(tracked), frame_.capture_time, staged_);
  staged_.camera.opacity *= moment.shown;
  if (fleet_.feed) {
    fleet_.feed->SetVisited(staged_.camera.camera_from_stage.has_value());
  }
  if (sound_) {
    sound_->Show(staged_.sound);
  }
}

Status PageShow::Present(vision::TrackedFrame tracked,
                         const Moment& moment,
                         Clock::time_point start) {
  LARARIUM_RETURN_IF_ERROR(SetSize(frame_.bgr.cols, frame_.bgr.rows));
  StageImage(std::move(tracked), moment);
  LARARIUM_RETURN_IF_ERROR(renderer_->Draw(staged_, *target_));
  target_->Present(target_->width(), target_->height());
  ChooseQuality(start, moment);
  return Status();
}

Status PageShow::Draw(std::span<const double> tracked, const Moment& moment) {
  const Clock::time_point start = Clock::now();
  const int code = image_.format == PixelFormat::kI420   ? cv::COLOR_YUV2BGR_I420
                   : image_.format == PixelFormat::kNv12 ? cv::COLOR_YUV2BGR_NV12
                                                         : cv::COLOR_RGBA2BGR;
  BeginFrame(moment);
  cv::cvtColor(image_.pixels, frame_.bgr, code);
  cv::cvtColor(frame_.bgr, frame_.grey, cv::COLOR_BGR2GRAY);
  TakeTracked(tracked);
  if (std::exchange(view_, std::nullopt)) {
    show_->input().ForgetPose();
  }
  return Present(smoothed_->Track(frame_), moment, start);
}

void PageShow::FindViews() {
  views_.clear();
  const std::vector<show::ShowPlace>& places = show_->content().places;
  for (uint32_t place = 0; place < places.size(); ++place) {
    const std::vector<vision::Keyframe>& keyframes = places[place].map->keyframes;
    for (size_t i = 0; i < keyframes.size(); ++i) {
      if (!keyframes[i].grey.empty()) {
        views_.push_back({place, i});
      }
    }
  }
  std::stable_sort(views_.begin(), views_.end(), [this](const View& a, const View& b) {
    const auto order = [this](const View& view) {
      const vision::Keyframe& keyframe = KeyframeOf(view);
      return std::tuple(view.place, keyframe.session, keyframe.frame_index);
    };
    return order(a) < order(b);
  });
}

Status PageShow::DrawView(size_t index, const Moment& moment) {
  const Clock::time_point start = Clock::now();
  const vision::Keyframe& keyframe = KeyframeOf(views_[index]);
  BeginFrame(moment);
  cv::cvtColor(keyframe.grey, frame_.bgr, cv::COLOR_GRAY2BGR);
  vision::TrackedFrame tracked;
  tracked.frame = frame_;
  tracked.state = vision::TrackState::kTracking;
  tracked.followed = true;
  tracked.map = views_[index].place;
  tracked.camera = show_->content().places[tracked.map].map->camera;
  tracked.camera_from_map = keyframe.camera_from_map;
  tracked.gain = keyframe.gain;
  if (std::exchange(view_, index) != index) {
    show_->input().ForgetPose();
  }
  return Present(std::move(tracked), moment, start);
}

void PageShow::EnterRoom(bool sees) {
  anchor_ = sees ? show::StageAnchor() : show::StageAnchor(show::StageAnchor::kForever);
  show_->input().ForgetPose();
}

void PageShow::FindStage(std::span<const double> tracked,
                         const geometry::Rigid3& room_from_viewer,
                         double seconds) {
  const vision::TrackedFrame seen = ParseTracked(tracked);
  if (seen.camera_from_map) {
    anchored_ = seen.map;
    const stage::Place& place = show_->content().places[anchored_].stage;
    anchor_.Observe(room_from_viewer * stage::CameraFromStage(place, *seen.camera_from_map),
                    seconds);
  }
}

Status PageShow::DrawInRoom(std::span<const RoomView> views,
                            uint32_t framebuffer,
                            const Moment& moment) {
  if (!anchor_.room_from_stage() || views.empty()) {
    return Status();
  }
  const Clock::time_point start = Clock::now();
  BeginFrame(moment);
  const auto eye_from_stage = [this](const RoomView& view) {
    return view.room_from_eye.Inverse() * *anchor_.room_from_stage();
  };
  vision::TrackedFrame tracked;
  tracked.frame = frame_;
  tracked.state = vision::TrackState::kTracking;
  tracked.followed = true;
  tracked.map = anchored_;
  tracked.camera = views.front().camera;
  tracked.camera_from_map =
      stage::CameraFromMap(show_->content().places[anchored_].stage, eye_from_stage(views.front()));
  tracked.gain = gain_;
  StageImage(std::move(tracked), moment);
  const float opacity = anchor_.Opacity(moment.seconds) * staged_.camera.opacity;
  for (const RoomView& view : views) {
    LARARIUM_RETURN_IF_ERROR(SetSize(view.camera.width, view.camera.height));
    LARARIUM_RETURN_IF_ERROR(
        renderer_->DrawSeeThrough(staged_, {view.camera, eye_from_stage(view), opacity}, *target_));
    target_->CopyTo(framebuffer, view.corner[0], view.corner[1]);
  }
  ChooseQuality(start, moment);
  return Status();
}

Json PageShow::DescribeTexts() {
  show::CollectCaptions(texts_, staged_, captions_);
  Json captions = Json::array();
  for (const render::Caption& caption : captions_) {
    captions.push_back({{"speaker", caption.speaker},
                        {"colour", {caption.colour.r, caption.colour.g, caption.colour.b}},
                        {"side", caption.side},
                        {"text", caption.text}});
  }
  const show::StagedGuide& guide = staged_.camera.guide;
  Json described = {{"captions", std::move(captions)}, {"guide", ""}, {"hint", ""}};
  if (guide.opacity > 0.0f) {
    const bool dark = guide.says == show::StagedGuide::Says::kDark;
    described["guide"] = dark ? "dark" : "look";
    described["hint"] =
        dark ? show_->content().dark_guide : show_->content().places[staged_.camera.place].guide;
  }
  return described;
}

const std::string* PageShow::TakeTexts() {
  std::string texts = DescribeTexts().dump();
  if (texts == told_texts_) {
    return nullptr;
  }
  told_texts_ = std::move(texts);
  return &told_texts_;
}

}  // namespace lararium::web
