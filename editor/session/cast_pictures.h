#pragma once

// Pictures of the people and objects of a project: a thumbnail of each, and a portrait of the
// selected person. They are drawn on a separate thread with an OpenGL context of its own, so that
// the interface never waits. An object has a thumbnail once it is baked. A person whose recipe,
// model or clips changed is baked first; the old picture stays until the new one is ready. When no
// picture is left to draw, the thread bakes the light transfer of the people.

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

#include "editor/document/project.h"
#include "editor/jobs/studio.h"
#include "shared/core/status.h"

namespace lararium::editor {

// A picture of a person.
struct CastPortrait {
  std::string name;
  StudioView view;
  cv::Mat bgr;
  // Parallel arrays: name, parent and projection, pixels, of each joint of the skeleton.
  std::vector<std::string> joints;
  std::vector<int16_t> parents;
  std::vector<glm::vec2> pixels;
};

class CastPictures {
 public:
  using Picture = std::shared_ptr<const cv::Mat>;  // Bgr.

  // presets: the user's folder that keeps people made from presets. baking: locked while a person
  // is baked, so that no person is baked twice at the same time.
  CastPictures(ProjectPaths project,
               std::filesystem::path presets,
               std::shared_ptr<std::mutex> baking);
  // Waits while a person is being built, but cancels the computation of the light transfer.
  ~CastPictures();
  CastPictures(const CastPictures&) = delete;
  CastPictures& operator=(const CastPictures&) = delete;

  // All of the following functions return at once.

  void SetCast(const std::vector<CastDocument>& cast);
  // Bakes those again whose inputs outside the project changed, and draws everybody again.
  void BakeAgain();
  void SetObjects(const std::vector<ObjectDocument>& objects);
  // Draws thumbnails of presets too, from now on.
  void WantPresets();
  // Selects the person for the portrait and its view; an empty name selects none.
  void Look(const std::string& name, const StudioView& view, cv::Size size);

  // The newest picture; nullptr before the first.
  Picture Thumbnail(const std::string& name) const;
  Picture PresetThumbnail(const std::string& preset) const;
  Picture ObjectThumbnail(const std::string& object) const;
  std::shared_ptr<const CastPortrait> portrait() const;

  // The number of people of the project who still have to be drawn, or baked with their light.
  size_t PeopleLeft() const;
  // Whether the person with this name still has to be drawn.
  bool Working(const std::string& name) const;

  // Errors and warnings since the last call.
  std::vector<Status> TakeProblems();
  std::vector<std::string> TakeWarnings();

 private:
  // A person with a thumbnail.
  struct Sitter {
    CastDocument member;
    std::string key;  // The key (see KeyOf()) of the present inputs.
    // The key of the inputs that the thumbnail shows, or with which drawing failed.
    std::string done;
    std::string lit;  // The key of the inputs whose light is baked, or whose baking failed.
    Picture thumbnail;
  };
  struct Thing {
    std::string key;  // Identifies the present baked file.
    // The key of the file that the thumbnail shows, or with which drawing failed.
    std::string done;
    Picture thumbnail;
  };
  struct Gaze {
    std::string name;
    StudioView view;
    cv::Size size;

    friend bool operator==(const Gaze&, const Gaze&) = default;
  };
  // The next work for the thread: the portrait, the thumbnail or the light of one person, or the
  // thumbnail of an object.
  struct Order {
    std::string object = {};  // The object's name; empty: a person.
    bool of_preset = false;
    CastDocument member = {};
    std::string key = {};
    std::optional<Gaze> gaze = {};  // Only a portrait has one.
    bool light = false;             // True: the light is baked, and no picture is drawn.
  };
  class Painter;

  std::string KeyOf(const CastDocument& member) const;
  void Start();
  void Run(std::stop_token stop);
  bool AwaitOrder(std::unique_lock<std::mutex>& lock,
                  const std::stop_token& stop,
                  Painter& painter);
  std::optional<Order> NextOrder() const;
  bool PictureWaits() const;
  void Deliver(const Order& order, Picture thumbnail, std::shared_ptr<const CastPortrait> portrait);

  ProjectPaths project_;
  ProjectPaths presets_folder_;
  std::shared_ptr<std::mutex> baking_;

  mutable std::mutex mutex_;  // Protects the members below.
  std::condition_variable_any ordered_;
  std::map<std::string, Sitter> cast_;
  std::map<std::string, Sitter> presets_;
  std::map<std::string, Thing> objects_;
  std::optional<Gaze> gaze_;
  std::string gaze_done_;  // The key of the person whom portrait_ shows, or for whom it failed.
  std::optional<Gaze> gazed_;
  std::shared_ptr<const CastPortrait> portrait_;
  std::vector<Status> problems_;
  std::vector<std::string> warnings_;
  std::optional<std::jthread> thread_;  // The last member, so that it ends first.
};

}  // namespace lararium::editor
