#pragma once

// What the panels show of a project's people and objects besides the document: their pictures, the
// options of recipes, and how the bones of an imported figure were assigned. Use it from the
// interface thread only.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "editor/jobs/background_task.h"
#include "editor/jobs/bone_review.h"
#include "editor/jobs/cast_catalogue.h"
#include "editor/session/cached.h"
#include "editor/session/cast_pictures.h"
#include "editor/session/message_log.h"
#include "editor/session/project_session.h"

namespace lararium::editor {

class CastSession {
 public:
  // baking: locked while a person is baked. The other arguments must outlive the cast session.
  CastSession(ProjectSession& project,
              TaskList& tasks,
              MessageLog& messages,
              std::shared_ptr<std::mutex> baking);

  CastPictures& pictures() { return pictures_; }
  const CastPictures& pictures() const { return pictures_; }

  // The options of recipes, read at the first call. nullptr: not read yet, or the library is
  // missing; see catalogue_problem().
  const CastCatalogue* catalogue();
  // Why the options cannot be read; empty: they can.
  std::string catalogue_problem() const;
  // Whether there is no library to build people of. Known after the first call of catalogue().
  bool library_is_missing() const { return library_is_missing_; }
  // Fetches the library in the background. Then people who were baked without it are baked again.
  void FetchLibrary();

  // How the bones of an imported figure were assigned. Read at the first call and again when the
  // bone map changes; the old result stays until then. nullptr: not read yet, or reading failed.
  const BoneReview* bone_review(const CastDocument& member);
  // Writes the current bone map into a file, and sets the member's bone_map to it.
  void SaveBones(const CastDocument& member);

  // Adds the problems of pictures to the messages. Call once for each frame of the interface.
  void Update();

 private:
  struct Reviewed {
    std::string name;  // The member whose bones these are.
    BoneReview review;
  };

  ProjectSession& project_;
  TaskList& tasks_;
  MessageLog& messages_;
  CastPictures pictures_;
  Cached<std::filesystem::path, CastCatalogue> catalogue_;  // The key is the library's folder.
  bool library_is_missing_ = false;
  // The key is everything that decides the bones: the member and the stamps of its files.
  Cached<std::string, Reviewed> bones_;
};

}  // namespace lararium::editor
