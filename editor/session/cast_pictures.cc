#include "editor/session/cast_pictures.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <stop_token>
#include <utility>

#include "editor/document/file_stamp.h"
#include "editor/import/cast/cast_presets.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/thumbnail.h"
#include "shared/core/file.h"
#include "shared/core/memory.h"
#include "shared/human/human.h"

namespace lararium::editor {
namespace {

// The studio needs tens of megabytes, so it is released when there is nothing to draw for this
// long. The time is shorter while no portrait is shown: list pictures are drawn once, and the
// preview starts when a project is opened.
constexpr std::chrono::seconds kKept(20);
constexpr std::chrono::seconds kKeptForLists(2);

// Cancels baking when the thread is asked to stop, or something more urgent waits.
class UntilUrged : public Progress {
 public:
  UntilUrged(std::stop_token stop, std::function<bool()> urgent)
      : stop_(std::move(stop)), urgent_(std::move(urgent)) {}

  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return stop_.stop_requested() || urgent_(); }

 private:
  std::stop_token stop_;
  std::function<bool()> urgent_;
};

}  // namespace

// State that only the thread uses.
class CastPictures::Painter {
 public:
  struct Result {
    Picture thumbnail;
    std::shared_ptr<const CastPortrait> portrait;
  };

  Painter(ProjectPaths presets,
          std::shared_ptr<std::mutex> baking,
          const std::stop_token& stop,
          std::function<bool()> picture_waits)
      : presets_(std::move(presets)),
        baking_(std::move(baking)),
        until_stopped_(stop, [] { return false; }),
        until_picture_waits_(stop, std::move(picture_waits)) {}

  lararium::Result<Result> Paint(const ProjectPaths& paths,
                                 const Order& order,
                                 std::vector<std::string>& warnings) {
    if (!order.object.empty()) {
      return PaintObject(paths.Prop(order.object));
    }
    if (order.light) {
      // Baking the person without light has told the warnings.
      std::vector<std::string> told;
      LARARIUM_RETURN_IF_ERROR(
          BakeAlone(paths, order.member, BakeWhat::kPeople, until_picture_waits_, told));
      return Result();
    }
    const std::filesystem::path file = paths.Human(order.member.name);
    if (seated_ != order.key) {
      TakeFromPreset(order.member, file);
      LARARIUM_RETURN_IF_ERROR(
          BakeAlone(paths, order.member, BakeWhat::kUnlitPeople, until_stopped_, warnings));
    }
    Result result;
    if (std::optional<cv::Mat> known = LoadThumbnail(file)) {
      result.thumbnail = std::make_shared<const cv::Mat>(std::move(*known));
    }
    if (order.gaze || result.thumbnail == nullptr) {
      LARARIUM_RETURN_IF_ERROR(Seat(file, order.key));
    }
    if (result.thumbnail == nullptr) {
      LARARIUM_ASSIGN_OR_RETURN(cv::Mat made, MakeThumbnail(file, *studio_));
      result.thumbnail = std::make_shared<const cv::Mat>(std::move(made));
    }
    if (order.gaze) {
      LARARIUM_ASSIGN_OR_RETURN(result.portrait, Portray(*order.gaze));
    }
    return result;
  }

  // Releases the studio; it is created again when it is needed.
  void Rest() {
    studio_.reset();
    seated_.clear();
    TrimHeap();
  }

 private:
  // Copies what was baked for the picture of the member's preset to `file`, unless there is a file
  // already. Baking finds it up to date if the member has not been changed.
  void TakeFromPreset(const CastDocument& member, const std::filesystem::path& file) {
    if (member.preset.empty() || FileExists(file)) {
      return;
    }
    const std::lock_guard turn(*baking_);
    CopyProduct(presets_.Human(member.preset), file);
  }

  Status BakeAlone(const ProjectPaths& paths,
                   const CastDocument& member,
                   BakeWhat what,
                   Progress& progress,
                   std::vector<std::string>& warnings) {
    const std::lock_guard turn(*baking_);
    ProjectDocument alone;
    alone.cast.push_back(member);
    LARARIUM_ASSIGN_OR_RETURN(BakeReport report, Bake(paths, alone, progress, what));
    TrimHeap();
    std::move(report.warnings.begin(), report.warnings.end(), std::back_inserter(warnings));
    return Status();
  }

  Status OpenStudio() {
    if (studio_ == nullptr) {
      LARARIUM_ASSIGN_OR_RETURN(studio_, Studio::Create());
    }
    return Status();
  }

  lararium::Result<Result> PaintObject(const std::filesystem::path& file) {
    LARARIUM_RETURN_IF_ERROR(OpenStudio());
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
    LARARIUM_ASSIGN_OR_RETURN(stage::Prop prop, stage::ParseProp(bytes, file.string()));
    LARARIUM_ASSIGN_OR_RETURN(const std::shared_ptr<const stage::ObjectModel> model,
                              stage::ObjectModel::Create(std::move(prop), file.string()));
    LARARIUM_ASSIGN_OR_RETURN(cv::Mat picture,
                              studio_->ShootThing(model, cv::Size(kThumbnailSide, kThumbnailSide)));
    return Result{std::make_shared<const cv::Mat>(std::move(picture)), nullptr};
  }

  Status Seat(const std::filesystem::path& file, const std::string& key) {
    if (seated_ == key) {
      return Status();
    }
    LARARIUM_RETURN_IF_ERROR(OpenStudio());
    seated_.clear();
    LARARIUM_ASSIGN_OR_RETURN(human::Human loaded, human::LoadHuman(file));
    const auto human = std::make_shared<const human::Human>(std::move(loaded));
    LARARIUM_RETURN_IF_ERROR(studio_->Seat(human, CalmPose(*human)));
    joints_ = human->skeleton.names;
    parents_ = human->skeleton.parents;
    seated_ = key;
    return Status();
  }

  lararium::Result<std::shared_ptr<const CastPortrait>> Portray(const Gaze& gaze) {
    LARARIUM_ASSIGN_OR_RETURN(StudioShot shot, studio_->Shoot(gaze.view, gaze.size));
    return std::make_shared<const CastPortrait>(CastPortrait{
        gaze.name, gaze.view, std::move(shot.picture), joints_, parents_, std::move(shot.joints)});
  }

  ProjectPaths presets_;
  std::shared_ptr<std::mutex> baking_;
  UntilUrged until_stopped_;
  UntilUrged until_picture_waits_;
  std::unique_ptr<Studio> studio_;
  std::string seated_;  // The key of the person in the studio.
  std::vector<std::string> joints_;
  std::vector<int16_t> parents_;
};

CastPictures::CastPictures(ProjectPaths project,
                           std::filesystem::path presets,
                           std::shared_ptr<std::mutex> baking)
    : project_(std::move(project)),
      presets_folder_{std::move(presets)},
      baking_(std::move(baking)) {}

CastPictures::~CastPictures() = default;

// A key that changes with the person's appearance: the project's settings and the files that they
// refer to.
std::string CastPictures::KeyOf(const CastDocument& member) const {
  CastDocument seen = member;
  seen.voice = {};
  seen.title.clear();
  std::string key = FormatFields(seen).dump();
  for (const std::string& file : {member.model, member.bone_map}) {
    key += file.empty() ? "" : FileStamp(project_.Resolve(file));
  }
  for (const ClipDocument& clip : member.clips) {
    key += FileStamp(project_.Resolve(clip.file));
  }
  return key;
}

void CastPictures::SetCast(const std::vector<CastDocument>& cast) {
  const std::lock_guard lock(mutex_);
  std::map<std::string, Sitter> now;
  for (const CastDocument& member : cast) {
    Sitter& sitter = now[member.name];
    if (const auto known = cast_.find(member.name); known != cast_.end()) {
      sitter = std::move(known->second);
    }
    sitter.member = member;
    sitter.key = KeyOf(member);
  }
  cast_ = std::move(now);
  Start();
}

void CastPictures::BakeAgain() {
  const std::lock_guard lock(mutex_);
  for (auto* people : {&cast_, &presets_}) {
    for (auto& [name, sitter] : *people) {
      sitter.done.clear();
      sitter.lit.clear();
    }
  }
  gaze_done_.clear();
  Start();
}

void CastPictures::SetObjects(const std::vector<ObjectDocument>& objects) {
  const std::lock_guard lock(mutex_);
  std::map<std::string, Thing> now;
  for (const ObjectDocument& object : objects) {
    Thing& thing = now[object.name];
    if (const auto known = objects_.find(object.name); known != objects_.end()) {
      thing = std::move(known->second);
    }
    thing.key = FileStamp(project_.Prop(object.name));
    if (thing.key == "none") {
      thing.done = thing.key;  // Nothing was baked yet.
    }
  }
  objects_ = std::move(now);
  Start();
}

void CastPictures::WantPresets() {
  const std::lock_guard lock(mutex_);
  if (!presets_.empty()) {
    return;
  }
  for (const std::string& name : import::CastPresetNames()) {
    Sitter& sitter = presets_[name];
    sitter.member.name = sitter.member.preset = sitter.key = name;
  }
  Start();
}

void CastPictures::Look(const std::string& name, const StudioView& view, cv::Size size) {
  const std::lock_guard lock(mutex_);
  gaze_ = name.empty() ? std::nullopt : std::optional(Gaze{name, view, size});
  Start();
}

CastPictures::Picture CastPictures::Thumbnail(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = cast_.find(name);
  return found == cast_.end() ? nullptr : found->second.thumbnail;
}

CastPictures::Picture CastPictures::PresetThumbnail(const std::string& preset) const {
  const std::lock_guard lock(mutex_);
  const auto found = presets_.find(preset);
  return found == presets_.end() ? nullptr : found->second.thumbnail;
}

CastPictures::Picture CastPictures::ObjectThumbnail(const std::string& object) const {
  const std::lock_guard lock(mutex_);
  const auto found = objects_.find(object);
  return found == objects_.end() ? nullptr : found->second.thumbnail;
}

std::shared_ptr<const CastPortrait> CastPictures::portrait() const {
  const std::lock_guard lock(mutex_);
  return portrait_;
}

size_t CastPictures::PeopleLeft() const {
  const std::lock_guard lock(mutex_);
  return static_cast<size_t>(std::ranges::count_if(cast_, [](const auto& entry) {
    const Sitter& sitter = entry.second;
    return sitter.done != sitter.key || sitter.lit != sitter.key;
  }));
}

bool CastPictures::Working(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = cast_.find(name);
  return found != cast_.end() && found->second.done != found->second.key;
}

std::vector<Status> CastPictures::TakeProblems() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problems_, {});
}

std::vector<std::string> CastPictures::TakeWarnings() {
  const std::lock_guard lock(mutex_);
  return std::exchange(warnings_, {});
}

// Requires the lock. The first order starts the thread.
void CastPictures::Start() {
  if (!NextOrder()) {
    return;
  }
  if (!thread_) {
    thread_.emplace([this](std::stop_token stop) { Run(stop); });
  }
  ordered_.notify_one();
}

// Requires the lock. The portrait comes first, then the cast, objects, and presets; the light of
// the cast, which nothing here shows, comes last.
std::optional<CastPictures::Order> CastPictures::NextOrder() const {
  if (gaze_) {
    const auto found = cast_.find(gaze_->name);
    if (found != cast_.end() && (found->second.key != gaze_done_ || gaze_ != gazed_)) {
      return Order{.member = found->second.member, .key = found->second.key, .gaze = gaze_};
    }
  }
  const auto next_of = [](const std::map<std::string, Sitter>& people,
                          bool of_preset) -> std::optional<Order> {
    for (const auto& [name, sitter] : people) {
      if (sitter.done != sitter.key) {
        return Order{.of_preset = of_preset, .member = sitter.member, .key = sitter.key};
      }
    }
    return std::nullopt;
  };
  if (std::optional<Order> person = next_of(cast_, false)) {
    return person;
  }
  for (const auto& [name, thing] : objects_) {
    if (thing.done != thing.key) {
      return Order{.object = name, .key = thing.key};
    }
  }
  if (std::optional<Order> preset = next_of(presets_, true)) {
    return preset;
  }
  for (const auto& [name, sitter] : cast_) {
    if (sitter.lit != sitter.key) {
      return Order{.member = sitter.member, .key = sitter.key, .light = true};
    }
  }
  return std::nullopt;
}

// Requires the lock.
bool CastPictures::PictureWaits() const {
  const std::optional<Order> order = NextOrder();
  return order && !order->light;
}

void CastPictures::Deliver(const Order& order,
                           Picture thumbnail,
                           std::shared_ptr<const CastPortrait> portrait) {
  if (const auto thing = objects_.find(order.object); thing != objects_.end()) {
    thing->second.done = order.key;
    thing->second.thumbnail = std::move(thumbnail);
    return;
  }
  auto& people = order.of_preset ? presets_ : cast_;
  if (const auto found = people.find(order.member.name); found != people.end()) {
    if (order.light || thumbnail == nullptr) {
      found->second.lit = order.key;
    }
    if (!order.light) {
      found->second.done = order.key;
    }
    if (thumbnail != nullptr) {
      found->second.thumbnail = std::move(thumbnail);
    }
  }
  if (order.gaze) {
    gaze_done_ = order.key;
    gazed_ = order.gaze;
    if (portrait != nullptr) {
      portrait_ = std::move(portrait);
    }
  }
}

// Waits for the next order; returns false when the thread must end.
bool CastPictures::AwaitOrder(std::unique_lock<std::mutex>& lock,
                              const std::stop_token& stop,
                              Painter& painter) {
  const auto ordered = [this] { return NextOrder().has_value(); };
  if (ordered_.wait_for(lock, stop, gaze_ ? kKept : kKeptForLists, ordered)) {
    return true;
  }
  lock.unlock();
  painter.Rest();
  lock.lock();
  return ordered_.wait(lock, stop, ordered);
}

void CastPictures::Run(std::stop_token stop) {
  Painter painter(presets_folder_, baking_, stop, [this] {
    const std::lock_guard lock(mutex_);
    return PictureWaits();
  });
  std::unique_lock lock(mutex_);
  while (AwaitOrder(lock, stop, painter)) {
    const Order order = *NextOrder();
    lock.unlock();
    std::vector<std::string> warnings;
    auto painted = painter.Paint(order.of_preset ? presets_folder_ : project_, order, warnings);
    lock.lock();
    if (stop.stop_requested()) {
      return;
    }
    if (!painted.ok() && order.light && PictureWaits()) {
      continue;  // Baking the light made way for a picture.
    }
    if (!painted.ok()) {
      problems_.push_back(painted.status());
      Deliver(order, nullptr, nullptr);
    } else {
      Deliver(order, std::move(painted->thumbnail), std::move(painted->portrait));
    }
    std::move(warnings.begin(), warnings.end(), std::back_inserter(warnings_));
  }
}

}  // namespace lararium::editor
