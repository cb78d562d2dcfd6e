#pragma once

// A show as a page plays it: takes images of the camera with their poses, and draws pictures into
// the page's canvas.

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/bundle/bundle.h"
#include "shared/core/json_fwd.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/human/texture_pool.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/text/captions.h"
#include "shared/show/caption_texts.h"
#include "shared/show/quality_controller.h"
#include "shared/show/show.h"
#include "shared/show/show_renderer.h"
#include "shared/show/stage_anchor.h"
#include "shared/vision/gain_estimator.h"
#include "shared/vision/tracked_frame.h"
#include "web/page/page_group.h"
#include "web/page/page_sound.h"
#include "web/page/room_view.h"

namespace lararium::web {

// How a browser stores the pixels of an image. Rows have no gaps, and width and height of kI420 and
// kNv12 are even.
enum class PixelFormat { kI420, kNv12, kRgba };

class GivenPoses;

class PageShow {
 public:
  // Verifies the manifest of a folder. key: text of the public key.
  static Result<std::unique_ptr<PageShow>> Open(std::string_view manifest,
                                                std::span<const std::byte> signature,
                                                std::string_view key);
  ~PageShow();

  // A show arrives in stages: the guide to the places; the drama, in which people and things are
  // invisible and lines are silent; then one person at a time, all things, and all voices. kShow is
  // all of them at once, and kLanguages what a playing show needs for other languages.
  enum class Stage { kGuide, kDrama, kPerson, kThings, kVoices, kShow, kLanguages };
  // The members that a stage needs and that have not arrived, the most important first. The person
  // of kPerson is, of those who are missing, the one nearest to the camera in the last picture, or
  // to the stage's origin if that picture has no pose; people who are not on stage come last.
  Result<std::vector<std::string>> FindMissing(Stage stage,
                                               const show::LanguageChoice& languages) const;
  // Memory to be filled in for the next AddPiece(), which verifies the member and keeps it.
  std::byte* NewPiece(size_t size);
  Status AddPiece(std::string_view member);

  // The maps for the tracker, .larscene files, before Load().
  size_t map_count() const { return bundle_.manifest().places.size(); }
  Result<std::span<const std::byte>> map(size_t index) const;

  // Lets the drama be that of a group, if the manifest names one, which is then returned. boot: a
  // random number. Call it before Load().
  PageGroup* JoinGroup(const std::string& name, uint64_t boot);

  // The occluders of a place in its map's frame, for the tracker; empty before Load().
  std::vector<vision::OccluderMesh> occluders(size_t place) const {
    return show::OccludersInMap(show_->content().places[place].stage);
  }

  // Prepares drawing of the guide to the places. Call the functions below only after it.
  Status LoadGuide(const show::LanguageChoice& languages);
  // Begins the show with what has arrived, and releases members that are no longer needed.
  Status Load(const show::LanguageChoice& languages);
  // LoadPeople(), LoadThings() and LoadVoices() add what has arrived since Load(). Sound must be
  // opened again after LoadVoices().
  Status LoadPeople();
  Status LoadThings();
  Status LoadVoices(const show::LanguageChoice& languages);
  // Continues the show at the same moment in other languages. Sound must be opened again.
  Status SetLanguages(const show::LanguageChoice& languages);
  // Plays the show's sound from now on, in the page's output for sound (SoundGraph). Without such
  // an output the show is silent.
  Status OpenSound();

  // What the show is, for the page: its length in seconds (0: not known) and the language of its
  // texts.
  double length() const { return show_->drama().settings().length; }
  const std::string& language() const { return show_->content().language; }
  show::VisitorInput& input() { return show_->input(); }

  // Describes the show to a fleet, by some of the fields of a player's state
  // (docs/file-formats.md).
  Json DescribeState() const;
  // The staff holds the drama or lets it go on, or goes to one of its moments. An unknown marker is
  // ignored.
  void Hold(bool holds);
  void GoTo(std::string_view marker);

  // The pixels to be filled in for the next luminance() and Draw().
  uint8_t* NewImage(PixelFormat format, int width, int height);
  const cv::Mat& ComputeLuminance();

  // The numbers of seen points to be filled in for the next Draw(): see TrackerSession::seen().
  double* NewSeen(size_t count);

  // What is not in the image.
  struct Moment {
    double seconds = 0.0;  // Time of the frame. Time never steps back.
    float hour = 0.0f;     // Local hour of the day.
    // Milliseconds since the last frame that was drawn, if the page missed frames of the camera
    // since then; otherwise 0.
    double late_ms = 0.0;
    float shown = 1.0f;  // Factor on the visibility of people, 0 to 1.
  };
  // Steps the drama to the image and draws both. tracked: see kTrackedNumbers.
  Status Draw(std::span<const double> tracked, const Moment& moment);

  // Views for a page without a camera: the keyframes of all places that have a picture, in the
  // order of the training videos.
  size_t view_count() const { return views_.size(); }
  const cv::Mat& view_picture(size_t index) const { return KeyframeOf(views_[index]).grey; }
  // Steps the drama and draws it as it is seen from there.
  Status DrawView(size_t index, const Moment& moment);

  // Lets DrawInRoom() draw people in a room that the device tracks. sees: whether images
  // of its camera will be measured.
  void EnterRoom(bool sees);
  // Measures where the stage is in the room. tracked: an image with a pose or without (see
  // kTrackedNumbers), which was taken while the viewer was there. seconds: as Moment's.
  void FindStage(std::span<const double> tracked,
                 const geometry::Rigid3& room_from_viewer,
                 double seconds);
  // Steps the drama and draws people for each view into a framebuffer that the device shows over
  // the real surroundings. Before the first measurement nothing is drawn.
  Status DrawInRoom(std::span<const RoomView> views, uint32_t framebuffer, const Moment& moment);

  // Time of the drama in the last picture, seconds.
  double time() const { return staged_.time; }
  // The texts to show over the last picture: {"captions": [{"speaker", "colour", "side", "text"}],
  // "guide": "look", "dark" or "", "hint": text of the guide}. The newest caption comes first.
  // Returns nullptr if they are those of the picture before.
  const std::string* TakeTexts();

  // State, reason, `followed` and map, then rotation (x, y, z, w), translation, size and intrinsics
  // of the camera.
  static constexpr size_t kTrackedNumbers = 21;

 private:
  struct View {
    uint32_t place = 0;
    size_t keyframe = 0;  // Index into SceneDatabase::keyframes.
  };

  // The part that this page has in a fleet.
  struct Fleet {
    std::vector<group::GroupOwn::Marker> markers;
    bool holds = false;                    // The staff holds the drama.
    std::optional<group::GroupFeed> feed;  // nullopt: the show plays alone.
    std::optional<PageGroup> group;
  };

  // An image as the page has filled it in.
  struct CameraImage {
    PixelFormat format = PixelFormat::kRgba;
    cv::Mat pixels;
    cv::Mat luminance;
  };

  explicit PageShow(bundle::Bundle bundle);
  // together: with the group.
  Status Start(show::ShowContent content, bool together);
  // Lines of a group's drama take the time of their longest language.
  show::LanguageChoice WithGroup(show::LanguageChoice languages) const;
  // Index of the person of Stage::kPerson; nullopt: all have arrived.
  std::optional<size_t> NextPerson() const;
  double SinceBegun(double seconds);
  void FindViews();
  const vision::Keyframe& KeyframeOf(const View& view) const {
    return show_->content().places[view.place].map->keyframes[view.keyframe];
  }
  // Makes frame_ the next frame, without pixels, because those of the one before may still be
  // needed.
  void BeginFrame(const Moment& moment);
  // Steps the drama and its sound to the image in frame_.
  void StageImage(vision::TrackedFrame tracked, const Moment& moment);
  // Stages and draws an image that is in frame_ already. start: when work on it began.
  Status Present(vision::TrackedFrame tracked,
                 const Moment& moment,
                 std::chrono::steady_clock::time_point start);
  // Gives the next pose of smoothed_ and the points seen, with the image's brightness over the
  // map's photometric reference. numbers: see kTrackedNumbers.
  void TakeTracked(std::span<const double> numbers);
  Status SetSize(int width, int height);
  // start: when work on the picture began.
  void ChooseQuality(std::chrono::steady_clock::time_point start, const Moment& moment);
  // Makes the show of a content; its options are those of every show of the page.
  Result<std::unique_ptr<show::Show>> Make(show::ShowContent content, bool together);
  void Begin(std::unique_ptr<show::Show> show);
  Json DescribeTexts();

  bundle::Bundle bundle_;
  std::optional<bundle::Piece> piece_;
  std::vector<bool> person_missing_;  // Parallel to the cast; empty before Load().
  bool things_missing_ = false;
  human::TexturePool textures_;
  std::shared_ptr<Log> log_;
  std::optional<render::OffscreenContext> context_;
  std::optional<render::RenderTarget> target_;
  Fleet fleet_;
  std::unique_ptr<show::Show> show_;
  std::optional<double> begun_;       // Time of the first frame since Start().
  std::unique_ptr<PageSound> sound_;  // nullptr: the show is silent.
  std::unique_ptr<show::ShowRenderer> renderer_;
  show::CaptionTexts texts_;
  std::vector<render::Caption> captions_;
  std::string told_texts_;
  std::unique_ptr<vision::PoseSource> smoothed_;
  GivenPoses* given_ = nullptr;  // Owned by smoothed_.
  show::QualityController quality_;
  vision::GainEstimator gain_estimator_;
  std::array<float, 3> gain_ = {1.0f, 1.0f, 1.0f};
  std::vector<View> views_;
  std::optional<size_t> view_;  // The view of the last picture; nullopt: it was the camera's.
  show::StageAnchor anchor_;
  uint32_t anchored_ = 0;  // The place where anchor_ was measured last.
  std::vector<double> seen_numbers_;
  CameraImage image_;
  geometry::Frame frame_;
  show::StagedFrame staged_;
};

}  // namespace lararium::web
