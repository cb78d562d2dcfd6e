#pragma once

#include <filesystem>
#include <string>

namespace lararium::editor {

// The paths of the files in a project's folder.
struct ProjectPaths {
  std::filesystem::path folder;

  std::filesystem::path Project() const { return folder / "project.json"; }
  // Unsaved edits; the file exists only between an edit and the next saving (journal.h).
  std::filesystem::path Journal() const { return folder / "journal"; }
  std::filesystem::path Drama() const { return folder / "drama.lua"; }
  std::filesystem::path Cast() const { return folder / "cast"; }
  std::filesystem::path Human(const std::string& cast_name) const {
    return Cast() / (cast_name + ".larhuman");
  }
  // The person with its light transfer, which takes longer to bake.
  std::filesystem::path LitHuman(const std::string& cast_name) const {
    return Cast() / (cast_name + ".lit.larhuman");
  }
  std::filesystem::path Prop(const std::string& object) const {
    return folder / "props" / (object + ".larprop");
  }
  // A baked line in one language: the sound has the suffix ".flac", the mouth movement
  // ".visemes.json".
  std::filesystem::path Speech(const std::string& language, const std::string& file) const {
    return folder / "speech" / language / file;
  }
  // Recordings that the author provides: audio/LANGUAGE/LINE.wav and others.
  std::filesystem::path Recordings(const std::string& language) const {
    return folder / "audio" / language;
  }
  std::filesystem::path Place(const std::string& name) const { return folder / "places" / name; }
  std::filesystem::path Scene(const std::string& place) const {
    return Place(place) / "scene.larscene";
  }

  // Converts a path of the document to a path on disk, and back.
  std::filesystem::path Resolve(const std::string& path) const;
  std::string Shorten(const std::filesystem::path& file) const;
};

// Whether a folder has a project.
bool IsProject(const std::filesystem::path& folder);

// The canonical path of a folder, so that each folder has one name.
std::filesystem::path NormalFolder(const std::filesystem::path& folder);

}  // namespace lararium::editor
