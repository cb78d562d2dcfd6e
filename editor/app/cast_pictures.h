#pragma once

// Pictures of the people and objects of a project, made on a thread of its own with an OpenGL
// context of its own, so that the interface never waits: a thumbnail of each, and a portrait of the
// one who is looked at. Objects have theirs once they are baked. People whose recipe, model or
// clips have changed are baked first; until a new picture is there the older one stays.

#include <condition_variable>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "editor/app/project.h"
#include "editor/app/studio.h"
#include "shared/core/status.h"

namespace lararium::app {

// A person as they are looked at.
struct CastPortrait {
  std::string name;
  StudioView view;
  cv::Mat bgr;
  // Parallel arrays: the skeleton, and where its joints are in the picture.
  std::vector<std::string> joints;
  std::vector<int16_t> parents;
  std::vector<glm::vec2> pixels;
};

class CastPictures {
 public:
  using Picture = std::shared_ptr<const cv::Mat>;  // bgr

  // presets: a folder of the user's where people made from the presets are kept.
  // baking: held while somebody is baked, so that nobody is baked twice at a time.
  CastPictures(ProjectPaths project,
               std::filesystem::path presets,
               std::shared_ptr<std::mutex> baking);
  // Waits where somebody is being built; their light is given up.
  ~CastPictures();
  CastPictures(const CastPictures&) = delete;
  CastPictures& operator=(const CastPictures&) = delete;

  // All of these return at once.

  // The cast as it is now.
  void SetCast(const std::vector<CastDocument>& cast);
  // The objects as they are now.
  void SetObjects(const std::vector<ObjectDocument>& objects);
  // From now on there are thumbnails of presets too.
  void WantPresets();
  // Whom to look at, from where; an empty name: nobody.
  void Look(const std::string& name, const StudioView& view, cv::Size size);

  // The newest, nullptr before the first.
  Picture Thumbnail(const std::string& name) const;
  Picture PresetThumbnail(const std::string& preset) const;
  Picture ObjectThumbnail(const std::string& object) const;
  std::shared_ptr<const CastPortrait> portrait() const;

  // Somebody of the project is still to be baked or drawn.
  bool Working() const;
  // The same of one of them.
  bool Working(const std::string& name) const;

  // What failed since the last call, and what there is to know beside.
  std::vector<Status> TakeProblems();
  std::vector<std::string> TakeWarnings();

 private:
  // A person who is to be shown.
  struct Sitter {
    CastDocument member;
    std::string key;   // of what they are made of now
    std::string done;  // of what the thumbnail shows, or could not
    Picture thumbnail;
  };
  struct Thing {
    std::string key;   // of the baked file
    std::string done;  // of what the thumbnail shows, or could not
    Picture thumbnail;
  };
  struct Gaze {
    std::string name;
    StudioView view;
    cv::Size size;

    friend bool operator==(const Gaze&, const Gaze&) = default;
  };
  // What the thread does next: the portrait or the thumbnail of one person, or of an object.
  struct Order {
    std::string object;  // its name; empty: a person
    bool of_preset = false;
    CastDocument member;
    std::string key;
    std::optional<Gaze> gaze;  // none: a thumbnail
  };
  class Painter;

  std::string KeyOf(const CastDocument& member) const;
  void Start();
  void Run(std::stop_token stop);
  bool AwaitOrder(std::unique_lock<std::mutex>& lock,
                  const std::stop_token& stop,
                  Painter& painter);
  std::optional<Order> NextOrder() const;
  void Deliver(const Order& order, Picture thumbnail, std::shared_ptr<const CastPortrait> portrait);

  ProjectPaths project_;
  ProjectPaths presets_folder_;
  std::shared_ptr<std::mutex> baking_;

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable_any ordered_;
  std::map<std::string, Sitter> cast_;
  std::map<std::string, Sitter> presets_;
  std::map<std::string, Thing> objects_;
  std::optional<Gaze> gaze_;
  std::string gaze_done_;  // the key of the person whom portrait_ shows, or who failed
  std::optional<Gaze> gazed_;
  std::shared_ptr<const CastPortrait> portrait_;
  std::vector<Status> problems_;
  std::vector<std::string> warnings_;
  std::optional<std::jthread> thread_;  // last
};

}  // namespace lararium::app
